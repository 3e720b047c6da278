// Numbers too small for full precision count as zero while one of these is held.
#pragma once

namespace lambent::work {

/// Embree wants denormals flushed on every thread that traces. Runner holds one for every chunk;
/// code that traces outside of it holds its own. What was set before comes back at the end.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace lambent::work
