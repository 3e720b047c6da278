#include "lambent/synthesis/worn_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/math/union_find.h"
#include "lambent/scene/texel_map.h"
#include "lambent/scene/uv_steps.h"
#include "lambent/scene/weld.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

using Step = WornTexels::Step;

constexpr std::uint32_t kNone = scene::kNobody;
constexpr float kFarthest =
    3.0f;  ///< of neighbours in a chart, in sizes of a texel: not over a gap

/// An edge of a triangle at which its chart ends.
struct Border {
  std::uint64_t key = 0;  ///< of its ends' positions
  std::uint32_t triangle = 0;
  std::uint32_t from = 0, to = 0;  ///< vertices, the one of the lower position first
};

std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

std::vector<Border> bordersOf(const scene::Mesh& mesh) {
  struct Edge {
    std::uint64_t key;
    std::uint32_t triangle, a, b;
  };
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      edges.push_back({keyOf(a, b), t, a, b});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return x.key != y.key ? x.key < y.key : x.triangle < y.triangle;
  });
  const std::vector<std::uint32_t> place = scene::weldPositions(mesh);
  std::vector<Border> borders;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool alone = (i == 0 || edges[i - 1].key != edges[i].key) &&
                       (i + 1 == edges.size() || edges[i + 1].key != edges[i].key);
    std::uint32_t a = edges[i].a, b = edges[i].b;
    if (!alone || place[a] == place[b]) continue;
    if (place[a] > place[b]) std::swap(a, b);
    borders.push_back({keyOf(place[a], place[b]), edges[i].triangle, a, b});
  }
  std::sort(borders.begin(), borders.end(), [](const Border& x, const Border& y) {
    return x.key != y.key ? x.key < y.key : x.triangle < y.triangle;
  });
  return borders;
}

/// Of triangles that hang together by their vertices, the same number.
std::vector<std::uint32_t> chartsOf(const scene::Mesh& mesh) {
  math::UnionFind sets(mesh.positions.size());
  for (const scene::Triangle& t : mesh.triangles) sets.join(t[0], t[1]), sets.join(t[1], t[2]);
  std::vector<std::uint32_t> charts;
  for (const scene::Triangle& t : mesh.triangles) charts.push_back(sets.rootOf(t[0]));
  return charts;
}

struct Builder {
  const Worn& worn;
  scene::TexelMap map;
  std::vector<std::uint32_t> charts;  ///< of triangles
  std::vector<std::uint32_t> number;  ///< of the map's texels, or kNone
  WornTexels out;

  std::uint32_t chartAt(std::size_t texel) const { return charts[map.triangle[texel]]; }

