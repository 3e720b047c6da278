// SCENE and the material given to a file that brings none.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/lambent/console.h"
#include "apps/lambent/named_files.h"
#include "apps/lambent/reading_arguments.h"
#include "lambent/math/types.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/scene_io/load.h"

namespace lambent::tool {

enum class MaterialKind { Diffuse, Glossy, Mirror };

struct SceneArguments {
  std::filesystem::path path;
  std::optional<MaterialKind> material;  ///< none: as the file says
  std::optional<Rgb> albedo;
  std::optional<double> lobeExponent;
  bool ground = false;           ///< a grey floor under the scene
  std::optional<double> smooth;  ///< degrees, of normals that the file does not give
  scene_io::Sides sides = scene_io::Sides::AsFileSays;
  bool layout = false;       ///< texture coordinates are for texels (see LoadOptions)
  ReadingArguments reading;  ///< for all files of the command

  void addTo(CLI::App& app);
  /// --sides, for verbs that can do with two.
  void addSidesTo(CLI::App& app);
  /// Reads the scene (or the scene inside a baked asset) and reports what was odd in it.
  /// `files` gets to know what the scene names, and is checked again.
  Result<scene::Scene> load(Console& console, NamedFiles& files) const;
  /// The same to be baked: without the layers of patches that a baked asset has.
  Result<scene::Scene> loadToBake(Console& console, NamedFiles& files) const;
};

}  // namespace lambent::tool
