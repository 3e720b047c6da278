// From where a frame is seen, as shaders want it. "World" is where the scene's vertices are: for an
// asset that moves, its own frame.
#pragma once

#include <optional>

#include "lambent/light/sun.h"
#include "lambent/math/types.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/rtt_footprint.h"
#include "lambent/sky/shafts.h"

namespace lambent::render {

struct GlView {
  Mat4 clipFromWorld = Mat4::Identity();
  /// The camera's position and 1, or the unit direction to an orthographic one and 0.
  Eigen::Matrix<float, 4, 1, Eigen::DontAlign> eye;
  shade::SampleWidth sampleWidth;
  Mat3 environmentFromWorld = Mat3::Identity();
  std::optional<light::SunPoint> sun;  ///< whose shadows are sharp, if that is wished
  std::optional<sky::SamplingPlanes>
      shafts;                ///< of that Sun's light in the air, if they are wished
  int sample = 0;            ///< the sub-sample's number
  bool unlit = false;        ///< base colours alone
  std::optional<Rgb> seams;  ///< as LiveView's
  bool background = false;   ///< there will be one: shafts of light stand before it too
  bool mirrored = false;     ///< the camera's matrix turns right into left
  int leftOut = -1;          ///< the number of a mesh that is not drawn, if any
  /// The ray through this sub-sample of pixel (x, y), y from the bottom: corner + x right + y up;
  /// not unit.
  Vec3 corner, right, up;
};

/// Its position and 1, or the unit direction to an orthographic one and 0.
Eigen::Vector4f eyeOf(const scene::Camera& camera);

/// A frame of width×height pixels, seen through `place` of each (from its upper left corner), one
/// of `samples`. Near and far are fitted to `box`.
GlView viewThrough(const scene::Camera& camera, int width, int height, const scene::Box& box,
                   const Vec2& place, int samples);

}  // namespace lambent::render
