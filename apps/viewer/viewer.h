// The native viewer: a window in which an asset is relit while light, object and camera move.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/gl_window.h"
#include "apps/viewer/light_finder.h"
#include "apps/viewer/script.h"
#include "apps/viewer/surroundings.h"
#include "lambent/asset/read.h"
#include "lambent/report/result.h"

namespace lambent::viewer {

struct ViewerOptions {
  std::filesystem::path asset;            ///< empty: an empty stage
  std::vector<std::string> environments;  ///< SOURCEs; the first is shown. None: a plain white sky
  std::filesystem::path state;            ///< a saved view, or empty
  asset::ReadOptions reading;             ///< of these, and of what is opened later
  LightFinder findLights;                 ///< of these states, and of those that are opened later
  WindowOptions window;
  bool panel = true;
  std::optional<Script> script;  ///< runs it, and ends with it
  /// What moves around the asset and lights it.
  std::unique_ptr<Surroundings> surroundings;
  std::function<void(const std::string&)> print = [](const std::string&) {
  };  ///< reports of scripts
};

/// Until the window is closed or the script is done. What is wrong with a file that was given here
/// ends it; what is wrong with a file that is opened later is said in the window. Errors of a
/// script name its line.
Status view(ViewerOptions options);

}  // namespace lambent::viewer
