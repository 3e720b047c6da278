#include "lambent/shade/showing.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "lambent/asset/check.h"
#include "lambent/transfer/names.h"

namespace lambent::shade {

using transfer::EncodedMesh;
using transfer::Kind;
using transfer::kKinds;
using transfer::nameOf;
using BiScale = transfer::BiScale<transfer::Numbers>;
using Surface = transfer::Surface<transfer::Numbers>;

namespace {
constexpr std::string_view kBest = "best";
}

std::string_view choiceName(std::optional<Kind> kind) {
  return kind ? nameOf(*kind) : kBest;
}

std::optional<std::optional<Kind>> choiceNamed(std::string_view name) {
  if (name == kBest) return std::optional<Kind>();
  if (const auto kind = transfer::kindNamed(name)) return kind;
  return std::nullopt;
}

Kind kindShown(const EncodedMesh& mesh, const Showing& showing) {
  const auto shown = [](const auto& held, std::optional<Kind> wanted) {
    return held.mostUpTo(wanted.value_or(Kind::Interreflected)).value_or(Kind::Unshadowed);
  };
  return std::visit(
      transfer::ForEachKind{
          [](const transfer::NoTransfer&) { return Kind::Unshadowed; },
          [&](const Surface& surface) { return shown(surface.responses, showing.surfaces); },
          [&](const BiScale& biScale) { return shown(biScale.matrices, showing.mesoStructure); }},
      mesh);
}

bool offers(const asset::Asset& asset, Kind kind) {
  return std::all_of(asset.transfer.meshes.begin(), asset.transfer.meshes.end(),
                     [&](const EncodedMesh& mesh) { return transfer::offers(mesh, kind); });
}

namespace {

template <class Offers>
std::string listed(const Offers& offered) {
  std::string names;
  for (const Kind kind : kKinds)
    if (offered(kind)) names += (names.empty() ? "" : ", ") + std::string(nameOf(kind));
  return names;
}

Error notHeld(const asset::Asset& asset, Kind kind) {
  return report::badUsage(fmt::format(
      "the asset holds no {} transfer (it holds: {}). Bake it with '{}', or ask for what is there",
      nameOf(kind), listed([&](Kind other) { return offers(asset, other); }),
      kind == Kind::Shadowed ? "--keep-shadowed" : "--transfer interreflected"));
}

}  // namespace

Status checkHeld(const asset::Asset& asset, const Showing& showing) {
  if (showing.surfaces == showing.mesoStructure) {
    if (showing.surfaces && !offers(asset, *showing.surfaces))
      return notHeld(asset, *showing.surfaces);
    return Status::ok();
  }
  for (std::size_t m = 0; m < asset.transfer.meshes.size(); ++m) {
    const EncodedMesh& mesh = asset.transfer.meshes[m];
    if (std::holds_alternative<Surface>(mesh) && showing.surfaces &&
        !transfer::offers(mesh, *showing.surfaces))
      return notHeld(asset, *showing.surfaces);
    if (std::holds_alternative<BiScale>(mesh) && showing.mesoStructure &&
        !transfer::offers(mesh, *showing.mesoStructure))
      return report::badUsage(fmt::format(
          "{} holds no {} macro transport (it holds: {}). Bake it with '--transfer {}', or ask for "
          "what is there",
          asset::meshLabel(asset.scene, m), nameOf(*showing.mesoStructure),
          listed([&](Kind kind) { return transfer::offers(mesh, kind); }),
          nameOf(*showing.mesoStructure)));
  }
  return Status::ok();
}

}  // namespace lambent::shade
