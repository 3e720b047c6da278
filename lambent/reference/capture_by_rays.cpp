#include "lambent/reference/capture_by_rays.h"

#include <cassert>
#include <optional>

#include "lambent/sh/basis.h"
#include "lambent/sh/rotation.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/work/flush_denormals.h"
#include "lambent/work/parallel_for.h"

namespace lambent::reference {

std::vector<sh::RgbCoefficients> captureByRays(const capture::MovingScene& scene, double time,
                                               const sh::RgbCoefficients& worldLight,
                                               const Mat4& worldFromAsset,
                                               std::span<const Vec3> points, int bands,
                                               const capture::CubeSize& shape) {
  const Mat3 rotation = worldFromAsset.topLeftCorner<3, 3>();
  const Vec3 translation = worldFromAsset.topRightCorner<3, 1>();
  const sh::RgbCoefficients assetLight =
      worldLight.bands > 0 ? sh::rotate(rotation.transpose(), worldLight) : worldLight;
  const sh::RgbCoefficients distant = sh::withBands(assetLight, bands);
  std::vector<sh::RgbCoefficients> result(points.size(), distant);

  const scene::Scene still = capture::frozen(scene, time);
  const Result<trace::RayScene> rays = trace::RayScene::build(still);
  if (!rays) return result;  // no bodies
  const std::vector<double> weights = capture::cubeWeights(shape, bands);
  work::parallelFor(points.size(), [&](std::size_t p) {
    const work::FlushDenormals flush;
    capture::CubePicture picture{shape,
                                 std::vector<Rgb>(std::size_t(6 * shape.drawn() * shape.drawn()))};
    const Vec3 origin = rotation * points[p] + translation;
    capture::forAllSubTexels(shape, [&](std::size_t, std::size_t at, const Vec3d& direction,
                                        double) {
      const Vec3 away = direction.cast<float>();
      const std::optional<trace::Hit> hit = rays->closest(origin, (rotation * away).normalized());
      picture.texels[at] = Rgb::Zero();
      if (!hit) return;
      if (!hit->backFace)
        picture.texels[at] =
            still.materials[std::size_t(still.meshes[hit->mesh].material)].emission;
      if (assetLight.bands > 0) picture.texels[at] -= sh::reconstruct(assetLight, away);
    });
    const sh::RgbCoefficients difference = capture::project(picture, weights);
    for (std::size_t i = 0; i < difference.values.size(); ++i)
      result[p].values[i] += difference.values[i];
  });
  return result;
}

}  // namespace lambent::reference
