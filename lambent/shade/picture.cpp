// A picture by one ray for each sub-sample. What is interpolated is what sloan2002precomputed §6
// interpolates on the GPU: over a triangle (or between texels) the exit radiance of a diffuse
// surface, and the lobe-convolved coefficients of transferred radiance of a glossy one, which are
// evaluated per sub-sample (eq. 12). Base colour is looked up per sub-sample. A mirror shows the
// environment, unblocked: "a traditional environment map". With meso-structure it is the light that
// arrives at it that is interpolated, and B(q, v) that is looked up (sloan2003biscale §5).

#include "lambent/shade/picture.h"

#include <map>

#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/lit_patch.h"
#include "lambent/shade/picture_frame.h"
#include "lambent/shade/rtt_footprint.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/work/runner.h"

namespace lambent::shade {
namespace {

struct LitScene {
  const asset::Asset& asset;
  const light::Environment& environment;
  SampleWidth width;
  std::vector<ShownTransfer> transfers;
  std::vector<LitMesh> meshes;
  std::map<std::uint32_t, LitPatch> patches;  ///< of meshes with meso-structure

  Rgb exitRadiance(const trace::Hit& hit, const Vec3& toViewer) const {
    if (hit.backFace) return Rgb::Zero();
    const scene::Scene& scene = asset.scene;
    const scene::Mesh& mesh = scene.meshes[hit.mesh];
    const scene::Material& material = scene.materials[mesh.material];
    const encode::EncodedMesh& transfer = transfers[hit.mesh].get();
    const LitMesh& lit = meshes[hit.mesh];

    const scene::SurfacePoint point = scene::surfaceAt(scene, hit.mesh, hit.triangle, hit.u, hit.v);
    if (transfer.biScale && !material.isMirror())
      return patches.at(hit.mesh).at(hit.triangle, hit.u, hit.v, point, toViewer,
                                     width.at(hit.distance));
    const Rgb base = baseColorAt(scene, hit.mesh, hit.triangle, hit.u, hit.v);
    const Vec3 reflected = mirrored(toViewer, point.normal);
    if (material.isMirror()) return material.mirror * base * environment.radiance(reflected);
    if (transfer.layout == transport::Layout::None) return Rgb::Zero();

    const Receivers at = transfer.layout == transport::Layout::Texels
                             ? Receivers::ofTexels(transfer.width, transfer.height, point.uv)
                             : Receivers::ofTriangle(mesh.triangles[hit.triangle], hit.u, hit.v);
    const Rgb diffuse = lit.diffuseAt(at);
    return (lit.albedoOutside ? Rgb(diffuse * base) : diffuse) + lit.glossyAt(at, reflected) * base;
  }
};

}  // namespace

Result<image::Image> picture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                             const light::Environment& environment, const scene::Camera& camera,
                             const PictureOptions& options, const Progress& progress) {
  if (Status s = checkPicture(asset, light, camera, options); !s) return s.error();
  Result<trace::RayScene> rays = trace::RayScene::build(asset.scene);
  if (!rays) return rays.error();

  LitScene lit{asset, environment, sampleWidth(camera, options.height, options.samples),
               {},    {},          {}};
  RttPyramids pyramids(asset.transfer, options.biScale.filter);
  lit.transfers.reserve(asset.transfer.meshes.size());  // patches hold on to them
  for (std::uint32_t m = 0; m < asset.transfer.meshes.size(); ++m) {
    const encode::EncodedMesh& mesh =
        lit.transfers.emplace_back(asset, m, options.transfer, options.biScale.macro).get();
    lit.meshes.push_back(lightMesh(mesh, light, options.lobeExponent));
    if (mesh.biScale)
      lit.patches.emplace(m, LitPatch(asset.scene.meshes[m], mesh, asset.transfer,
                                      pyramids.of(mesh.biScale->rtt), light, options.biScale));
  }

  const int width = options.width, height = options.height;
  const std::vector<Vec2> positions = scene::subpixelPositions(options.samples);
  const float share = 1.0f / float(positions.size());
  image::Image image(width, height);
  image.alpha.resize(image.pixels.size());

  const work::Runner runner(progress, options.threads);
  const work::Chunks rows(image.pixels.size(), std::size_t(width));
  const Status whole = runner.run({"picture", "pixels"}, rows, [&](const work::Chunk& row) {
    const int y = int(row.index);
    for (int x = 0; x < width; ++x) {
      Rgb sum = Rgb::Zero();
      int covered = 0;
      for (const Vec2& p : positions) {
        const scene::Ray ray = scene::cameraRay(camera, width, height, x + p.x(), y + p.y());
        const std::optional<trace::Hit> hit = rays->closest(ray.origin, ray.direction);
        if (!hit) continue;
        ++covered;
        sum += lit.exitRadiance(*hit, -ray.direction);
      }
      image.at(x, y) = share * sum;
      image.alpha[std::size_t(y) * width + x] = float(covered) / float(positions.size());
    }
  });
  if (!whole) return whole.error();
  finishPicture(image, environment, camera, options);
  return image;
}

}  // namespace lambent::shade
