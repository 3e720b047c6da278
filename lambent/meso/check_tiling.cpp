#include "lambent/meso/check_tiling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <tuple>
#include <vector>

namespace lambent::meso {

namespace {

std::string text(double number) {
  std::ostringstream out;
  out.precision(3);
  out << number;
  return out.str();
}

constexpr const char* kAxis[2] = {"x", "y"};

}  // namespace

Findings checkTiling(const HeightField& field) {
  Findings findings;
  for (int axis = 0; axis < 2; ++axis) {
    const int length = axis == 0 ? field.width : field.height;
    const int lines = axis == 0 ? field.height : field.width;
    const auto at = [&](int along, int line) {
      return double(axis == 0 ? field.at(along, line) : field.at(line, along));
    };
    double across = 0.0, inside = 0.0, worst = -1.0;
    int worstLine = 0;
    for (int line = 0; line < lines; ++line) {
      for (int k = 0; k + 1 < length; ++k)
        inside += std::pow(at(k + 1, line) - at(k, line), 2) / (length - 1);
      const double jump = std::abs(at(0, line) - at(length - 1, line));
      across += jump * jump;
      if (jump > worst) worst = jump, worstLine = line;
    }
    inside = std::sqrt(inside / lines), across = std::sqrt(across / lines);
    if (!(across > 3.0 * inside) || across <= 0.0) continue;
    findings.push_back({Severity::Warning, "height-field-seam",
                        std::string("the heights do not tile along ") + kAxis[axis] +
                            ": across the border they " + "jump by " + text(across) +
                            " m, inside neighbours differ by " + text(inside) +
                            " m (root mean squares); worst, " + text(worst) + " m, in " +
                            (axis == 0 ? "row " : "column ") + std::to_string(worstLine) +
                            (axis == 0 ? " from below" : "") +
                            ". Use a picture that tiles, or blend its borders (--blend 0.1)",
                        static_cast<std::uint64_t>(lines)});
  }
  return findings;
}

namespace {

using Edge = std::array<Vec3, 2>;

/// Edges of one triangle only, vertices of equal position taken as one.
std::vector<Edge> openEdges(const scene::Scene& scene) {
  std::map<std::tuple<float, float, float>, std::uint32_t> welded;
  std::vector<Vec3> positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const scene::Mesh& mesh : scene.meshes)
    for (const scene::Triangle& t : mesh.triangles) {
      std::uint32_t corner[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3& p = mesh.positions[t[k]];
        const auto [at, isNew] = welded.emplace(std::tuple(p.x(), p.y(), p.z()),
                                                static_cast<std::uint32_t>(positions.size()));
        if (isNew) positions.push_back(p);
        corner[k] = at->second;
      }
      for (int k = 0; k < 3; ++k) ++uses[std::minmax(corner[k], corner[(k + 1) % 3])];
    }
  std::vector<Edge> open;
  for (const auto& [edge, count] : uses)
    if (count == 1 && edge.first != edge.second)
      open.push_back({positions[edge.first], positions[edge.second]});
  return open;
}

bool same(const Edge& a, const Edge& b, float tolerance) {
  const auto near = [tolerance](const Vec3& p, const Vec3& q) {
    return (p - q).cwiseAbs().maxCoeff() <= tolerance;
  };
  return (near(a[0], b[0]) && near(a[1], b[1])) || (near(a[0], b[1]) && near(a[1], b[0]));
}

}  // namespace

Findings checkTiling(const Patch& patch) {
  Findings findings;
  const std::vector<Edge> open = openEdges(patch.scene);
  const scene::Box box = scene::bounds(patch.scene);
  for (int axis = 0; axis < 2; ++axis) {
    const float tolerance = 1e-3f * patch.size[axis];
    const auto lies = [&](const Edge& edge, float where) {
      return std::abs(edge[0][axis] - where) <= tolerance &&
             std::abs(edge[1][axis] - where) <= tolerance;
    };
    std::vector<Edge> low, high;
    for (const Edge& edge : open) {
      if (lies(edge, box.lower[axis])) low.push_back(edge);
      if (lies(edge, box.upper[axis])) high.push_back(edge);
    }
    // Along the border, so that partners are looked for among few. Any open edge may be one: the
    // ends of threads that reach over the period do not lie at the box's other side.
    const int other = 1 - axis;
    const auto middle = [other](const Edge& e) { return 0.5f * (e[0][other] + e[1][other]); };
    const auto before = [&](const Edge& a, const Edge& b) { return middle(a) < middle(b); };
    std::vector<Edge> sorted = open;
    std::sort(sorted.begin(), sorted.end(), before);
    const auto unmatched = [&](const std::vector<Edge>& from, float shift) {
      std::vector<Edge> alone;
      for (Edge edge : from) {
        for (Vec3& p : edge) p[axis] += shift;
        Edge key = edge;
        for (Vec3& p : key) p[other] -= 2.0f * tolerance;
        bool found = false;
        for (auto it = std::lower_bound(sorted.begin(), sorted.end(), key, before);
             it != sorted.end() && middle(*it) <= middle(edge) + 2.0f * tolerance && !found; ++it)
          found = same(edge, *it, tolerance);
        if (!found) alone.push_back(edge);
      }
      return alone;
    };
    const std::vector<Edge> a = unmatched(low, patch.size[axis]);
    const std::vector<Edge> b = unmatched(high, -patch.size[axis]);
    if (a.empty() && b.empty()) continue;
    const Edge& example = a.empty() ? b.front() : a.front();
    findings.push_back({Severity::Warning, "mesh-seam",
                        std::string("the mesh does not tile along ") + kAxis[axis] + ": " +
                            std::to_string(a.size() + b.size()) + " of " +
                            std::to_string(low.size() + high.size()) +
                            " open edges at its sides have no partner a period of " +
                            text(patch.size[axis]) + " m further on (it spans " +
                            text(box.upper[axis] - box.lower[axis]) + " m); the first at " +
                            kAxis[other] + " = " + text(middle(example)) +
                            " m, z = " + text(example[0].z()) +
                            " m. Give the right period (--size), or make opposite sides alike",
                        a.size() + b.size()});
  }
  return findings;
}

}  // namespace lambent::meso
