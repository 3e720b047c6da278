// This work is based on:
// - pharr2023physically: §A.5.4, sampling piecewise-constant 2D functions.
#include "lambent/light/grid_distribution.h"

#include <algorithm>
#include <cassert>

namespace lambent::light {
namespace {

/// The first entry of the running sums that is above u·total, and the place within it.
struct Place {
  std::ptrdiff_t index;
  double rest;
};

Place find(const double* sums, int count, double u) {
  const double target = u * sums[count - 1];
  const double* at = std::upper_bound(sums, sums + count, target);
  // u·total can round up to total itself: then the last entry that has any weight.
  if (at == sums + count) at = std::lower_bound(sums, sums + count, sums[count - 1]);
  const double below = at == sums ? 0 : at[-1];
  const double rest = (target - below) / (*at - below);
  return {at - sums, std::clamp(rest, 0.0, 1 - 0x1p-53)};
}

}  // namespace

GridDistribution::GridDistribution(int width, int height, const std::vector<double>& weights)
    : width_(width), height_(height), rows_(height), columns_(weights) {
  assert(weights.size() == std::size_t(width) * height);
  double total = 0;
  for (int y = 0; y < height; ++y) {
    double* row = columns_.data() + std::size_t(y) * width;
    double sum = 0;
    for (int x = 0; x < width; ++x) row[x] = sum += row[x];
    rows_[y] = total += sum;
  }
}

GridDistribution::Cell GridDistribution::draw(double u1, double u2) const {
  assert(total() > 0);
  const Place row = find(rows_.data(), height_, u2);
  const Place column = find(columns_.data() + row.index * width_, width_, u1);
  return {int(column.index), int(row.index), column.rest, row.rest};
}

double GridDistribution::probability(int x, int y) const {
  const double* row = columns_.data() + std::size_t(y) * width_;
  return (row[x] - (x ? row[x - 1] : 0)) / total();
}

}  // namespace lambent::light
