// Spherical harmonics at every direction of a DirectionSet, evaluated once for all receivers.
#pragma once

#include <vector>

#include "lambent/trace/direction_set.h"
#include "lambent/transport/row_kernels.h"

namespace lambent::transport {

class DirectionTable {
 public:
  /// y_i(s_d) for all directions and i < bands².
  DirectionTable(const trace::DirectionSet& directions, int bands);

  int bands() const { return bands_; }
  Rows rows() const { return {values_.data(), stride_}; }
  const float* row(std::size_t direction) const { return values_.data() + direction * stride_; }

 private:
  int bands_;
  std::size_t stride_;
  std::vector<float> values_;
};

}  // namespace lambent::transport
