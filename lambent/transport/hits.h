// What the directions of a receiver met, boiled down to what further bounces need.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/trace/cast.h"
#include "lambent/trace/veils.h"
#include "lambent/transport/receivers.h"

namespace lambent::transport {

/// A direction that ended, after one or more mirrors, behind veils, or on one, on a surface that
/// records transfer.
struct MirroredHit {
  std::uint32_t receiver;   ///< who lights: see drawReceiver
  std::uint32_t direction;  ///< as it left
  Vec3 arrival;             ///< unit, as it arrived
  Rgb throughput;           ///< product of reflectances and of what veils let through
};

/// A direction that left the scene after one or more mirrors or veils: direct light by way of them.
struct MirrorEscape {
  std::uint32_t direction;
  Vec3 outward;  ///< unit, as it left the scene
  Rgb throughput;
};

/// One receiver's hits on front faces of surfaces that record transfer, by rising direction.
struct ReceiverHits {
  std::vector<std::uint32_t> receiver;   ///< who lights
  std::vector<std::uint16_t> direction;  ///< from where
  std::vector<MirroredHit> mirrored;

  void clear() { receiver.clear(), direction.clear(), mirrored.clear(); }
};

struct HitCounts {
  std::uint64_t rays = 0;
  std::uint64_t met = 0;        ///< anything at all
  std::uint64_t backFaces = 0;  ///< blocked: from behind, surfaces give no light
  std::uint64_t inside = 0;     ///< receivers most of whose hits are back faces

  HitCounts& operator+=(const HitCounts& other) {
    rays += other.rays, met += other.met;
    backFaces += other.backFaces, inside += other.inside;
    return *this;
  }
  bool operator==(const HitCounts&) const = default;
};

/// Sorts what a cast met from receiver `self` into hits and escapes. Reproducible: cast again, the
/// same records come out.
void sortHits(const scene::Scene& scene, const trace::RayScene& rays, const trace::Veils& veils,
              const PlacedReceivers& receivers, const trace::DirectionSet& directions,
              std::uint32_t self, const trace::CastResult& cast, ReceiverHits& hits,
              std::vector<MirrorEscape>& escapes, HitCounts& counts);

}  // namespace lambent::transport
