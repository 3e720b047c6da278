// Solid angles of the pixels of environment maps.
//
//   latitude-longitude   2π/width · (sin of the upper edge − sin of the lower edge)
//   cube                 sums of atan2(ab, √(a² + b² + 1)) over the corners
//   round maps           a map that takes the azimuth φ over unchanged and radius r to the angle
//                        θ(r) covers, out to r, F(r) = 1 − cos θ(r) per unit of azimuth: the solid
//                        angle of any region is ∮ F dφ along its border (Stokes). With F held at 2
//                        for r ≥ 1 the rim needs no clipping, and neighbours share their edges, so
//                        that the sum is 4π but for rounding.
#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/image/maps.h"

namespace lambent::image {
namespace {

/// ∫∫ (1 + a² + b²)^(−3/2) over [0, a] × [0, b].
double cornerAngle(double a, double b) {
  return std::atan2(a * b, std::sqrt(a * a + b * b + 1));
}

std::vector<double> faceAngles(int n) {
  std::vector<double> angles(size_t(n) * n);
  for (int j = 0; j < n; ++j) {
    const double b0 = 2.0 * j / n - 1, b1 = 2.0 * (j + 1) / n - 1;
    for (int i = 0; i < n; ++i) {
      const double a0 = 2.0 * i / n - 1, a1 = 2.0 * (i + 1) / n - 1;
      angles[size_t(j) * n + i] =
          cornerAngle(a1, b1) - cornerAngle(a0, b1) - cornerAngle(a1, b0) + cornerAngle(a0, b0);
    }
  }
  return angles;
}

/// F(r)/r² for r ≤ 1, without cancellation at the centre.
double coverage(MapKind kind, double r2) {
  if (kind == MapKind::MirrorBall) return 2;  // 1 − cos θ = 2 sin²(θ/2) = 2r²
  const double half = 0.5 * kPi * std::sqrt(r2);
  const double sinc = half > 1e-8 ? std::sin(half) / half : 1.0;
  return 0.5 * kPi * kPi * sinc * sinc;
}

// ∫ F dφ along the straight line x = c, y from y0 to y1; there dφ = c dy / (c² + y²).
double edgeIntegral(MapKind kind, double c, double y0, double y1) {
  // Gauss-Legendre, 6 points on [−1, 1]; a pixel is short against the scale of F.
  static constexpr std::array<double, 3> kNodes{0.2386191860831969, 0.6612093864662645,
                                                0.9324695142031521};
  static constexpr std::array<double, 3> kWeights{0.4679139345726910, 0.3607615730481386,
                                                  0.1713244923791704};
  const auto inside = [&](double a, double b) {
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) {
      for (const double sign : {-1.0, 1.0}) {
        const double y = 0.5 * (a + b) + sign * kNodes[k] * 0.5 * (b - a);
        sum += kWeights[k] * coverage(kind, c * c + y * y);
      }
    }
    return 0.5 * (b - a) * c * sum;
  };
  const auto outside = [&](double a, double b) {
    return 2 * std::atan2((b - a) * c, c * c + a * b);  // 2·(φ(b) − φ(a)), below π apart
  };
  if (c * c >= 1) return outside(y0, y1);
  const double rim = std::sqrt(1 - c * c);
  double total = 0;
  double at = y0;
  for (const double end : {std::clamp(-rim, y0, y1), std::clamp(rim, y0, y1), y1}) {
    if (end > at) {
      const double middle = 0.5 * (at + end);
      total += std::abs(middle) < rim ? inside(at, end) : outside(at, end);
    }
    at = end;
  }
  return total;
}

std::vector<double> roundAngles(MapKind kind, int n) {
  // Both families of edges are the same numbers by symmetry: edge[k][j] is on the line 2k/n − 1,
  // between 2j/n − 1 and 2(j+1)/n − 1. Along y = const the sense of φ is reversed.
  const auto at = [n](int k) { return static_cast<double>(2 * k - n) / n; };
  std::vector<double> edges(size_t(n + 1) * n);
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j < n; ++j)
      edges[size_t(k) * n + j] = edgeIntegral(kind, at(k), at(j), at(j + 1));
  }
  std::vector<double> angles(size_t(n) * n);
  for (int j = 0; j < n; ++j) {  // the map is symmetric: rows may count from either side
    for (int i = 0; i < n; ++i) {
      angles[size_t(j) * n + i] =
          std::max(0.0, edges[size_t(i + 1) * n + j] - edges[size_t(i) * n + j] +
                            edges[size_t(j + 1) * n + i] - edges[size_t(j) * n + i]);
    }
  }
  return angles;
}

}  // namespace

std::vector<double> solidAngles(const MapShape& shape) {
  assert(checkShape(shape));
  const int w = shape.width, h = shape.height;
  std::vector<double> angles(size_t(w) * h);
  if (shape.kind == MapKind::LatLong) {
    for (int y = 0; y < h; ++y) {
      // sin a − sin b as a product: no cancellation at the poles.
      const double middle = kPi * (0.5 - (y + 0.5) / h);
      const double band = 2 * std::cos(middle) * std::sin(0.5 * kPi / h);
      std::fill_n(angles.begin() + std::ptrdiff_t(y) * w, w, 2 * kPi / w * band);
    }
    return angles;
  }
  if (shape.kind != MapKind::Cube) return roundAngles(shape.kind, w);
  // Every pixel of a cross or strip finds its place in the face by its own centre's direction.
  const int n = w == 6 * h ? h : h == 6 * w ? w : w > h ? w / 4 : w / 3;
  const std::vector<double> face = faceAngles(n);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      // Turned by 180° or not, a face's angles are the same.
      const bool used = directionOf(shape, {x + 0.5, y + 0.5}).has_value();
      if (used) angles[size_t(y) * w + x] = face[size_t(y % n) * n + x % n];
    }
  }
  return angles;
}

}  // namespace lambent::image
