// Points for nanoflann, whose tree finds those that are nearest.
#pragma once

#include <cstddef>
#include <cstdint>

#include <nanoflann.hpp>

#include "lambent/math/types.h"

namespace lambent::synthesis {

/// position(i) for i in 0 … count − 1.
template <class Position>
struct Points {
  std::size_t count;
  Position position;

  // What nanoflann asks for.
  std::size_t kdtree_get_point_count() const { return count; }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return position(i)[static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
template <class Position>
Points(std::size_t, Position) -> Points<Position>;

template <class Position>
using PointTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points<Position>>,
                                        Points<Position>, 3, std::uint32_t>;

}  // namespace lambent::synthesis
