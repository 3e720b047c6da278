// An OpenGL 4.5 core context without a window, through EGL.
#pragma once

#include <memory>

#include "lambent/report/result.h"

namespace lambent::render {

/// Current on the thread that made it until it is destroyed there; then what was current before is
/// again. Movable.
class GlContext {
 public:
  /// On Mesa's surfaceless platform, or else on the first EGL device that can.
  static Result<GlContext> create();
  GlContext(GlContext&&) noexcept;
  GlContext& operator=(GlContext&&) noexcept;
  ~GlContext();

 private:
  struct Impl;
  explicit GlContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambent::render
