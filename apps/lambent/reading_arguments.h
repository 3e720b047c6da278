// What the files that a command reads may cost, and where those that they name may lie.
#pragma once

#include <cstdint>
#include <optional>

#include "lambent/asset/read.h"
#include "lambent/image/io.h"
#include "lambent/scene_io/load.h"
#include "lambent/sources/source.h"

namespace CLI {
class App;
}

namespace lambent::tool {

struct ReadingArguments {
  bool allowOutside = false;
  std::optional<std::uint64_t> memoryLimit;  ///< bytes, for each file with what it names

  /// --memory-limit, for verbs whose files name no others.
  void addLimitTo(CLI::App& app);
  /// --allow-outside and --memory-limit.
  void addTo(CLI::App& app);

  // The same for every room that reads.
  asset::ReadOptions forAsset() const { return {allowOutside, memoryLimit}; }
  image::ReadOptions forImage() const { return {.memoryLimit = memoryLimit}; }
  scene_io::LoadOptions forScene() const { return {allowOutside, memoryLimit}; }
  sources::SourceOptions forSource(Progress progress) const {
    return {.memoryLimit = memoryLimit, .progress = std::move(progress)};
  }
};

}  // namespace lambent::tool
