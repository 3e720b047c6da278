// A bar with rate and time left on a terminal; a plain line now and then elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "lambent/report/progress.h"

namespace lambent::tool {

/// "12.3 Mrays/s", "940 pixels/s".
std::string formatRate(double perSecond, std::string_view unit);
/// "0.42 s", "12.3 s", "3:07", "1:02:03".
std::string formatSeconds(double seconds);
/// "12.3 MB".
std::string formatBytes(double bytes);
/// "34,835".
std::string formatCount(std::uint64_t count);

/// What one stage took, as its progress told.
struct StageTime {
  std::string name;
  double seconds = 0.0;
  std::uint64_t units = 0;
  std::string unit;
};

/// The seconds of all stages, and a line of text for each.
struct StageTotal {
  double seconds = 0.0;
  std::string lines;
};
StageTotal inAll(const std::vector<StageTime>& stages);

/// Listens to a stage's Progress. The last update of a stage is also its record.
class ProgressBar {
 public:
  enum class Style { Silent, Lines, Bar };
  explicit ProgressBar(Style style) : style_(style) {}

  void update(const ProgressUpdate& update);
  /// Ends the stage that runs, and takes the bar off the terminal.
  void finish();
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  using Clock = std::chrono::steady_clock;
  void draw(const ProgressUpdate& update, Clock::time_point now);

  Style style_;
  std::vector<StageTime> stages_;
  bool running_ = false, drawn_ = false;
  Clock::time_point began_, lastDrawn_;
};

}  // namespace lambent::tool
