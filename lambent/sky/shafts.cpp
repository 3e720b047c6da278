// This work is based on:
// - dobashi2000interactive: light scattered along a ray as a sum over virtual planes, drawn with
//   blending. Ours are summed in one loop, and the interval that a surface ends in is cut there.
// - dobashi2002interactive: the sum's terms split. High frequency: what light of the Sun arrives at a
//   plane, its shadow. Low frequency: extinction, density and phase function, integrated between planes
//   to any accuracy. There the latter is a product of a texture and of values at the planes' vertices;
//   ours is a difference of aerial perspective at both borders, whose sum over lit planes is exact.
#include "lambent/sky/shafts.h"

#include <algorithm>
#include <cmath>

namespace lambent::sky {
namespace {

Eigen::Array3d litUpTo(const AerialPerspective& air, const ShaftRay& ray, double distance) {
  return airBetween(air, ray.direction, distance).fromSun;
}

/// Where visibility changes between two distances that differ in it.
double edgeBetween(const ShaftRay& ray, const SunVisible& visible, double from, double to,
                   double precision) {
  const bool before = visible(ray.origin + from * ray.direction);
  while (to - from > precision) {
    const double middle = 0.5 * (from + to);
    (visible(ray.origin + middle * ray.direction) == before ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

/// Distances along a ray where its intervals end, cut to its length.
struct Intervals {
  double perDepth;  ///< distance for one metre of depth
  double length;
  const SamplingPlanes& planes;

  Intervals(const ShaftRay& ray, const SamplingPlanes& of)
      : perDepth(1 / std::max(ray.direction.dot(of.axis), 1e-6)), length(ray.length), planes(of) {}
  double border(int k) const { return std::min(planes.border(k) * perDepth, length); }
};

}  // namespace

Eigen::Array3d shaftsByMarch(const AerialPerspective& air, const ShaftRay& ray,
                             const SunVisible& visible, const ShaftMarch& march) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  bool lit = visible(ray.origin);
  double from = 0, litFrom = 0;
  for (int step = 1; step <= march.steps; ++step) {
    const double to = ray.length * step / march.steps;
    const bool next = visible(ray.origin + to * ray.direction);
    if (next != lit) {
      const double edge = edgeBetween(ray, visible, from, to, march.edge);
      if (lit) sum += litUpTo(air, ray, edge) - litUpTo(air, ray, litFrom);
      litFrom = edge;
      lit = next;
    }
    from = to;
  }
  if (lit) sum += litUpTo(air, ray, ray.length) - litUpTo(air, ray, litFrom);
  return sum;
}

double SamplingPlanes::border(int k) const {
  const double x = double(k) / count, span = last - first;
  if (rate * span < 1e-3) return first + x * span;
  return first - std::log1p(x * std::expm1(-rate * span)) / rate;
}

Eigen::Array3d shaftsByPlanes(const ConstantAir& air, const ShaftRay& ray,
                              const SunVisible& visible, const SamplingPlanes& planes) {
  const Intervals at(ray, planes);
  const auto fromSun = [&](double distance) { return air.at(ray.direction, distance).fromSun; };
  // What a metre of air next to the viewer scatters.
  constexpr double kMetre = 1e-6;
  const Eigen::Array3d scattered = fromSun(kMetre) / kMetre;
  Eigen::Array3d sum =
      fromSun(at.border(0)) + fromSun(ray.length) - fromSun(at.border(planes.count));
  for (int k = 0; k < planes.count; ++k) {
    const double from = at.border(k), to = at.border(k + 1), middle = 0.5 * (from + to);
    if (to > from && visible(ray.origin + middle * ray.direction))
      sum += scattered * (-air.extinction * middle).exp() * (to - from);
  }
  return sum;
}

Eigen::Array3d shaftsBySplitPlanes(const AerialPerspective& air, const ShaftRay& ray,
                                   const SunVisible& visible, const SamplingPlanes& planes) {
  const Intervals at(ray, planes);
  double from = at.border(0);
  Eigen::Array3d before = litUpTo(air, ray, from);
  Eigen::Array3d sum = before;
  for (int k = 0; k < planes.count; ++k) {
    const double to = at.border(k + 1);
    if (!(to > from)) continue;
    int lit = 0;
    for (int i = 0; i < planes.samples; ++i) {
      const double sample = from + (to - from) * (i + 0.5) / planes.samples;
      lit += visible(ray.origin + sample * ray.direction);
    }
    const Eigen::Array3d next = litUpTo(air, ray, to);
    sum += double(lit) / planes.samples * (next - before);
    before = next;
    from = to;
  }
  return sum + litUpTo(air, ray, ray.length) - before;
}

Eigen::Array3d largestStep(const AerialPerspective& air, const ShaftRay& ray,
                           const SamplingPlanes& planes) {
  const Intervals at(ray, planes);
  Eigen::Array3d most = Eigen::Array3d::Zero(), before = litUpTo(air, ray, at.border(0));
  for (int k = 0; k < planes.count; ++k) {
    const Eigen::Array3d next = litUpTo(air, ray, at.border(k + 1));
    most = most.max((next - before).abs());
    before = next;
  }
  return most / planes.samples;
}

}  // namespace lambent::sky
