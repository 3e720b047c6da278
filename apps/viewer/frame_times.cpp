#include "apps/viewer/frame_times.h"

#include <algorithm>

namespace lambent::viewer {

namespace {

float medianOf(std::vector<float> values) {
  if (values.empty()) return 0.0f;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

FrameTimes::FrameTimes() {
  for (InFlight& frame : frames_)
    for (auto* query : {&frame.begin, &frame.end}) {
      GLuint name = 0;
      glCreateQueries(GL_TIMESTAMP, 1, &name);
      *query = render::GlObject<DeleteQuery>(name);
    }
}

void FrameTimes::begin() {
  InFlight& frame = frames_[at_];
  if (frame.waiting) collect(frame);
  began_ = std::chrono::steady_clock::now();
  glQueryCounter(frame.begin.name(), GL_TIMESTAMP);
}

void FrameTimes::end(bool counts) {
  InFlight& frame = frames_[at_];
  glQueryCounter(frame.end.name(), GL_TIMESTAMP);
  frame.cpu =
      std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began_).count();
  frame.waiting = true;
  frame.counts = counts;
  at_ = (at_ + 1) % frames_.size();
}

void FrameTimes::collect(InFlight& frame) {
  // Four frames ago: it is done, or so nearly that to wait for it costs nothing.
  GLuint64 from = 0, to = 0;
  glGetQueryObjectui64v(frame.begin.name(), GL_QUERY_RESULT, &from);
  glGetQueryObjectui64v(frame.end.name(), GL_QUERY_RESULT, &to);
  frame.waiting = false;
  if (!frame.counts) return;
  if (kept_.size() >= kKept) kept_.erase(kept_.begin());
  kept_.push_back({frame.cpu, to > from ? float(to - from) * 1e-6f : 0.0f});
}

FrameTime FrameTimes::median() const {
  std::vector<float> cpu, gpu;
  for (const FrameTime& time : kept_) cpu.push_back(time.cpu), gpu.push_back(time.gpu);
  return {medianOf(std::move(cpu)), medianOf(std::move(gpu))};
}

}  // namespace lambent::viewer
