#include "lambent/transport/hits.h"

#include <cmath>
#include <optional>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/math/sequences.h"

namespace lambent::transport {

namespace {

constexpr int kMostMirrors = 64;      ///< in one path; the path tracer stops there as well
constexpr float kLeastLight = 1e-4f;  ///< behind veils: what is less is not followed

/// A ray on its way, and what it met.
struct Segment {
  Vec3 origin, direction;
  std::optional<trace::Hit> hit;  ///< none: it left the scene
  Rgb throughput;                 ///< of all before what it met
};

/// Where a ray that struck a mirror or a veil ends: a mirror always reflects, until a surface that is
/// none is reached (sloan2002precomputed §5); behind a veil a share goes on as it was. What meets the
/// back of a surface, or goes on for too long, carries no light.
std::vector<Segment> endsOf(const scene::Scene& scene, const trace::RayScene& rays,
                            const trace::Veils& veils, Segment first) {
  std::vector<Segment> ends, pending{std::move(first)};
  for (int segments = 0; segments <= kMostMirrors && !pending.empty(); ++segments) {
    Segment at = std::move(pending.back());
    pending.pop_back();
    if (!at.hit) {
      ends.push_back(std::move(at));
      continue;
    }
    const trace::Hit& hit = *at.hit;
    if (veils.has(hit.mesh)) {
      const Rgb passed = at.throughput * veils.passed(hit);
      if (passed.maxCoeff() > kLeastLight)
        pending.push_back({at.origin, at.direction,
                           rays.closest(at.origin, at.direction, trace::Veils::beyond(hit)),
                           passed});
      at.throughput *= veils.coverage(hit);
    }
    if (hit.backFace || !(at.throughput.maxCoeff() > 0.0f)) continue;
    if (!scene.materials[scene.meshes[hit.mesh].material].isMirror()) {
      ends.push_back(std::move(at));
      continue;
    }
    const scene::SurfacePoint point = scene::surfaceAt(scene, hit.mesh, hit.triangle, hit.u, hit.v);
    const Vec3 direction = math::reflectAbout(-at.direction, point.normal).normalized();
    const Vec3 origin = point.position + rays.offset() * point.normal;
    pending.push_back(
        {origin, direction, rays.closest(origin, direction), at.throughput * point.mirror});
  }
  return ends;
}

}  // namespace

void sortHits(const scene::Scene& scene, const trace::RayScene& rays, const trace::Veils& veils,
              const PlacedReceivers& receivers, const trace::DirectionSet& directions,
              std::uint32_t self, const trace::CastResult& cast, ReceiverHits& hits,
              std::vector<MirrorEscape>& escapes, HitCounts& counts) {
  hits.clear();
  escapes.clear();
  counts.rays += cast.raysCast;
  counts.met += cast.hits.size();
  std::uint64_t backFaces = 0;
  // Which corner speaks for a hit is drawn by an additive recurrence with a start of the
  // receiver's own: hits that are neighbours in direction get well-spread numbers.
  math::Random random(0x68697473, self);
  const Vec2 start = random.uniform2();
  std::uint32_t ordinal = 0;
  for (const trace::DirectionHit& hit : cast.hits) {
    const trace::RayScene::GlobalTriangle place = rays.locate(hit.globalTriangle);
    const bool veil = veils.any() && veils.has(place.mesh);
    if (hit.backFace && !veil) {
      ++backFaces;
      continue;
    }
    const Vec2 draw = math::r2(ordinal++, start);
    if (veil || scene.materials[scene.meshes[place.mesh].material].isMirror()) {
      const Vec3& direction = directions[hit.direction];
      Segment first{
          receivers.origins[self], direction,
          trace::Hit{hit.distance, place.mesh, place.triangle, hit.u, hit.v, hit.backFace},
          Rgb::Ones()};
      for (const Segment& end : endsOf(scene, rays, veils, std::move(first))) {
        if (!end.hit) {
          escapes.push_back({hit.direction, end.direction, end.throughput});
          continue;
        }
        const std::uint32_t who = drawReceiver(scene, receivers, end.hit->mesh, end.hit->triangle,
                                               end.hit->u, end.hit->v, draw.x(), draw.y());
        hits.mirrored.push_back({who, hit.direction, end.direction, end.throughput});
      }
      continue;
    }
    hits.receiver.push_back(drawReceiver(scene, receivers, place.mesh, place.triangle, hit.u, hit.v,
                                         draw.x(), draw.y()));
    hits.direction.push_back(static_cast<std::uint16_t>(hit.direction));
  }
  counts.backFaces += backFaces;
  if (2 * backFaces > cast.raysCast) ++counts.inside;
}

}  // namespace lambent::transport
