// --texels: meshes baked on grids over their UVs, or over a layout that is made for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/lambent/console.h"
#include "apps/lambent/refine_arguments.h"
#include "lambent/texel_layout/lay_out.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/receivers.h"

namespace lambent::tool {

/// What is to be baked on texels.
struct ChosenTexels {
  std::vector<transport::TexelGrid> grids;  ///< over UVs that are there
  std::vector<std::uint32_t> toLayOut;      ///< meshes
};

struct TexelArguments {
  std::vector<std::string> texels;  ///< [MESH=]WxH or [MESH=]auto
  std::size_t budget = 65536;       ///< texel_layout::LayoutOptions::budget

  /// --texels, --texel-budget.
  void addTo(CLI::App& app);
  /// Whether a grid is to lie over UVs that a mesh has.
  bool wantsUvs() const;
  /// The meshes by name or number; the backs of those that have some are laid out beside their
  /// fronts.
  Result<ChosenTexels> resolve(scene::Scene& scene) const;
};

/// Lays out what is to be, adds its grids to those that are there, and makes scene and rays anew.
/// Reports what was found. No value: nothing was to be laid out.
using Laid = std::optional<texel_layout::LaidOutScene>;
Result<Laid> layOutTexels(const TexelArguments& arguments, const RefineArguments& refine,
                          ChosenTexels& chosen, scene::Scene& scene, trace::RayScene& rays,
                          trace::Edges edges, Console& console);

Json asJson(const Laid& laid, const scene::Scene& scene);
std::string inWords(const Laid& laid);

}  // namespace lambent::tool
