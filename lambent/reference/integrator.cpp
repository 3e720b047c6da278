// Unidirectional path tracing. At every diffuse or glossy surface of a path: direct light by a draw
// from the environment and by the draw that continues the path, weighted by the balance heuristic;
// light that comes over mirrors only by the latter, because no draw from the environment can find
// it (a directional light over a mirror is therefore never found). Where surfaces emit, their light
// is found in the same two ways, by a draw from them and by the draw that continues the path.
//
// The conventions are the bake's, so that both converge to the same numbers: rays start on the
// surface lifted by RayScene::offset() along the shading normal; directions behind the shading
// normal bring nothing; back faces block; mirrors reflect about their shading normal and are no
// bounce.
//
// This work is based on:
// - kajiya1986rendering: path tracing.
// - veach1997robust: §9.2 multiple importance sampling, §10.4 Russian roulette.
// - sloan2002precomputed: §4 and §5, what transfer means and which paths it has: (L[S]*p,
//   L[S]*D[S]*p, …).
#include "lambent/reference/integrator.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/directions.h"
#include "lambent/reference/scattering.h"
#include "lambent/scene/coverage.h"

namespace lambent::reference {
namespace {

constexpr int kMostMirrors = 64;  ///< in a row; two mirrors that face each other end somewhere
constexpr int kMostVeils = 1024;  ///< in a row
constexpr int kRouletteDepth = 4;
constexpr float kLeastSurvival = 0.05f;

}  // namespace

Integrator::Integrator(const scene::Scene& scene, const trace::RayScene& rays,
                       const light::Environment& environment, const PathTraceOptions& options)
    : scene_(scene),
      rays_(rays),
      environment_(environment),
      options_(options),
      emitters_(scene),
      veils_(scene),
      layers_(scene) {
  for (const scene::Material& material : scene.materials) hasMirrors_ |= material.isMirror();
}

Vec3 Integrator::lifted(const scene::SurfacePoint& point) const {
  return point.position + rays_.offset() * point.normal;
}

void Integrator::lookFrom(const scene::Camera& camera) {
  const std::optional<light::Sun> sun = light::sunOf(environment_);
  if (!options_.air || !options_.air->shafts || !sun) return;
  shafts_.emplace(*options_.air, rays_, camera, scene::bounds(scene_), ShadowedAir::By::March);
  towardsSun_ = light::pointsOf(*sun, 1).front().direction;
}

/// Of what comes through it, air leaves a share and adds its own.
void Integrator::passAir(const scene::Ray& ray, std::optional<float> distance, int mirrors,
                         Rgb& tint, Rgb& haze) const {
  if (shafts_ && mirrors == 0) haze -= tint * shafts_->missing(ray, distance, towardsSun_);
  if (!distance) return;
  const sky::AirBetween air = options_.air->between(ray.direction, *distance);
  haze += tint * air.inScattered().cast<float>();
  tint *= air.extinction.cast<float>();
}

Rgb Integrator::radianceBehind(const Escaped& escaped) const {
  const Rgb radiance = environment_.radiance(escaped.direction);
  return options_.air ? options_.air->seenBehind(escaped.origin, escaped.direction, radiance)
                      : radiance;
}

/// What a ray meets. Of a veil it meets the surface, or goes on behind it: one of both by chance.
std::optional<trace::Hit> Integrator::met(const Vec3& origin, const Vec3& direction, Rgb& tint,
                                          Sampler& sampler) const {
  std::optional<trace::Hit> hit = rays_.closest(origin, direction);
  for (int veils = 0; hit && veils_.any() && veils_.has(hit->mesh); ++veils) {
    const Rgb passed = veils_.passed(*hit);
    const float there = veils_.coverage(*hit), behind = passed.mean();
    const float chance = behind / std::max(there + behind, 1e-12f);
    if (veils == kMostVeils || !(sampler.next().x() < chance)) {
      tint *= veils == kMostVeils ? 0.0f : there / (1 - chance);
      break;
    }
    tint *= passed / chance;
    hit = rays_.closest(origin, direction, trace::Veils::beyond(*hit));
  }
  return hit;
}

/// Of the layers on a place one, or what they lie on: by chance, as far as each is there.
trace::Hit Integrator::uppermost(trace::Hit hit, Sampler& sampler) const {
  if (!layers_.any()) return hit;
  for (const scene::Layers::Place& on : layers_.above(hit.mesh, hit.triangle, hit.u, hit.v)) {
    const float there = scene::coverageAt(scene_, on.mesh, on.triangle, on.u, on.v);
    if (!(sampler.next().x() < there)) continue;
    hit.mesh = on.mesh, hit.triangle = on.triangle, hit.u = on.u, hit.v = on.v;
    break;
  }
  return hit;
}

Integrator::End Integrator::follow(Vec3 origin, Vec3 direction, int mirrors, Rgb& tint,
                                   Sampler& sampler, Rgb* haze) const {
  for (;; ++mirrors) {
    const std::optional<trace::Hit> hit = met(origin, direction, tint, sampler);
    if (haze && options_.air)
      passAir({origin, direction}, hit ? std::optional(hit->distance) : std::nullopt, mirrors, tint,
              *haze);
    if (!hit) return Escaped{origin, direction, mirrors};
    if (hit->backFace) return Blocked{};
    const trace::Hit top = haze ? uppermost(*hit, sampler) : *hit;
    const scene::SurfacePoint point =
        scene::surfaceAt(scene_, top.mesh, top.triangle, top.u, top.v);
    if (!scene_.materials[scene_.meshes[hit->mesh].material].isMirror())
      return Surface{point, -direction, mirrors};
    if (mirrors == kMostMirrors) return Blocked{};
    tint *= point.mirror;
    direction = math::reflectAbout(-direction, point.normal).normalized();
    origin = lifted(point);
  }
}

Rgb Integrator::leaving(const scene::SurfacePoint& point, const Vec3& toViewer,
                        Sampler& sampler) const {
  if (!(point.mirror.maxCoeff() > 0)) return point.emission + scattered(point, toViewer, sampler);
  Rgb tint = point.mirror;
  const Vec3 away = math::reflectAbout(toViewer, point.normal).normalized();
  const End end = follow(lifted(point), away, 1, tint, sampler);
  if (const auto* escaped = std::get_if<Escaped>(&end))
    return tint * environment_.radiance(escaped->direction);
  if (const auto* surface = std::get_if<Surface>(&end))
    return tint * (surface->point.emission + scattered(surface->point, surface->toViewer, sampler));
  return Rgb::Zero();
}

Integrator::Seen Integrator::seen(const scene::Ray& ray, Sampler& sampler) const {
  Rgb tint = Rgb::Ones(), haze = Rgb::Zero();
  const End end = follow(ray.origin, ray.direction, 0, tint, sampler, &haze);
  if (const auto* surface = std::get_if<Surface>(&end))
    return {haze + tint * (surface->point.emission +
                           scattered(surface->point, surface->toViewer, sampler)),
            1.0f};
  if (const auto* escaped = std::get_if<Escaped>(&end)) {
    if (escaped->mirrors == 0 && !options_.background) return {Rgb::Zero(), 0.0f};
    return {haze + tint * radianceBehind(*escaped), 1.0f};
  }
  return {haze, 1.0f};
}

Rgb Integrator::drawnFromEmitters(const Vec3& origin, const Scattering& scattering,
                                  Sampler& sampler) const {
  const Vec2 place = sampler.next(), choice = sampler.next();
  const Emitters::Sample drawn = emitters_.sample(place, choice.x());
  const Vec3 way = drawn.position - origin;
  const float distance = way.norm();
  if (!(distance > 0)) return Rgb::Zero();
  const Vec3 direction = way / distance;
  const Rgb value = scattering.value(direction);
  const float pdf = emitters_.pdf(drawn.emission, distance, -direction.dot(drawn.normal));
  if (!(value > 0).any() || !std::isfinite(pdf)) return Rgb::Zero();
  // Up to just before the emitter itself.
  const Rgb through = veils_.throughput(rays_, origin, direction, distance * (1 - 1e-4f));
  return value * through * drawn.coverage * drawn.emission / (pdf + scattering.pdf(direction));
}

Rgb Integrator::scattered(scene::SurfacePoint point, Vec3 toViewer, Sampler& sampler) const {
  Rgb sum = Rgb::Zero(), throughput = Rgb::Ones();
  const int bounces = options_.shadows ? options_.bounces : 0;
  for (int bounce = 0;; ++bounce) {
    const Scattering scattering(point, toViewer,
                                options_.shadows ? Horizon::Blocks : Horizon::Open);
    if (scattering.black()) return sum;
    const Vec3 origin = lifted(point);
    const Vec2 lightNumbers = sampler.next(), lobeNumbers = sampler.next(),
               choices = sampler.next();

    const light::Environment::Sample drawn =
        environment_.sample(lightNumbers.x(), lightNumbers.y());
    if (drawn.pdf > 0 && (drawn.radianceOverPdf != 0).any()) {
      const Rgb value = scattering.value(drawn.direction);
      const Rgb through = (value > 0).any() && options_.shadows
                              ? veils_.throughput(rays_, origin, drawn.direction)
                              : Rgb(Rgb::Ones());
      if ((value > 0).any() && (through > 0).any()) {
        const float weight = std::isinf(drawn.pdf)
                                 ? 1.0f
                                 : drawn.pdf / (drawn.pdf + scattering.pdf(drawn.direction));
        sum += throughput * value * through * drawn.radianceOverPdf * weight;
      }
    }

    if (!emitters_.empty() && options_.shadows)
      sum += throughput * drawnFromEmitters(origin, scattering, sampler);

    const Vec3 direction = scattering.draw(lobeNumbers, choices.x());
    const float pdf = scattering.pdf(direction);
    const Rgb value = scattering.value(direction);
    if (!(pdf > 0) || !(value > 0).any()) return sum;
    throughput *= value / pdf;

    End end = Blocked{};
    if (!options_.shadows) {
      end = Escaped{origin, direction, 0};
    } else if (bounce == bounces && !hasMirrors_ && emitters_.empty()) {
      throughput *= veils_.throughput(rays_, origin, direction);
      if ((throughput > 0).any()) end = Escaped{origin, direction, 0};
    } else {
      end = follow(origin, direction, 0, throughput, sampler);
    }
    if (const auto* escaped = std::get_if<Escaped>(&end)) {
      const float weight =
          escaped->mirrors > 0 ? 1.0f : pdf / (pdf + environment_.pdf(escaped->direction));
      return sum + throughput * environment_.radiance(escaped->direction) * weight;
    }
    const auto* surface = std::get_if<Surface>(&end);
    if (!surface) return sum;
    if (surface->point.emission.maxCoeff() > 0) {
      float weight = 1.0f;
      if (surface->mirrors == 0) {
        const float distance = (surface->point.position - origin).norm();
        weight = pdf / (pdf + emitters_.pdf(surface->point.emission, distance,
                                            surface->toViewer.dot(surface->point.geometricNormal)));
      }
      sum += throughput * surface->point.emission * weight;
    }
    if (bounce == bounces) return sum;
    if (bounce >= kRouletteDepth) {
      const float survival = std::clamp(throughput.maxCoeff(), kLeastSurvival, 1.0f);
      if (choices.y() >= survival) return sum;
      throughput /= survival;
    }
    point = surface->point;
    toViewer = surface->toViewer;
  }
}

}  // namespace lambent::reference
