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

namespace {

const Surface* diffuseSurface(const EncodedMesh& mesh) {
  const auto* surface = std::get_if<Surface>(&mesh);
  const auto most = surface ? surface->responses.most() : std::nullopt;
  return most && surface->responses.find(*most)->diffuse ? surface : nullptr;
}

}  // namespace

std::optional<Kind> kindWithoutBounces(const EncodedMesh& mesh, const Showing& showing) {
  const Surface* surface = diffuseSurface(mesh);
  if (!surface) return std::nullopt;
  const Kind shown = kindShown(mesh, showing);
  if (shown != Kind::Interreflected) return shown;
  return surface->responses.holds(Kind::Shadowed) ? std::optional(Kind::Shadowed) : std::nullopt;
}

Findings sharpSunFindings(const asset::Asset& asset, const Showing& showing) {
  std::uint64_t together = 0, soft = 0;
  for (const EncodedMesh& mesh : asset.transfer.meshes) {
    if (std::holds_alternative<transfer::BiScale<transfer::Numbers>>(mesh)) ++soft;
    if (diffuseSurface(mesh) && !kindWithoutBounces(mesh, showing)) ++together;
    const auto* surface = std::get_if<Surface>(&mesh);
    const auto most = surface ? surface->responses.most() : std::nullopt;
    if (most && surface->responses.find(*most)->glossy) ++soft;
  }
  Findings findings;
  if (together > 0)
    findings.push_back({Severity::Warning, "sun-with-bounces",
                        "the Sun's shadow stays soft: the asset holds its direct light and its "
                        "bounces as one. Bake it with '--keep-shadowed', or show it with "
                        "'--sun-shadow soft'",
                        together});
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
