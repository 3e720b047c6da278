#include "apps/lambent/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "apps/lambent/standard_streams.h"

namespace lambent::tool {

namespace {

constexpr auto kBarInterval = std::chrono::milliseconds(100);
constexpr auto kLineInterval = std::chrono::seconds(3);

double secondsBetween(std::chrono::steady_clock::time_point a,
                      std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

int terminalWidth() {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace

std::string formatRate(double perSecond, std::string_view unit) {
  if (perSecond >= 1e6) return fmt::format("{:.1f} M{}/s", perSecond * 1e-6, unit);
  if (perSecond >= 1e4) return fmt::format("{:.0f} k{}/s", perSecond * 1e-3, unit);
  return fmt::format("{:.0f} {}/s", perSecond, unit);
}

std::string formatSeconds(double seconds) {
  if (seconds < 10.0) return fmt::format("{:.2f} s", seconds);
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string formatBytes(double bytes) {
  if (bytes < 1e3) return fmt::format("{:.0f} bytes", bytes);
  if (bytes < 1e6) return fmt::format("{:.1f} kB", bytes * 1e-3);
  if (bytes < 1e9) return fmt::format("{:.1f} MB", bytes * 1e-6);
  return fmt::format("{:.2f} GB", bytes * 1e-9);
}

std::string formatCount(std::uint64_t count) {
  if (count < 1000) return std::to_string(count);
  return fmt::format("{},{:03}", formatCount(count / 1000), count % 1000);
}

StageTotal inAll(const std::vector<StageTime>& stages) {
  StageTotal total;
  for (const StageTime& stage : stages) {
    total.seconds += stage.seconds;
    total.lines += fmt::format("  {:<28} {:>8}\n", stage.name, formatSeconds(stage.seconds));
  }
  return total;
}

void ProgressBar::update(const ProgressUpdate& update) {
  const auto now = Clock::now();
  if (!running_ || stages_.back().name != update.stage) {
    finish();
    stages_.push_back({std::string(update.stage), 0.0, 0, std::string(update.unit)});
    running_ = true;
    began_ = lastDrawn_ = now;
  }
  StageTime& stage = stages_.back();
  stage.seconds = secondsBetween(began_, now);
  stage.units = std::max(stage.units, update.done);
  // Lines come more rarely the longer it takes, so that a log of an hour is short.
  const Clock::duration lines = std::max<Clock::duration>(kLineInterval, (now - began_) / 8);
  const Clock::duration interval = style_ == Style::Bar ? Clock::duration(kBarInterval) : lines;
  if (style_ != Style::Silent && update.total > 0 && now - lastDrawn_ >= interval)
    draw(update, now);
}

void ProgressBar::draw(const ProgressUpdate& update, Clock::time_point now) {
  lastDrawn_ = now;
  const double fraction =
      update.total > 0 ? std::min(1.0, double(update.done) / double(update.total)) : 0.0;
  const double seconds = secondsBetween(began_, now);
  const std::string rate =
      seconds > 0.0 ? formatRate(double(update.done) / seconds, update.unit) : std::string();
  const std::string left =
      fraction > 0.0 ? formatSeconds(seconds * (1.0 - fraction) / fraction) + " left" : "";
  if (style_ == Style::Lines) {
    tell(fmt::format("{}: {:.0f}%, {}, {}\n", update.stage, 100.0 * fraction, rate, left));
    return;
  }
  const std::string tail = fmt::format(" {:3.0f}%  {}  {}", 100.0 * fraction, rate, left);
  const int room = terminalWidth() - 1 - int(update.stage.size()) - 3 - int(tail.size());
  const int width = std::clamp(room, 0, 40);
  const int filled = int(fraction * width);
  std::string line = fmt::format("{} [{}{}]{}", update.stage, std::string(size_t(filled), '#'),
                                 std::string(size_t(width - filled), '.'), tail);
  line.resize(std::min(line.size(), size_t(std::max(terminalWidth() - 1, 1))));
  tell("\r\033[K" + line);
  drawn_ = true;
}

void ProgressBar::finish() {
  if (drawn_) tell("\r\033[K");
  drawn_ = false;
  running_ = false;
}

}  // namespace lambent::tool
