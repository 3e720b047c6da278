// SCENE and the material given to a file that brings none.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/lambent/console.h"
#include "lambent/math/types.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/scene_io/load.h"

namespace lambent::tool {

enum class MaterialKind { Diffuse, Glossy, Mirror };

/// --allow-outside and --memory-limit.
void addLoadOptions(CLI::App& app, scene_io::LoadOptions& options);

struct SceneArguments {
  std::filesystem::path path;
  std::optional<MaterialKind> material;  ///< none: as the file says
  std::optional<Rgb> albedo;
  std::optional<double> lobeExponent;
  bool ground = false;  ///< a grey floor under the scene
  scene_io::LoadOptions loading;

  void addTo(CLI::App& app);
  /// Reads the scene (or the scene inside a baked asset) and reports what was odd in it.
  Result<scene::Scene> load(Console& console) const;
};

}  // namespace lambent::tool
