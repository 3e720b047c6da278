#include "lambent/synthesis/lattice_jumps.h"

#include <cassert>
#include <cmath>
#include <numeric>

namespace lambent::synthesis {
namespace {

using Complex = std::complex<double>;

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

JumpForm sumOf(const JumpForm& a, const Complex& factor, const JumpForm& b) {
  JumpForm out;
  out.reserve(a.size() + b.size());
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (j == b.size() || (i < a.size() && a[i].first < b[j].first)) {
      out.push_back(a[i++]);
    } else if (i == a.size() || b[j].first < a[i].first) {
      out.emplace_back(b[j].first, factor * b[j].second), ++j;
    } else {
      const Complex both = a[i].second + factor * b[j].second;
      if (std::abs(both) > 1e-9) out.emplace_back(a[i].first, both);
      ++i, ++j;
    }
  }
  return out;
}

LatticeJumps::LatticeJumps(const Manifold& m, const CrossField& field,
                           std::span<const std::uint32_t> chartOfTriangle)
    : m_(m), field_(field) {
  singular_.assign(m.vertexCount(), false);
  for (const CrossField::Singularity& s : field.singularities) singular_[s.vertex] = true;
  findTree(chartOfTriangle);
  relate();
}

/// A spanning tree of triangles, within charts first: inside of them places go on.
void LatticeJumps::findTree(std::span<const std::uint32_t> chartOfTriangle) {
  const auto count = std::uint32_t(m_.twin.size());
  cut_.assign(count, false);
  std::vector<std::uint32_t> parent(count / 3);
  std::iota(parent.begin(), parent.end(), 0u);
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t h = 0; h < count; ++h) {
      const std::uint32_t twin = m_.twin[h];
      if (twin == kNone || twin < h || m_.vertexOfCorner[h] == kNone) continue;
      const bool same = chartOfTriangle[h / 3] == chartOfTriangle[twin / 3];
      if (round != (same ? (field_.matching[h] == 0 ? 0 : 2) : 1)) continue;
      const std::uint32_t a = rootOf(parent, h / 3), b = rootOf(parent, twin / 3);
      if (a == b) {
        cut_[h] = true;
      } else {
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  }
}

void LatticeJumps::relate() {
  const auto count = std::uint32_t(m_.twin.size());
  forms_.assign(count, {});
  // Every border is one node: what goes round it is free.
  std::vector<std::uint32_t> node(m_.vertexCount());
  std::iota(node.begin(), node.end(), 0u);
  std::vector<bool> atBorder(m_.vertexCount(), false);
  for (std::uint32_t h = 0; h < count; ++h) {
    if (m_.vertexOfCorner[h] == kNone || m_.twin[h] != kNone) continue;
    const std::uint32_t a = m_.vertexOfCorner[h], b = m_.vertexOfCorner[Manifold::next(h)];
    atBorder[a] = atBorder[b] = true;
    const std::uint32_t x = rootOf(node, a), y = rootOf(node, b);
    node[std::max(x, y)] = std::min(x, y);
  }
  std::vector<bool> isFree(m_.vertexCount(), false);  // nodes
  for (std::uint32_t v = 0; v < m_.vertexCount(); ++v)
    if (atBorder[v] || singular_[v]) isFree[rootOf(node, v)] = true;

  // The cut edges about each node.
  std::vector<std::uint32_t> begin(m_.vertexCount() + 1, 0), edges;
  const auto eachCut = [&](const auto& visit) {
    for (std::uint32_t h = 0; h < count; ++h)
      if (cut_[h]) {
        visit(h, rootOf(node, m_.vertexOfCorner[h]));
        visit(h, rootOf(node, m_.vertexOfCorner[Manifold::next(h)]));
      }
  };
  eachCut([&](std::uint32_t, std::uint32_t v) { ++begin[v + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  edges.resize(begin.back());
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  eachCut([&](std::uint32_t h, std::uint32_t v) { edges[at[v]++] = h; });

  // A spanning tree of the nodes over these edges, from a free node if there is one.
  std::vector<std::uint32_t> order, parentEdge(m_.vertexCount(), kNone);
  std::vector<bool> reached(m_.vertexCount(), false), inTree(count, false);
  const auto growFrom = [&](std::uint32_t first) {
    if (rootOf(node, first) != first || reached[first]) return;
    reached[first] = true;
    order.push_back(first);
    for (std::size_t i = order.size() - 1; i < order.size(); ++i) {
      const std::uint32_t v = order[i];
      for (std::uint32_t e = begin[v]; e < begin[v + 1]; ++e) {
        const std::uint32_t h = edges[e];
        std::uint32_t other = rootOf(node, m_.vertexOfCorner[h]);
        if (other == v) other = rootOf(node, m_.vertexOfCorner[Manifold::next(h)]);
        if (reached[other]) continue;
        reached[other] = true, inTree[h] = true;
        parentEdge[other] = h;
        order.push_back(other);
      }
    }
  };
  for (std::uint32_t v = 0; v < m_.vertexCount(); ++v)
    if (isFree[v]) growFrom(v);
  for (std::uint32_t v = 0; v < m_.vertexCount(); ++v) growFrom(v);

  for (std::uint32_t h = 0; h < count; ++h)
    if (cut_[h] && !inTree[h]) forms_[h] = {{variables_++, 1.0}};
  for (std::size_t i = order.size(); i-- > 0;) {
    const std::uint32_t v = order[i];
    if (parentEdge[v] == kNone) continue;
    if (isFree[v]) {
      forms_[parentEdge[v]] = {{variables_++, 1.0}};
    } else {
      close(v, parentEdge[v]);
    }
  }
}

/// Sets t of one edge so that places come back to themselves around the vertex.
void LatticeJumps::close(std::uint32_t vertex, std::uint32_t parentEdge) {
  JumpForm total;  // of all other edges, as seen after the last
  int after = 0;   // quarter turns since the parent edge was crossed
  bool backwards = false, crossed = false;
  std::uint32_t c = m_.firstCorner[vertex];
  do {
    const std::uint32_t h = Manifold::previous(c), twin = m_.twin[h];
    total = sumOf({}, quarterTurns(turns(h)), total);
    if (crossed) after += turns(h);
    if (std::min(h, twin) == parentEdge) {
      crossed = true, after = 0, backwards = h != parentEdge;
    } else if (!crossesTree(h)) {
      total = sumOf(total, 1.0, over(h));
    }
    c = m_.turnLeft(c);
  } while (c != m_.firstCorner[vertex]);
  assert(crossed);
  // i^after · t + total = 0
  JumpForm t = sumOf({}, -quarterTurns(-after), total);
  if (backwards) t = sumOf({}, -quarterTurns(turns(parentEdge)), t);
  forms_[parentEdge] = std::move(t);
}

LatticeCorners cornersOf(const Manifold& m, const LatticeJumps& jumps) {
  LatticeCorners corners;
  corners.of.resize(m.twin.size());
  for (std::uint32_t v = 0; v < m.vertexCount(); ++v) {
    const std::uint32_t first = m.firstCorner[v];
    int turns = 0;
    JumpForm form;
    std::uint32_t c = first;
    bool closed = false;
    do {
      LatticeCorner& corner = corners.of[c];
      corner.unknown = corners.unknowns;
      corner.factor = quarterTurns(turns);
      corner.form = form;
      const std::uint32_t h = Manifold::previous(c);
      if (m.twin[h] != kNone) {
        turns = (turns + jumps.turns(h)) & 3;
        form = sumOf({}, quarterTurns(jumps.turns(h)), form);
        if (!jumps.crossesTree(h)) form = sumOf(form, 1.0, jumps.over(h));
      }
      c = m.turnLeft(c);
      closed = c == first;
    } while (c != kNone && !closed);
    if (closed && turns != 0) {
      // (1 − i^k) Z = what the loop adds: the one place that the turn leaves where it is.
      const Complex scale = 1.0 / (1.0 - quarterTurns(turns));
      c = first;
      do {
        LatticeCorner& corner = corners.of[c];
        corner.form = sumOf(corner.form, corner.factor * scale, form);
        corner.unknown = kNone;
        c = m.turnLeft(c);
      } while (c != first);
      continue;
    }
    ++corners.unknowns;
    if (closed && (!form.empty() || jumps.singular(v))) {
      // No place would do for all around it: each triangle has its own.
      for (c = m.turnLeft(first); c != first; c = m.turnLeft(c))
        corners.of[c].unknown = corners.unknowns++;
    }
  }
  return corners;
}

}  // namespace lambent::synthesis