  void texels() {
    number.assign(map.size(), kNone);
    std::vector<std::uint32_t> covered;
    for (std::size_t texel = 0; texel < map.size(); ++texel)
      if (map.covered(texel)) {
        number[texel] = std::uint32_t(covered.size());
        covered.push_back(std::uint32_t(texel));
      }
    const std::size_t count = covered.size();
    out.positions.resize(count), out.normals.resize(count);
    out.along.resize(count), out.across.resize(count);
    out.places.resize(count), out.areas.resize(count), out.atEnd.assign(count, 0);
    const scene::Mesh& mesh = worn.mesh;
    work::parallelRanges(count, 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t texel = covered[i], triangle = map.triangle[texel];
        const scene::Triangle& corners = mesh.triangles[triangle];
        const Vec2 b = map.barycentric[texel];
        const auto mix = [&](std::span<const Vec3> of) -> Vec3 {
          return (1.0f - b.x() - b.y()) * of[corners[0]] + b.x() * of[corners[1]] +
                 b.y() * of[corners[2]];
        };
        const scene::UvSteps steps = scene::uvSteps(mesh, triangle);
        out.positions[i] = mix(mesh.positions);
        Vec3 n = mix(mesh.normals);
        if (!(n.norm() > 1e-6f)) n = mesh.normals[corners[0]];
        n.normalize();
        Vec3 t = mix(worn.tangents);
        t -= n.dot(t) * n;
        if (!(t.norm() > 1e-3f)) {
          t = worn.tangents[corners[0]];
          t -= n.dot(t) * n;
        }
        if (!(t.norm() > 1e-6f)) t = n.unitOrthogonal();
        t.normalize();
        out.normals[i] = n, out.along[i] = t, out.across[i] = n.cross(t);
        out.places[i] = worn.map.at(int(texel) % map.width, int(texel) / map.width);
        out.areas[i] = steps.u.cross(steps.v).norm() / (float(map.width) * float(map.height));
      }
    });
  }

  void stepsInCharts() {
    const auto visit = [&](std::size_t texel, std::size_t next, bool alongU) {
      const std::uint32_t a = number[texel], b = number[next];
      if (a == kNone || b == kNone || chartAt(texel) != chartAt(next)) return;
      const scene::UvSteps steps = scene::uvSteps(worn.mesh, map.triangle[texel]);
      const float u = steps.u.norm() / float(map.width), v = steps.v.norm() / float(map.height);
      if ((out.positions[a] - out.positions[b]).norm() > kFarthest * std::max(u, v)) return;
      out.steps.push_back({a, b, alongU ? v : u});
    };
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        const std::size_t texel = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
        if (x + 1 < map.width) visit(texel, texel + 1, true);
        if (y + 1 < map.height) visit(texel, texel + std::size_t(map.width), false);
      }
  }

  /// The texel of a chart nearest to uv, of those around it; kNone if there is none.
  std::uint32_t nearest(const Vec2& uv, std::uint32_t chart) const {
    const Vec2 at(uv.x() * float(map.width) - 0.5f, uv.y() * float(map.height) - 0.5f);
    const int cx = int(std::lround(at.x())), cy = int(std::lround(at.y()));
    std::uint32_t best = kNone;
    float closest = 9.0f;
    for (int y = std::max(0, cy - 2); y <= std::min(map.height - 1, cy + 2); ++y)
      for (int x = std::max(0, cx - 2); x <= std::min(map.width - 1, cx + 2); ++x) {
        const std::size_t texel = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
        if (number[texel] == kNone || chartAt(texel) != chart) continue;
        const float away = (Vec2(float(x), float(y)) - at).squaredNorm();
        if (away < closest) closest = away, best = number[texel];
      }
    return best;
  }

  /// visit(t) for 0 < t < 1 along a border, every half texel.
  template <class Visit>
  void walk(float texels, const Visit& visit) const {
    const int count = std::max(1, int(std::ceil(2.0f * texels)));
    for (int k = 0; k < count; ++k) visit((float(k) + 0.5f) / float(count), 1.0f / float(count));
  }

  void stepsOverBorders() {
    const std::vector<Border> borders = bordersOf(worn.mesh);
    const auto uvAt = [&](const Border& b, float t) -> Vec2 {
      return (1.0f - t) * worn.mesh.uvs[b.from] + t * worn.mesh.uvs[b.to];
    };
    const auto texelsLong = [&](const Border& b) {
      return (worn.mesh.uvs[b.to] - worn.mesh.uvs[b.from])
          .cwiseProduct(Vec2(float(map.width), float(map.height)))
          .norm();
    };
    for (std::size_t i = 0; i < borders.size();) {
      std::size_t end = i + 1;
      while (end < borders.size() && borders[end].key == borders[i].key) ++end;
      const Border& a = borders[i];
      if (end - i == 2) {
        const Border& b = borders[i + 1];
        const float length = (worn.mesh.positions[a.to] - worn.mesh.positions[a.from]).norm();
        walk(std::max(texelsLong(a), texelsLong(b)), [&](float t, float share) {
          const std::uint32_t p = nearest(uvAt(a, t), charts[a.triangle]);
          const std::uint32_t q = nearest(uvAt(b, t), charts[b.triangle]);
          if (p == kNone || q == kNone || p == q) return;
          out.steps.push_back({std::min(p, q), std::max(p, q), share * length});
        });
      } else {
        for (std::size_t k = i; k < end; ++k)
          walk(texelsLong(borders[k]), [&](float t, float) {
            const std::uint32_t p = nearest(uvAt(borders[k], t), charts[borders[k].triangle]);
            if (p != kNone) out.atEnd[p] = 1;
          });
      }
      i = end;
    }
    std::sort(out.steps.begin(), out.steps.end(), [](const Step& x, const Step& y) {
      return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.width < y.width;
    });
    // The same two from several places of a border.
    std::size_t kept = 0;
    for (const Step& step : out.steps) {
      if (kept > 0 && out.steps[kept - 1].a == step.a && out.steps[kept - 1].b == step.b)
        out.steps[kept - 1].width += step.width;
      else
        out.steps[kept++] = step;
    }
    out.steps.resize(kept);
  }
};

}  // namespace

WornTexels texelsOf(const Worn& worn) {
  assert(worn.mesh.uvs.size() == worn.mesh.positions.size());
  assert(worn.tangents.size() == worn.mesh.positions.size());
  scene::Mesh uvs = worn.mesh;  // texels lie by these, whatever else the mesh has
  uvs.texelUvs.clear();
  Builder builder{
      worn, scene::texelMap(uvs, worn.map.width, worn.map.height), chartsOf(worn.mesh), {}, {}};
  builder.texels();
  builder.stepsInCharts();
  builder.stepsOverBorders();
  return std::move(builder.out);
}

Vec2 laidAt(const WornTexels& texels, std::uint32_t texel, const Vec3& d) {
  const Vec2 flat(d.dot(texels.along[texel]), d.dot(texels.across[texel]));
  const float length = flat.norm();
  return length > 0.0f ? Vec2(flat * (d.norm() / length)) : Vec2(Vec2::Zero());
}

}  // namespace lambent::synthesis
