#include "lambent/shade/sharp_sun.h"

#include <algorithm>

#include "lambent/sh/window.h"

namespace lambent::shade {

using transfer::EncodedMesh;
using transfer::Kind;
using Surface = transfer::Surface<transfer::Numbers>;

std::optional<SharpSun> sharpSunOf(const light::Environment& environment,
                                   const std::vector<double>& window) {
  const std::optional<light::Sun> sun = light::sunOf(environment);
  if (!sun) return std::nullopt;
  SharpSun result{*sun, light::project(*sun, int(window.size()))};
  sh::applyWindow(window, result.share);
  return result;
}

Kind kindWithoutBounces(const EncodedMesh& mesh, const Showing& showing) {
  const Kind shown = kindShown(mesh, showing);
  const auto* surface = std::get_if<Surface>(&mesh);
  return shown == Kind::Interreflected && surface && surface->responses.holds(Kind::Shadowed)
             ? Kind::Shadowed
             : shown;
}

Findings sharpSunFindings(const asset::Asset& asset, const Showing& showing) {
  std::uint64_t unbounced = 0, soft = 0;
  for (const EncodedMesh& mesh : asset.transfer.meshes) {
    if (std::holds_alternative<transfer::BiScale<transfer::Numbers>>(mesh)) ++soft;
    const auto* surface = std::get_if<Surface>(&mesh);
    const auto most = surface ? surface->responses.most() : std::nullopt;
    if (!most) continue;
    if (surface->responses.find(*most)->glossy) ++soft;
    if (surface->responses.find(*most)->diffuse &&
        kindWithoutBounces(mesh, showing) == Kind::Interreflected)
      ++unbounced;
  }
  Findings findings;
  if (unbounced > 0)
    findings.push_back(
        {Severity::Warning, "sun-without-bounces",
         "the asset holds interreflected transfer alone: under a sharp Sun the Sun's "
         "light does not bounce. Bake it with '--keep-shadowed', or show it with "
         "'--sun-shadow soft'",
         unbounced});
  const bool mirrors = std::any_of(
      asset.scene.meshes.begin(), asset.scene.meshes.end(), [&](const scene::Mesh& mesh) {
        return asset.scene.materials[std::size_t(mesh.material)].isMirror();
      });
  if (mirrors)
    findings.push_back({Severity::Note, "sun-in-mirrors",
                        "under a sharp Sun its light does not reach surfaces by way of mirrors: "
                        "show caustics with '--sun-shadow soft'",
                        1});
  if (soft > 0)
    findings.push_back({Severity::Note, "sun-soft",
                        "glossy surfaces and surfaces with meso-structure show the Sun as the "
                        "harmonics of the light have it: sharp shadows fall on diffuse ones alone",
                        soft});
  return findings;
}

}  // namespace lambent::shade
