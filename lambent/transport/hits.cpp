#include "lambent/transport/hits.h"

#include <cmath>
#include <optional>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/math/sequences.h"
#include "lambent/transport/packed_colour.h"

namespace lambent::transport {

namespace {

constexpr int kMostMirrors = 64;  ///< in one path; the path tracer stops there as well

/// Where a ray that struck a mirror ends (sloan2002precomputed §5: it is always reflected, until a
/// surface that is no mirror is reached).
struct ChainEnd {
  std::optional<trace::Hit> hit;  ///< none: it left the scene
  Vec3 direction;                 ///< unit, of the last segment
  Rgb throughput;
};

/// No value: the chain met the back of a surface or went on for too long, and carries no light.
std::optional<ChainEnd> followMirrors(const scene::Scene& scene, const trace::RayScene& rays,
                                      std::uint32_t mesh, std::uint32_t triangle, float u, float v,
                                      Vec3 direction) {
  Rgb throughput = Rgb::Ones();
  for (int mirrors = 0; mirrors < kMostMirrors; ++mirrors) {
    const scene::SurfacePoint point = scene::surfaceAt(scene, mesh, triangle, u, v);
    throughput *= point.mirror;
    direction = math::reflectAbout(-direction, point.normal).normalized();
    const Vec3 origin = point.position + rays.offset() * point.normal;
    const std::optional<trace::Hit> next = rays.closest(origin, direction);
    if (!next) return ChainEnd{std::nullopt, direction, throughput};
    if (next->backFace) return std::nullopt;
    if (!scene.materials[scene.meshes[next->mesh].material].isMirror())
      return ChainEnd{next, direction, throughput};
    mesh = next->mesh, triangle = next->triangle, u = next->u, v = next->v;
  }
  return std::nullopt;
}

}  // namespace

void sortHits(const scene::Scene& scene, const trace::RayScene& rays,
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
    if (hit.backFace) {
      ++backFaces;
      continue;
    }
    const Vec2 draw = math::r2(ordinal++, start);
    const trace::RayScene::GlobalTriangle place = rays.locate(hit.globalTriangle);
    if (scene.materials[scene.meshes[place.mesh].material].isMirror()) {
      const auto end = followMirrors(scene, rays, place.mesh, place.triangle, hit.u, hit.v,
                                     directions[hit.direction]);
      if (!end) continue;
      if (!end->hit) {
        escapes.push_back({hit.direction, end->direction, end->throughput});
      } else {
        const std::uint32_t who = drawReceiver(scene, receivers, end->hit->mesh, end->hit->triangle,
                                               end->hit->u, end->hit->v, draw.x(), draw.y());
        const Rgb colour = receivers.meshes[end->hit->mesh].textured
                               ? scene::baseColorAt(scene, end->hit->mesh, end->hit->triangle,
                                                    end->hit->u, end->hit->v)
                               : Rgb(Rgb::Ones());
        hits.mirrored.push_back({who, hit.direction, end->direction, end->throughput * colour});
      }
      continue;
    }
    hits.receiver.push_back(drawReceiver(scene, receivers, place.mesh, place.triangle, hit.u, hit.v,
                                         draw.x(), draw.y()));
    hits.direction.push_back(static_cast<std::uint16_t>(hit.direction));
    if (receivers.meshes[place.mesh].textured)
      hits.colour.push_back(
          packColour(scene::baseColorAt(scene, place.mesh, place.triangle, hit.u, hit.v)));
  }
  counts.backFaces += backFaces;
  if (2 * backFaces > cast.raysCast) ++counts.inside;
}

}  // namespace lambent::transport
