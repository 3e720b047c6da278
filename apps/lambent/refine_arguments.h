// --refine: how finely a bake looks between its receivers, and what it does about it.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "apps/lambent/console.h"
#include "lambent/macro/interpolation_error.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/receivers.h"

namespace lambent::tool {

/// When triangles are cut: where they are so large that a bake would miss shadows (and not in scans
/// of more receivers than that is worth looking for), always, or never.
enum class Refining { LargeTriangles, Always, Never };

struct RefineArguments {
  Refining when = Refining::LargeTriangles;
  double error = 0.01;         ///< macro::RefineOptions::error
  std::size_t budget = 20000;  ///< vertices to add, at most

  /// --refine, --refine-budget.
  void addTo(CLI::App& app);
};

/// A scene and what is made of it for a bake; refining makes all three anew.
struct SceneToBake {
  scene::Scene& scene;
  trace::RayScene& rays;
  trace::Edges edges;  ///< of the rays
  transport::PlacedReceivers& receivers;
  const transport::Placement& placement;
  std::string_view besides;  ///< what else the verb has against shadows between receivers
};

/// How far light between receivers is off, by a sample that costs little of a bake; after cutting
/// triangles, where that is due. Reports what was found and done. No value: nothing to look at.
struct Looked {
  std::optional<macro::InterpolationError> before, after;  ///< after: if triangles were cut
  std::size_t added = 0;                                   ///< vertices
};
Result<Looked> lookBetweenReceivers(const RefineArguments& arguments, const SceneToBake& bake,
                                    Console& console);

Json asJson(const Looked& looked, const scene::Scene& scene);

}  // namespace lambent::tool
