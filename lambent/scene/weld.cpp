#include "lambent/scene/weld.h"

#include <bit>
#include <unordered_map>

namespace lambent::scene {
namespace {

struct PositionHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (std::uint32_t b : bits) h = (h ^ b) * 0xff51afd7ed558ccdull, h ^= h >> 32;
    return std::size_t(h);
  }
};

}  // namespace

std::vector<std::uint32_t> weldPositions(const Mesh& mesh) {
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, PositionHash> known;
  known.reserve(mesh.positions.size());
  std::vector<std::uint32_t> ids(mesh.positions.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Vec3 p = mesh.positions[i] + Vec3::Zero();
    const std::array<std::uint32_t, 3> bits = {std::bit_cast<std::uint32_t>(p.x()),
                                               std::bit_cast<std::uint32_t>(p.y()),
                                               std::bit_cast<std::uint32_t>(p.z())};
    ids[i] = known.try_emplace(bits, std::uint32_t(known.size())).first->second;
  }
  return ids;
}

}  // namespace lambent::scene
