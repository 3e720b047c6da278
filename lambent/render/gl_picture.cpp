#include "lambent/render/gl_picture.h"

#include "lambent/render/gl_picture_in_blocks.h"
#include "lambent/render/renderer.h"

namespace lambent::render {

Result<image::Image> pictureInBlocks(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                     const light::Environment& environment,
                                     const scene::Camera& camera,
                                     const shade::PictureOptions& options, std::size_t largestBlock,
                                     const Progress& progress) {
  Result<Renderer> renderer = Renderer::make(asset, light, environment, options, largestBlock);
  if (!renderer) return renderer.error();
  return renderer->picture(camera, progress);
}

Result<image::Image> picture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                             const light::Environment& environment, const scene::Camera& camera,
                             const shade::PictureOptions& options, const Progress& progress) {
  Result<Renderer> renderer = Renderer::make(asset, light, environment, options);
  if (!renderer) return renderer.error();
  return renderer->picture(camera, progress);
}

}  // namespace lambent::render
