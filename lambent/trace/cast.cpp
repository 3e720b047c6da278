#include "lambent/trace/cast.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "lambent/trace/embree_scene.h"

namespace lambent::trace {

namespace {

constexpr int kPacket = DirectionSet::kBundle;

/// Closes up the directions above the horizon. Whole bundles are copied; only those that the
/// horizon cuts are looked at one by one.
void selectHemisphere(const DirectionSet& set, const Vec3& normal, CastResult::Active& active) {
  const std::size_t room = set.x().size() + 2 * kPacket;
  if (active.index.size() < room) {
    active.x.resize(room), active.y.resize(room), active.z.resize(room);
    active.index.resize(room);
  }
  const float *x = set.x().data(), *y = set.y().data(), *z = set.z().data();
  float *ox = active.x.data(), *oy = active.y.data(), *oz = active.z.data();
  std::uint32_t* id = active.index.data();
  const std::span<const DirectionSet::Bundle> bundles = set.bundles();
  std::size_t n = 0;
  for (std::size_t b = 0; b < bundles.size(); ++b) {
    const float height = bundles[b].axis.dot(normal);
    if (height <= -bundles[b].sinAngle) continue;
    const std::size_t first = b * kPacket;
    const std::size_t last = std::min(first + kPacket, set.size());
    if (height > bundles[b].sinAngle && last == first + kPacket) {
      std::memcpy(ox + n, x + first, kPacket * sizeof(float));
      std::memcpy(oy + n, y + first, kPacket * sizeof(float));
      std::memcpy(oz + n, z + first, kPacket * sizeof(float));
      for (int k = 0; k < kPacket; ++k) id[n + k] = static_cast<std::uint32_t>(first + k);
      n += kPacket;
      continue;
    }
    for (std::size_t i = first; i < last; ++i) {
      ox[n] = x[i], oy[n] = y[i], oz[n] = z[i], id[n] = static_cast<std::uint32_t>(i);
      n += x[i] * normal.x() + y[i] * normal.y() + z[i] * normal.z() > 0.0f;
    }
  }
  active.count = n;
  // The last packet is filled up with rays that are switched off but well formed.
  for (std::size_t k = n; k % kPacket != 0; ++k)
    ox[k] = normal.x(), oy[k] = normal.y(), oz[k] = normal.z(), id[k] = 0;
}

/// The members of a packet that stay the same for all casts from one point.
void setUp(RTCRay16& ray, const Vec3& origin) {
  for (int k = 0; k < kPacket; ++k) {
    ray.org_x[k] = origin.x(), ray.org_y[k] = origin.y(), ray.org_z[k] = origin.z();
    ray.tnear[k] = 0.0f, ray.time[k] = 0.0f;
    ray.mask[k] = ~0u, ray.id[k] = 0, ray.flags[k] = 0;
  }
}

void aim(RTCRay16& ray, const CastResult::Active& active, std::size_t first) {
  std::memcpy(ray.dir_x, active.x.data() + first, sizeof(ray.dir_x));
  std::memcpy(ray.dir_y, active.y.data() + first, sizeof(ray.dir_y));
  std::memcpy(ray.dir_z, active.z.data() + first, sizeof(ray.dir_z));
  for (float& far : ray.tfar) far = std::numeric_limits<float>::infinity();
}

void validateLanes(int (&valid)[kPacket], std::size_t remaining) {
  for (int k = 0; k < kPacket; ++k) valid[k] = static_cast<std::size_t>(k) < remaining ? -1 : 0;
}

void reserve(std::vector<std::uint32_t>& list, std::size_t count) {
  if (list.size() < count) list.resize(count);
}

}  // namespace

void castOcclusion(const RayScene& scene, const DirectionSet& directions, const Vec3& origin,
                   const Vec3& normal, CastResult& result) {
  selectHemisphere(directions, normal, result.active);
  const CastResult::Active& active = result.active;
  result.raysCast = active.count;
  result.hits.clear();
  reserve(result.occluded, directions.size()), reserve(result.visible, directions.size());
  std::uint32_t *occluded = result.occluded.data(), *visible = result.visible.data();

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  alignas(64) RTCRay16 ray;
  alignas(64) int valid[kPacket];
  setUp(ray, origin);
  for (std::size_t first = 0; first < active.count; first += kPacket) {
    const std::size_t lanes = std::min<std::size_t>(kPacket, active.count - first);
    validateLanes(valid, lanes);
    aim(ray, active, first);
    rtcOccluded16(valid, scene.impl().scene, &context, &ray);
    for (std::size_t k = 0; k < lanes; ++k) {
      const bool blocked = ray.tfar[k] < 0.0f;
      *occluded = active.index[first + k], occluded += blocked;
      *visible = active.index[first + k], visible += !blocked;
    }
  }
  result.occludedCount = static_cast<std::size_t>(occluded - result.occluded.data());
  result.visibleCount = static_cast<std::size_t>(visible - result.visible.data());
}

void castClosest(const RayScene& scene, const DirectionSet& directions, const Vec3& origin,
                 const Vec3& normal, CastResult& result) {
  selectHemisphere(directions, normal, result.active);
  const CastResult::Active& active = result.active;
  result.raysCast = active.count;
  result.hits.clear();
  reserve(result.occluded, directions.size()), reserve(result.visible, directions.size());
  std::uint32_t *occluded = result.occluded.data(), *visible = result.visible.data();

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) RTCRayHit16 query;
  alignas(64) int valid[kPacket];
  setUp(query.ray, origin);
  for (std::size_t first = 0; first < active.count; first += kPacket) {
    const std::size_t lanes = std::min<std::size_t>(kPacket, active.count - first);
    validateLanes(valid, lanes);
    aim(query.ray, active, first);
    for (int k = 0; k < kPacket; ++k) {
      query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene.impl().scene, &context, &query);
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::uint32_t direction = active.index[first + k];
      if (query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) {
        *visible++ = direction;
        continue;
      }
      *occluded++ = direction;
      const float facing = query.hit.Ng_x[k] * query.ray.dir_x[k] +
                           query.hit.Ng_y[k] * query.ray.dir_y[k] +
                           query.hit.Ng_z[k] * query.ray.dir_z[k];
      DirectionHit& hit =
          result.hits.emplace_back(DirectionHit{direction, query.hit.primID[k], query.ray.tfar[k],
                                                query.hit.u[k], query.hit.v[k], facing > 0.0f});
      scene.impl().nameSide(query.hit.geomID[k], hit.globalTriangle, hit.u, hit.v, hit.backFace);
    }
  }
  result.occludedCount = static_cast<std::size_t>(occluded - result.occluded.data());
  result.visibleCount = static_cast<std::size_t>(visible - result.visible.data());
}

}  // namespace lambent::trace
