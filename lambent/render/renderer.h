// An asset that stays on the GPU, lit, to be drawn again and again: for moving cameras, and to
// measure a frame.
#pragma once

#include <cstddef>
#include <memory>

#include "lambent/asset/asset.h"
#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/picture_options.h"

namespace lambent::render {

/// Holds an OpenGL context, current on the thread that made it until it is destroyed there.
/// Movable.
class Renderer {
 public:
  /// Checks, uploads and lights everything. Asset and environment must outlive it. `options` are
  /// those of every frame.
  static Result<Renderer> make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                               const light::Environment& environment,
                               const shade::PictureOptions& options);
  /// The same with storage buffers of `largestBlock` bytes at most, and 128 texels to a side of
  /// what mirrors show, for tests.
  static Result<Renderer> make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                               const light::Environment& environment,
                               const shade::PictureOptions& options, std::size_t largestBlock);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Draws one sample a pixel at its centre, and returns when the frame is done. It stays on the
  /// GPU: nothing is read back.
  Status drawFrame(const scene::Camera& camera);
  /// As reference::relitPicture.
  Result<image::Image> picture(const scene::Camera& camera, const Progress& progress = {});

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambent::render
