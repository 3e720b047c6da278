#include "lambent/shade/check_bi_scale.h"

#include <cmath>

#include <fmt/format.h>

#include "lambent/shade/macro_transport.h"

namespace lambent::shade {
namespace {

using encode::EncodedBiScale;
using encode::EncodedMesh;
using encode::EncodedRtt;

/// How far tangents may be from unit length and from right angles with the normals.
constexpr float kTangentTolerance = 0.02f;

Status checkRtt(const std::string& where, const EncodedRtt& rtt) {
  if (rtt.width < 1 || rtt.height < 1 || rtt.views < 1)
    return report::badInput(
        fmt::format("{} has {}×{} positions and {}×{} views, where one of each is the least", where,
                    rtt.width, rtt.height, rtt.views, rtt.views));
  if (rtt.bands < 1 || rtt.bands > sh::kMaxBands)
    return report::badInput(
        fmt::format("{} has {} bands, where 1 to {} can be", where, rtt.bands, sh::kMaxBands));
  if (!(rtt.size.x() > 0.0f && rtt.size.y() > 0.0f) || !rtt.size.allFinite())
    return report::badInput(fmt::format("{} measures {}×{} m, which is no size of a patch", where,
                                        rtt.size.x(), rtt.size.y()));
  return checkNumbers(where, rtt.values,
                      std::size_t(rtt.width) * rtt.height * rtt.views * rtt.views * 3 *
                          sh::coefficientCount(rtt.bands));
}

Status checkTangents(const std::string& where, const EncodedMesh& mesh) {
  const std::vector<Vec3>& tangents = mesh.biScale->tangents;
  if (tangents.size() != mesh.receiverCount())
    return report::badInput(fmt::format("{}: {} tangents for {} receivers. Make the asset again",
                                        where, tangents.size(), mesh.receiverCount()));
  for (std::size_t p = 0; p < tangents.size(); ++p) {
    const float lean = tangents[p].dot(mesh.normals[p]);
    if (!(std::abs(tangents[p].norm() - 1.0f) < kTangentTolerance &&
          std::abs(lean) < kTangentTolerance))
      return report::badInput(fmt::format(
          "{}: the tangent of receiver {} is ({}, {}, {}), which is not a unit vector at right "
          "angles to its normal. Make the asset again",
          where, p, tangents[p].x(), tangents[p].y(), tangents[p].z()));
  }
  return Status::ok();
}

Status checkPlacement(const std::string& where, const EncodedBiScale& biScale,
                      const scene::Mesh& mesh) {
  if (mesh.uvs.size() != mesh.positions.size())
    return report::badInput(
        fmt::format("{}: {} texture coordinates for {} vertices, which place the patch", where,
                    mesh.uvs.size(), mesh.positions.size()));
  if (!(biScale.scale > 0.0f) || !std::isfinite(biScale.scale))
    return report::badInput(
        fmt::format("{}: a patch at scale {}, which must be above 0", where, biScale.scale));
  if (const std::optional<synthesis::IdMap>& map = biScale.idMap) {
    if (map->width < 1 || map->height < 1 || map->ids.size() != 2 * map->texelCount())
      return report::badInput(
          fmt::format("{}: an id map of {}×{} texels that holds {} numbers, where two a texel must "
                      "be. Make the asset again",
                      where, map->width, map->height, map->ids.size()));
  } else if (!biScale.tiles.allFinite() || biScale.tiles.x() == 0.0f || biScale.tiles.y() == 0.0f) {
    return report::badInput(
        fmt::format("{}: the patch is repeated {}×{} times, which covers "
                    "nothing",
                    where, biScale.tiles.x(), biScale.tiles.y()));
  }
  return Status::ok();
}

Status checkMatrices(const std::string& where, const EncodedMesh& mesh) {
  const EncodedBiScale& biScale = *mesh.biScale;
  if (biScale.shadowed.empty() && biScale.interreflected.empty()) return Status::ok();
  if (biScale.bands < 1 || biScale.bands > sh::kMaxBands)
    return report::badInput(fmt::format("{}: macro transfer of {} bands, where 1 to {} can be",
                                        where, biScale.bands, sh::kMaxBands));
  const std::size_t n = std::size_t(sh::coefficientCount(biScale.bands));
  const std::size_t each = mesh.receiverCount() * n * n;
  if (!biScale.shadowed.empty())
    if (Status s = checkNumbers(where + ": its shadowed macro transfer", biScale.shadowed, each);
        !s)
      return s;
  if (biScale.interreflected.empty()) return Status::ok();
  if (biScale.channels != 1 && biScale.channels != 3)
    return report::badInput(
        fmt::format("{}: macro transfer of {} channels, where 1 or 3 can be. Make the asset again",
                    where, biScale.channels));
  return checkNumbers(where + ": its interreflected macro transfer", biScale.interreflected,
                      each * std::size_t(biScale.channels));
}

Status checkMesh(const std::string& where, const asset::Asset& asset, std::size_t index,
                 const BiScaleOptions& options) {
  const EncodedMesh& mesh = asset.transfer.meshes[index];
  const EncodedBiScale& biScale = *mesh.biScale;
  if (mesh.layout != transport::Layout::Vertices || mesh.normals.size() != mesh.receiverCount() ||
      asset.scene.meshes[index].positions.size() != mesh.receiverCount())
    return report::badInput(
        fmt::format("{}: meso-structure needs a receiver with a normal at every vertex", where));
  if (!mesh.vectors.empty() || !mesh.matrices.empty())
    return report::badInput(
        fmt::format("{}: a mesh with meso-structure has its light from macro transfer; it cannot "
                    "have transfer vectors or glossy matrices as well",
                    where));
  const std::size_t rtts = asset.transfer.rtts.size();
  if (biScale.rtt < 0 || std::size_t(biScale.rtt) >= rtts)
    return report::badInput(
        fmt::format("{}: it wears radiance transfer texture {}, but the asset holds {}", where,
                    biScale.rtt, rtts));
  const EncodedRtt& rtt = asset.transfer.rtts[std::size_t(biScale.rtt)];
  if (Status s = checkRtt(
          fmt::format("{}: radiance transfer texture {} '{}'", where, biScale.rtt, rtt.name), rtt);
      !s)
    return s;
  if (Status s = checkTangents(where, mesh); !s) return s;
  if (Status s = checkPlacement(where, biScale, asset.scene.meshes[index]); !s) return s;
  if (Status s = checkMatrices(where, mesh); !s) return s;
  if (options.macro && !holds(biScale, *options.macro))
    return report::badUsage(fmt::format(
        "{} holds no {} macro transport (it holds: {}). Bake it with '--transfer {}', or ask for "
        "what is there",
        where, nameOf(*options.macro), heldBy(biScale), nameOf(*options.macro)));
  return Status::ok();
}

}  // namespace

Status checkNumbers(const std::string& what, const encode::Numbers& numbers, std::size_t expected) {
  if (numbers.size() != expected)
    return report::badInput(
        fmt::format("{}: it holds {} numbers, but should hold {}. Make the "
                    "asset again",
                    what, numbers.size(), expected));
  if (numbers.encoding == encode::Encoding::Snorm8 && expected > 0 &&
      (numbers.block == 0 || expected % numbers.block != 0 ||
       numbers.scales.size() != expected / numbers.block))
    return report::badInput(
        fmt::format("{}: it holds {} scales, each for {} of {} numbers, which "
                    "do not add up. Make the asset again",
                    what, numbers.scales.size(), numbers.block, expected));
  return Status::ok();
}

Status checkBiScale(const asset::Asset& asset, const BiScaleOptions& options) {
  for (std::size_t m = 0; m < asset.transfer.meshes.size(); ++m) {
    if (!asset.transfer.meshes[m].biScale) continue;
    const std::string where = fmt::format("mesh {} '{}'", m, asset.scene.meshes[m].name);
    if (Status s = checkMesh(where, asset, m, options); !s) return s;
  }
  return Status::ok();
}

}  // namespace lambent::shade
