// Light captured from a scene that moves, on the GPU and without reading it back
// (sloan2002precomputed §6.1, §6.2).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lambent/capture/cube_map.h"
#include "lambent/capture/moving_scene.h"
#include "lambent/report/result.h"
#include "lambent/sh/coefficients.h"

namespace lambent::render {

struct CaptureOptions {
  capture::CubeSize cube;  ///< 6×16×16, supersampled 2×2
  int bands = 5;           ///< of the captured light, 1 … 10
  /// Faces that one draw call renders at most; 0: those of all samples at once. To measure with.
  int facesAtOnce = 0;
};

/// Works in the OpenGL 4.5 context that is current when it is made, which must be current in every
/// call and outlive it. Calls leave GL's state as it was (GlStateGuard), but for what is bound to
/// texture units, image units and indexed storage buffers. Nothing here waits for the GPU but
/// read().
class LightCapture {
 public:
  /// `points`: where light is sampled, in the asset's frame (capture::Blending::samples), at least
  /// one. The object itself is not part of `scene` and hides nothing. Fails where this OpenGL has
  /// no textures as large as so many samples take.
  static Result<LightCapture> make(const capture::MovingScene& scene, std::span<const Vec3> points,
                                   const CaptureOptions& options = {});
  LightCapture(LightCapture&&) noexcept;
  LightCapture& operator=(LightCapture&&) noexcept;
  ~LightCapture();

  /// Fills the light buffer with the light at every sample as things stand at `time` (seconds), in
  /// the frame of the asset, which `worldFromAsset` (rigid) places in the world. `worldLight`: the
  /// distant light in the world, of any bands (0 … 10): what bodies hide of it is taken away, the
  /// rest is exact. The same numbers as reference::captureByRays, to rounding.
  Status capture(double time, const Mat4& worldFromAsset, const sh::RgbCoefficients& worldLight);

  /// [sample][coefficient][3] floats: LiveRenderer::setLightField's. One buffer for life; its
  /// contents are ready for shaders when capture() returns.
  unsigned lightBuffer() const;
  int bands() const;
  int samples() const;

  /// A box in the world that holds all bodies at `time`, for LiveView::others. Costs nothing that
  /// grows with their triangles.
  scene::Box bounds(double time) const;

  /// The light buffer on the CPU, one set for each sample. Waits for the GPU.
  Result<std::vector<sh::RgbCoefficients>> read() const;

  /// Draws the bodies as they stand at `time` into a framebuffer of that size: linear radiance, 1
  /// in alpha, tested against the depth that is there and written to it. `clipFromWorld` is the one
  /// that the rest of the picture was drawn with; bodies before its near plane or behind its far
  /// one are drawn all the same, in their sequence.
  void draw(unsigned framebuffer, int width, int height, const Mat4& clipFromWorld,
            double time) const;

 private:
  struct Impl;
  explicit LightCapture(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambent::render
