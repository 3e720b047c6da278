// Private to this room: what a RayScene holds.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "lambent/trace/ray_scene.h"

namespace lambent::trace {

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::uint32_t> triangleOffsets, vertexOffsets;
  float offset = 0.0f;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

}  // namespace lambent::trace
