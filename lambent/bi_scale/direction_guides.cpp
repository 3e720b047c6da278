#include "lambent/bi_scale/direction_guides.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lambent/scene/uv_steps.h"
#include "lambent/work/parallel_for.h"

namespace lambent::bi_scale {

namespace {

/// Less than a code value of eight bits and its rounding are apart from grey.
constexpr float kNoOpinion = 0.02f;

/// Red and green as −1 … 1, (0, 0) the upper left corner; the nearest texel's, the picture repeats.
Vec2 arrowAt(const scene::Texture& picture, const Vec2& uv) {
  const auto texel = [](float coordinate, int size) {
    const float fraction = coordinate - std::floor(coordinate);
    return std::clamp(int(fraction * float(size)), 0, size - 1);
  };
  const std::size_t at = std::size_t(texel(uv.y(), picture.height)) * picture.width +
                         std::size_t(texel(uv.x(), picture.width));
  const auto arrow = [&](std::size_t channel) {
    return float(picture.rgba[4 * at + channel]) / 127.5f - 1.0f;
  };
  return Vec2(arrow(0), arrow(1));
}

}  // namespace

std::vector<synthesis::Guide> guidesBy(const CurveSteering& steering, const scene::Mesh& mesh) {
  std::vector<synthesis::Guide> guides(mesh.positions.size());
  const float reach =
      steering.reach > 0.0f ? steering.reach : 0.1f * scene::bounds(mesh).diagonal();
  work::parallelFor(guides.size(), [&](std::size_t v) {
    const Vec3& place = mesh.positions[v];
    float nearest = reach;
    for (const Curve& curve : steering.curves)
      for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
        const Vec3 along = curve[k + 1] - curve[k];
        const float squared = along.squaredNorm();
        if (!(squared > 0.0f)) continue;
        const float at = std::clamp((place - curve[k]).dot(along) / squared, 0.0f, 1.0f);
        const float distance = (curve[k] + at * along - place).norm();
        if (!(distance < nearest)) continue;
        nearest = distance;
        const float share = 1.0f - distance / reach;
        guides[v] = {along / std::sqrt(squared), share * share};
      }
  });
  return guides;
}

Result<std::vector<synthesis::Guide>> guidesBy(const PictureSteering& steering,
                                               const scene::Mesh& mesh) {
  if (mesh.uvs.empty())
    return report::badInput(
        "no texture coordinates for a picture of directions to lie over: give "
        "it some, or steer by curves");
  std::vector<Vec3> sums(mesh.positions.size(), Vec3::Zero());
  std::vector<float> areas(mesh.positions.size(), 0.0f);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const float area =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm();
    const scene::UvSteps steps = scene::uvSteps(mesh, t);
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Vec2 arrow = arrowAt(steering.picture, mesh.uvs[v]);
      areas[v] += area;
      if (arrow.norm() > kNoOpinion)
        sums[v] += area * (arrow.x() * steps.u.stableNormalized() -
                           arrow.y() * steps.v.stableNormalized());
    }
  }
  std::vector<synthesis::Guide> guides(sums.size());
  for (std::size_t v = 0; v < guides.size(); ++v)
    if (areas[v] > 0.0f) guides[v] = {sums[v], std::min(sums[v].norm() / areas[v], 1.0f)};
  return guides;
}

}  // namespace lambent::bi_scale
