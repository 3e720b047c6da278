// How long frames take: on the CPU until everything is handed over, and on the GPU from the first
// command to the last.
#pragma once

#include <array>
#include <chrono>
#include <vector>

#include <epoxy/gl.h>

#include "lambent/render/gl_objects.h"

namespace lambent::viewer {

struct FrameTime {
  float cpu = 0.0f, gpu = 0.0f;  ///< milliseconds
};

/// The GPU's times come a few frames later: nothing waits for them.
class FrameTimes {
 public:
  FrameTimes();
  void begin();
  /// `counts`: false for a frame in which nothing was drawn anew.
  void end(bool counts);
  /// Oldest first, at most kKept.
  const std::vector<FrameTime>& kept() const { return kept_; }
  void clear() { kept_.clear(); }
  FrameTime median() const;

  static constexpr std::size_t kKept = 240;

 private:
  struct DeleteQuery {
    void operator()(GLuint name) const { glDeleteQueries(1, &name); }
  };
  struct InFlight {
    render::GlObject<DeleteQuery> begin, end;
    float cpu = 0.0f;
    bool waiting = false, counts = false;
  };
  void collect(InFlight& frame);

  std::array<InFlight, 4> frames_;
  std::size_t at_ = 0;
  std::chrono::steady_clock::time_point began_;
  std::vector<FrameTime> kept_;
};

}  // namespace lambent::viewer
