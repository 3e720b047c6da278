// From where a frame is seen, as shaders want it.
#pragma once

#include "lambent/math/types.h"
#include "lambent/shade/rtt_footprint.h"

namespace lambent::render {

struct GlView {
  Mat4 clipFromWorld = Mat4::Identity();
  /// The camera's position and 1, or the unit direction to an orthographic one and 0.
  Eigen::Matrix<float, 4, 1, Eigen::DontAlign> eye;
  shade::SampleWidth sampleWidth;
};

}  // namespace lambent::render
