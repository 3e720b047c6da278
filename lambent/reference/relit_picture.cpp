// A picture by one ray for each sub-sample. What is interpolated is what sloan2002precomputed §6
// interpolates on the GPU: over a triangle (or between texels) the exit radiance of a diffuse
// surface, and the lobe-convolved coefficients of transferred radiance of a glossy one, which are
// evaluated per sub-sample (eq. 12). Base colour is looked up per sub-sample. A ray meets what
// layers lie on, and sees them, uppermost first, each in the share that is there. A mirror shows what
// the mirrored ray meets, lit as anything that is seen, and the environment where that leaves;
// mirrors show mirrors, a few in a row. With meso-structure it is the light that arrives at it that
// is interpolated, and B(q, v) that is looked up (sloan2003biscale §5). Under a sharp Sun each
// sub-sample asks by one ray whether its own point of the Sun's disc is seen: rays start where
// those of the path tracer do, and are blocked by fronts and backs alike.

#include "lambent/reference/relit_picture.h"

#include <map>

#include "lambent/reference/shadowed_air.h"
#include "lambent/scene/layers.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/lit_patch.h"
#include "lambent/shade/picture_frame.h"
#include "lambent/shade/rtt_footprint.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/trace/veils.h"
#include "lambent/work/runner.h"

namespace lambent::reference {
namespace {

using transfer::Numbers;
constexpr int kMostSeenThrough = 256;  ///< seen through, in a row
constexpr int kMirrorsInARow = 8;      ///< in a row; the last one shows the environment alone

using Surface = transfer::Surface<Numbers>;
using BiScale = transfer::BiScale<Numbers>;

/// What a ray sees: radiance, and the share of what is behind everything that is seen as well.
struct SeenThrough {
  Rgb radiance = Rgb::Zero();
  Rgb through = Rgb::Ones();
};

/// How a ray came to be.
struct Sight {
  const light::SunPoint* sun = nullptr;  ///< null without a sharp one
  const ShadowedAir* shafts = nullptr;   ///< from the eye alone; null without
  float distance = 0.0f;                 ///< from the eye to the ray's origin, by way of mirrors
  int mirrors = 0;                       ///< on that way
};

struct LitScene {
  const asset::Asset& asset;
  const trace::RayScene& rays;
  const trace::Veils veils;
  const scene::Layers layers;
  const light::Environment& environment;
  const shade::PictureOptions& options;
  shade::SampleWidth width;
  std::vector<shade::LitMesh> meshes;                ///< of bare surfaces
  std::map<std::uint32_t, shade::LitPatch> patches;  ///< of meshes with meso-structure

  /// What falls directly from a point of a sharp Sun and is sent on by a diffuse surface.
  Rgb sunlit(const scene::SurfacePoint& point, transfer::Kind direct,
             const light::SunPoint& sun) const {
    const float cosine = point.normal.dot(sun.direction);
    if (!(cosine > 0)) return Rgb::Zero();
    const Rgb sent = point.diffuse * sun.irradiance * (cosine / float(kPi));
    if (direct == transfer::Kind::Unshadowed) return sent;
    return sent *
           veils.throughput(rays, point.position + rays.offset() * point.normal, sun.direction);
  }

  Rgb exitRadiance(const trace::Hit& hit, const Vec3& toViewer, const Sight& sight) const {
    if (hit.backFace) return Rgb::Zero();
    const scene::Scene& scene = asset.scene;
    const scene::Mesh& mesh = scene.meshes[hit.mesh];
    const scene::Material& material = scene.materials[mesh.material];

    const scene::SurfacePoint point = scene::surfaceAt(scene, hit.mesh, hit.triangle, hit.u, hit.v);
    const float distance = sight.distance + hit.distance;
    const Rgb base = scene::baseColorAt(scene, hit.mesh, hit.triangle, hit.u, hit.v);
    const auto patch = patches.find(hit.mesh);
    if (patch != patches.end() && !material.isMirror())
      return base *
             patch->second.at(hit.triangle, hit.u, hit.v, point, toViewer, width.at(distance));
    if (material.isMirror())
      return material.mirror * base *
             shownByMirror(point, shade::mirrored(toViewer, point.normal),
                           {sight.sun, nullptr, distance, sight.mirrors + 1});
    const auto* surface = std::get_if<Surface>(&asset.transfer.meshes[hit.mesh]);
    if (!surface) return Rgb::Zero();

    const transfer::AtTexels* grid = surface->receivers->texels();
    const shade::ReceiverWeights at =
        grid ? shade::ReceiverWeights::ofTexels(grid->width, grid->height, point.texelUv)
             : shade::ReceiverWeights::ofTriangle(mesh.triangles[hit.triangle], hit.u, hit.v);
    const shade::LitMesh& lit = meshes[hit.mesh];
    const Rgb diffuse = lit.diffuseAt(at);
    Rgb sum = (lit.albedoOutside ? Rgb(diffuse * base) : diffuse) +
              lit.glossyAt(at, toViewer, point.normal) * base;
    if (!sight.sun) return sum;
    if (const auto direct =
            shade::kindWithoutBounces(asset.transfer.meshes[hit.mesh], options.showing))
      sum += sunlit(point, *direct, *sight.sun);
    return sum;
  }

