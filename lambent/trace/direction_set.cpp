#include "lambent/trace/direction_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/math/sequences.h"

namespace lambent::trace {

namespace {

std::uint32_t spreadBits(std::uint32_t x) {
  x &= 0xffffu;
  x = (x | (x << 8)) & 0x00ff00ffu;
  x = (x | (x << 4)) & 0x0f0f0f0fu;
  x = (x | (x << 2)) & 0x33333333u;
  x = (x | (x << 1)) & 0x55555555u;
  return x;
}

/// Position along the Morton curve of the octahedral map.
std::uint32_t mortonOnOctahedron(const Vec3& d) {
  const Vec3 o = d / (std::abs(d.x()) + std::abs(d.y()) + std::abs(d.z()));
  float x = o.x(), y = o.y();
  if (o.z() < 0.0f) {
    x = std::copysign(1.0f - std::abs(o.y()), o.x());
    y = std::copysign(1.0f - std::abs(o.x()), o.y());
  }
  const auto cell = [](float t) {
    return static_cast<std::uint32_t>(std::clamp(t * 0.5f + 0.5f, 0.0f, 1.0f) * 65535.0f);
  };
  return spreadBits(cell(x)) | (spreadBits(cell(y)) << 1);
}

}  // namespace

static std::vector<Vec3> turnedLattice(int count, const Mat3& rotation) {
  assert(count >= 1);
  std::vector<Vec3> directions = math::sphericalFibonacci(count);
  for (Vec3& d : directions) d = (rotation * d).normalized();
  return directions;
}

DirectionSet::DirectionSet(int count, const Mat3& rotation)
    : DirectionSet(turnedLattice(count, rotation)) {}

DirectionSet::DirectionSet(std::vector<Vec3> directions) : directions_(std::move(directions)) {
  assert(!directions_.empty());
  std::stable_sort(directions_.begin(), directions_.end(), [](const Vec3& a, const Vec3& b) {
    return mortonOnOctahedron(a) < mortonOnOctahedron(b);
  });
  const std::size_t bundleCount = (directions_.size() + kBundle - 1) / kBundle;
  for (std::size_t i = 0; i < bundleCount * kBundle; ++i) {
    const Vec3& d = directions_[std::min(i, directions_.size() - 1)];
    x_.push_back(d.x()), y_.push_back(d.y()), z_.push_back(d.z());
  }
  for (std::size_t b = 0; b < bundleCount; ++b) {
    const std::size_t first = b * kBundle, last = std::min(first + kBundle, directions_.size());
    Vec3 axis = Vec3::Zero();
    for (std::size_t i = first; i < last; ++i) axis += directions_[i];
    axis = axis.norm() > 1e-3f ? Vec3(axis.normalized()) : Vec3(directions_[first]);
    float cosine = 1.0f;
    for (std::size_t i = first; i < last; ++i) cosine = std::min(cosine, axis.dot(directions_[i]));
    // A margin of 1e-4 rad keeps the cone test on the safe side of rounding.
    const float sine = cosine <= 0.0f ? 1.0f : std::sqrt(1.0f - cosine * cosine) + 1e-4f;
    bundles_.push_back({axis, std::min(sine, 1.0f)});
  }
}

}  // namespace lambent::trace
