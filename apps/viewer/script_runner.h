// Does what a script says, frame by frame.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include "apps/viewer/frame_times.h"
#include "apps/viewer/layout.h"
#include "apps/viewer/script.h"
#include "apps/viewer/session.h"

namespace lambent::viewer {

class ScriptRunner {
 public:
  /// `print` takes the lines of `report`.
  ScriptRunner(Script script, std::function<void(const std::string&)> print);

  /// Before a frame: runs commands until one wants a frame to pass. An error names the line.
  Status advance(Session& session, GlWindow& window, FrameTimes& times, const Layout& layout);
  bool finished() const { return at_ >= script_.commands.size(); }
  /// Where the window is to be written once this frame is drawn.
  std::optional<std::filesystem::path> takeWindowShot() {
    return std::exchange(shot_, std::nullopt);
  }

 private:
  /// What a command leaves behind: done, or to be asked again after the next frame.
  enum class Step { Done, DoneAfterFrame, Again };
  struct Scene;
  Result<Step> run(const ScriptCommand& command, Scene& scene);
  Result<Step> runFile(const ScriptCommand& command, Scene& scene);
  Result<Step> runSky(const ScriptCommand& command, Session& session);
  Status set(const std::string& name, const std::string& value, Scene& scene);
  Status expectError(const std::string& text, Session& session) const;
  Status expectQuestion(const std::string& text, Session& session) const;

  Script script_;
  std::function<void(const std::string&)> print_;
  std::size_t at_ = 0;
  int lastLine_ = 0;
  long waited_ = 0;     ///< frames that the present command has waited
  bool begun_ = false;  ///< the present command has begun and waits
  long frames_ = 0;
  std::map<std::size_t, long> left_;  ///< rounds of the repeats that are under way
  std::optional<std::filesystem::path> shot_;
};

}  // namespace lambent::viewer