  Rgb shownByMirror(const scene::SurfacePoint& point, const Vec3& direction,
                    const Sight& sight) const {
    SeenThrough seen;
    if (sight.mirrors <= kMirrorsInARow)
      seen = this->seen({point.position + rays.offset() * point.normal, direction}, sight);
    if (!(seen.through.maxCoeff() > 0.0f)) return seen.radiance;
    const Rgb shown = environment.radiance(direction);
    return seen.radiance +
           seen.through *
               (options.air ? options.air->seenBehind(point.position, direction, shown) : shown);
  }

  /// What leaves the place that a ray met, with all that lies on it.
  Rgb seenAt(const trace::Hit& hit, const Vec3& toViewer, const Sight& sight) const {
    Rgb sum = Rgb::Zero();
    float through = 1.0f;
    if (layers.any() && !hit.backFace) {
      for (const scene::Layers::Place& place : layers.above(hit.mesh, hit.triangle, hit.u, hit.v)) {
        const float there =
            scene::coverageAt(asset.scene, place.mesh, place.triangle, place.u, place.v);
        if (!(there > 0.0f)) continue;
        trace::Hit on = hit;
        on.mesh = place.mesh, on.triangle = place.triangle;
        on.u = place.u, on.v = place.v;
        sum += through * there * exitRadiance(on, toViewer, sight);
        through *= 1.0f - there;
        if (!(through > 0.0f)) return sum;
      }
    }
    return sum + through * exitRadiance(hit, toViewer, sight);
  }

  /// Nearest first, until nothing is seen through what was met.
  SeenThrough seen(const scene::Ray& ray, const Sight& sight) const {
    SeenThrough out;
    Rgb& through = out.through;
    float tNear = 0.0f;
    for (int passed = 0; passed < kMostSeenThrough; ++passed) {
      const std::optional<trace::Hit> hit = rays.closest(ray.origin, ray.direction, tNear);
      if (!hit) {
        if (sight.shafts && options.background)
          out.radiance -= through * sight.shafts->missing(ray, {}, sight.sun->direction);
        break;
      }
      const bool veil = veils.any() && veils.has(hit->mesh);
      const Rgb share = veil ? Rgb(through * veils.coverage(*hit)) : through;
      Rgb radiance = seenAt(*hit, -ray.direction, sight);
      if (options.air) radiance = options.air->seen(ray.direction, hit->distance, radiance);
      if (sight.shafts) radiance -= sight.shafts->missing(ray, hit->distance, sight.sun->direction);
      out.radiance += share * radiance;
      if (!veil) {
        through = Rgb::Zero();
        break;
      }
      through *= veils.passed(*hit);
      if (!(through.maxCoeff() > 1e-4f)) break;
      tNear = trace::Veils::beyond(*hit);
    }
    return out;
  }
};

}  // namespace

Result<image::Image> relitPicture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                  const light::Environment& environment,
                                  const scene::Camera& camera, const shade::PictureOptions& options,
                                  const Progress& progress) {
  if (Status s = shade::checkPicture(asset, light, camera, options); !s) return s.error();
  Result<trace::RayScene> rays = trace::RayScene::build(asset.scene);
  if (!rays) return rays.error();

  LitScene lit{asset,
               *rays,
               trace::Veils(asset.scene),
               scene::Layers(asset.scene),
               environment,
               options,
               shade::sampleWidth(camera, options.height, options.samples),
               {},
               {}};
  shade::RttPyramids pyramids(asset.transfer, options.showing.filter);
  for (std::uint32_t m = 0; m < asset.transfer.meshes.size(); ++m) {
    lit.meshes.push_back(shade::lightSurface(asset, m, light, options.showing, options.sun));
    if (const auto* biScale = std::get_if<BiScale>(&asset.transfer.meshes[m]))
      lit.patches.emplace(
          m, shade::LitPatch(asset, m, pyramids.of(biScale->patch.rtt), light, options.showing));
  }

  const int width = options.width, height = options.height;
  const std::vector<Vec2> positions = scene::subpixelPositions(options.samples);
  const float share = 1.0f / float(positions.size());
  std::vector<light::SunPoint> sun;
  if (options.sun) sun = light::pointsOf(options.sun->sun, options.samples);
  std::optional<ShadowedAir> shafts;
  if (options.air && options.air->shafts)
    shafts.emplace(*options.air, *rays, camera, scene::bounds(asset.scene),
                   ShadowedAir::By::Planes);
  image::Image image(width, height);
  image.alpha.resize(image.pixels.size());

  const work::Runner runner(progress);
  const work::Chunks rows(image.pixels.size(), std::size_t(width));
  const Status whole = runner.run({"picture", "pixels"}, rows, [&](const work::Chunk& row) {
    const int y = int(row.index);
    for (int x = 0; x < width; ++x) {
      Rgb sum = Rgb::Zero();
      double covered = 0.0;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec2& p = positions[i];
        const scene::Ray ray = scene::cameraRay(camera, width, height, x + p.x(), y + p.y());
        const SeenThrough seen =
            lit.seen(ray, {sun.empty() ? nullptr : &sun[i], shafts ? &*shafts : nullptr});
        sum += seen.radiance;
        covered += 1.0 - double(seen.through.mean());
      }
      image.at(x, y) = share * sum;
      image.alpha[std::size_t(y) * width + x] = float(covered / double(positions.size()));
    }
  });
  if (!whole) return whole.error();
  shade::finishPicture(image, environment, camera, options);
  return image;
}

}  // namespace lambent::reference
