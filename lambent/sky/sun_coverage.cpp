// The share of a disc's light within a polygon, exact but for quadrature.
//
// About the Sun's centre directions are mapped to a plane by Lambert's equal-area projection, in which
// the disc is a circle; its radius is the unit there. With radiance f(ρ) = μ^α, μ = √(1 − ρ²), and
// F(ρ) = ∫₀^ρ f s ds, the light within a closed line is ∮ F dφ (Green), where F stays F(1) outside
// of the disc. An edge's part outside costs an arc tangent, its part inside is integrated by Gauss's
// rule; neighbours share edges, so that what one pixel misses another has.
//
//   hestroffer1998wavelength   α = −.507 + .441/λ (303 … 372 nm), −.023 + .292/λ (416 … 1099 nm),
//                              λ in µm
//
// Where the horizon cuts the disc it is a straight line of the plane: within 10⁻³ of a radius. That
// air bends and reddens the lower limb more than the upper one is left out.
#include "lambent/sky/sun_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lambent::sky {

namespace {

using Point2 = Vec2d;

/// F(ρ)/ρ² for ρ² < 1.
double averageWithin(double rho2, double exponent) {
  if (rho2 < 1e-6) return 0.5 - 0.125 * exponent * rho2;
  return (1 - std::pow(1 - rho2, 1 + exponent / 2)) / ((2 + exponent) * rho2);
}

double cross(const Point2& a, const Point2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// φ from a to b along the straight line between them.
double angleBetween(const Point2& a, const Point2& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// ∮ F dφ over a segment within the disc, added for each exponent.
void addInside(const Point2& a, const Point2& b, std::span<const double> exponents,
               std::span<double> sums) {
  // Gauss-Legendre, 8 points on [−1, 1].
  constexpr std::array<double, 4> kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
  constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873,
                                           0.2223810344533745, 0.1012285362903763};
  const double moment = cross(a, b);  // F dφ = (F/ρ²) (a × b) dt
  if (moment == 0) return;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      // Points gather at the ends, where 1 − ρ² may begin as a power below 2.
      const double u = sign * kNodes[k], t = 0.5 + 0.25 * u * (3 - u * u);
      const double weight = 0.75 * (1 - u * u) * kWeights[k] * moment;
      const double rho2 = std::min((a + t * (b - a)).squaredNorm(), 1.0);
      for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] += weight * averageWithin(rho2, exponents[i]);
    }
  }
}

void addSegment(const Point2& a, const Point2& b, std::span<const double> exponents,
                std::span<double> sums) {
  const Point2 along = b - a;
  const double length2 = along.squaredNorm();
  if (length2 == 0) return;
  // Where the line crosses the circle.
  const double middle = -a.dot(along) / length2;
  const double height2 = (a + middle * along).squaredNorm();
  const double half = height2 < 1 ? std::sqrt((1 - height2) / length2) : 0;
  const double enter = std::clamp(middle - half, 0.0, 1.0);
  const double leave = std::clamp(middle + half, 0.0, 1.0);
  const bool crosses = height2 < 1 && enter < leave;
  const auto at = [&](double t) { return Point2(a + t * along); };
  const auto outside = [&](double from, double to) {
    if (from >= to) return;
    const double angle = angleBetween(at(from), at(to));
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += angle / (2 + exponents[i]);
  };
  if (!crosses) return outside(0, 1);
  outside(0, enter);
  addInside(at(enter), at(leave), exponents, sums);
  outside(leave, 1);
}

/// A polygon's part where y ≥ least.
std::vector<Point2> above(const std::vector<Point2>& polygon, double least) {
  std::vector<Point2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.y() >= least) kept.push_back(a);
    if ((a.y() >= least) != (b.y() >= least)) {
      const double t = (least - a.y()) / (b.y() - a.y());
      kept.emplace_back(a.x() + t * (b.x() - a.x()), least);
    }
  }
  return kept;
}

}  // namespace

double limbDarkening(double nanometres) {
  const auto infrared = [](double um) { return -0.023 + 0.292 / um; };
  const auto ultraviolet = [](double um) { return -0.507 + 0.441 / um; };
  const double um = std::clamp(nanometres * 1e-3, 0.303, 1.099);
  if (um >= 0.416) return infrared(um);
  if (um <= 0.372) return ultraviolet(um);
  const double t = (um - 0.372) / (0.416 - 0.372);
  return (1 - t) * ultraviolet(0.372) + t * infrared(0.416);
}

SunCoverage::SunCoverage(const SunDisc& sun, double horizon, std::vector<double> exponents)
    : angularRadius_(sun.angularRadius),
      centre_(std::cos(sun.elevation), std::sin(sun.elevation), 0),
      right_(0, 0, 1),
      up_(-std::sin(sun.elevation), std::cos(sun.elevation), 0),
      horizon_((horizon - sun.elevation) / sun.angularRadius),
      exponents_(std::move(exponents)),
      whole_(exponents_.size(), 0.0) {
  visible_ = horizon_ < 1 && sun.visible > 0;
  if (!visible_) return;
  constexpr double kBeyond = 2;
  integrate({{-kBeyond, -kBeyond}, {kBeyond, -kBeyond}, {kBeyond, kBeyond}, {-kBeyond, kBeyond}},
            whole_);
}

SunCoverage::Point SunCoverage::inPlane(const Vec3d& direction) const {
  const double x = direction.dot(right_), y = direction.dot(up_);
  // 2 sin(θ/2) / sin θ = 1 / cos(θ/2)
  const double cosine = std::max(direction.dot(centre_), -0.999999);
  const double scale = 1 / std::sqrt((1 + cosine) / 2);
  return Point(x, y) * (scale / (2 * std::sin(angularRadius_ / 2)));
}

void SunCoverage::integrate(const std::vector<Point>& polygon, std::span<double> sums) const {
  const std::vector<Point> seen = above(polygon, std::max(horizon_, -1.5));
  for (std::size_t i = 0; i < seen.size(); ++i)
    addSegment(seen[i], seen[(i + 1) % seen.size()], exponents_, sums);
}

void SunCoverage::shares(std::span<const Vec3d> outline, std::span<double> shares) const {
  std::fill(shares.begin(), shares.end(), 0.0);
  if (!visible_) return;
  std::vector<Point> polygon;
  polygon.reserve(outline.size());
  for (const Vec3d& direction : outline) polygon.push_back(inPlane(direction));
  integrate(polygon, shares);
  // Whichever way the outline runs; what is left of a disc elsewhere is rounding.
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] = std::max(std::abs(shares[i] / whole_[i]) - 1e-13, 0.0);
}

void SunCoverage::densities(const Vec3d& direction, std::span<double> densities) const {
  const Point at = inPlane(direction);
  const double mu2 = 1 - at.squaredNorm();
  const bool seen = visible_ && mu2 > 0 && at.y() >= horizon_ && direction.dot(centre_) > 0;
  const double radius = 2 * std::sin(angularRadius_ / 2);
  for (std::size_t i = 0; i < densities.size(); ++i)
    densities[i] = seen ? std::pow(mu2, exponents_[i] / 2) / (whole_[i] * radius * radius) : 0.0;
}

}  // namespace lambent::sky
