// render::picture with the size of storage buffers as a parameter, so that tests can make small
// assets fall into many pieces; and with coarse mirrors, which take software GL less time.
#pragma once

#include "lambent/render/gl_picture.h"

namespace lambent::render {

/// No storage buffer exceeds the smaller of `largestBlock` bytes and what this OpenGL takes.
Result<image::Image> pictureInBlocks(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                     const light::Environment& environment,
                                     const scene::Camera& camera,
                                     const shade::PictureOptions& options, std::size_t largestBlock,
                                     const Progress& progress = {});

}  // namespace lambent::render
