// Based on [andersson2020flip], "FLIP: A Difference Evaluator for Alternating Images".
//
//   YCxCz           opponent colours, linear in XYZ: where contrast sensitivity is filtered
//   (§4.1.1) contrast        Gaussians of Table 1, one for each opponent channel (§4.1.1) hunt
//   L*a*b* with chroma scaled by lightness (§4.1.2), compared by HyAB (§4.1.3) ΔE_c HyAB^q_c,
//   redistributed to [0, 1] (§4.1.4) ΔE_f            differences of edges and points, w = 0.082°
//   (§4.2) error           ΔE_c^(1 − ΔE_f) (§4.3, eq. 13)
//
// We filter in two passes: every kernel here is a product of one function of x and one of y, or a
// sum of two such. Borders repeat the last pixel.
#include "lambent/compare/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace lambent::compare {

namespace {

constexpr float kQc = 0.7f, kPc = 0.4f, kPt = 0.95f;  // §4.1.4
constexpr float kFeatureWidth = 0.082f, kQf = 0.5f;   // degrees; §4.2

using Plane = std::vector<float>;
using Planes = std::array<Plane, 3>;
using Kernel = std::vector<float>;  // odd length, centred

struct Frame {
  int width, height;
};

// Linear Rec. 709 → XYZ, its rows divided by the white point (D65): white is (1, 1, 1).
const Mat3& relativeXyzFromRgb() {
  static const Mat3 matrix = [] {
    Mat3 m;
    m << 0.4123908f, 0.3575843f, 0.1804808f,  //
        0.2126390f, 0.7151687f, 0.0721923f,   //
        0.0193308f, 0.1191948f, 0.9505322f;
    for (int row = 0; row < 3; ++row) m.row(row) /= m.row(row).sum();
    return m;
  }();
  return matrix;
}

const Mat3& rgbFromRelativeXyz() {
  static const Mat3 matrix = [] {
    // The adjugate over the determinant, in double: Eigen's inverse() would need <Eigen/LU>.
    const Mat3d m = relativeXyzFromRgb().cast<double>();
    Mat3d cofactor;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        cofactor(i, a) = m(j, b) * m(k, c) - m(j, c) * m(k, b);
      }
    }
    const double determinant = m.row(0).dot(cofactor.row(0));
    return Mat3((cofactor.transpose() / determinant).cast<float>());
  }();
  return matrix;
}

Vec3 opponentFromRgb(const Rgb& rgb) {
  const Vec3 xyz = relativeXyzFromRgb() * rgb.matrix();
  return {116.0f * xyz[1] - 16.0f, 500.0f * (xyz[0] - xyz[1]), 200.0f * (xyz[1] - xyz[2])};
}

Vec3 xyzFromOpponent(const Vec3& ycc) {
  const float y = (ycc[0] + 16.0f) / 116.0f;
  return {y + ycc[1] / 500.0f, y, y - ycc[2] / 200.0f};
}

/// L*, and a*, b* scaled by 0.01 L* (the Hunt effect).
Vec3 huntLab(const Vec3& relativeXyz) {
  const auto f = [](float t) {
    constexpr float kDelta = 6.0f / 29.0f;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                        : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  };
  const float fx = f(relativeXyz[0]), fy = f(relativeXyz[1]), fz = f(relativeXyz[2]);
  const float lightness = 116.0f * fy - 16.0f;
  return {lightness, 0.01f * lightness * 500.0f * (fx - fy),
          0.01f * lightness * 200.0f * (fy - fz)};
}

float hyab(const Vec3& a, const Vec3& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

Plane convolve(const Plane& in, Frame frame, const Kernel& alongX, const Kernel& alongY) {
  const auto pass = [&](const Plane& from, const Kernel& kernel, bool horizontal) {
    const int radius = int(kernel.size() / 2);
    Plane to(from.size());
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        float sum = 0.0f;
        for (int k = -radius; k <= radius; ++k) {
          const int sx = horizontal ? std::clamp(x + k, 0, frame.width - 1) : x;
          const int sy = horizontal ? y : std::clamp(y + k, 0, frame.height - 1);
          sum += kernel[std::size_t(k + radius)] * from[std::size_t(sy) * frame.width + sx];
        }
        to[std::size_t(y) * frame.width + x] = sum;
      }
    return to;
  };
  return pass(pass(in, alongX, true), alongY, false);
}

/// exp(−π² x² / b) at x in degrees, not yet normalised; the sum of its samples comes with it.
std::pair<Kernel, float> contrastGaussian(float b, int radius, float pixelsPerDegree) {
  Kernel kernel;
  float sum = 0.0f;
  for (int k = -radius; k <= radius; ++k) {
    const float x = float(k) / pixelsPerDegree;
    kernel.push_back(std::exp(-float(kPi * kPi) * x * x / b));
    sum += kernel.back();
  }
  for (float& w : kernel) w /= sum;
  return {kernel, sum};
}

/// Table 1: the sensitivity of each opponent channel as a₁ and a₂ Gaussians.
Planes contrastFiltered(const Planes& opponent, Frame frame, float pixelsPerDegree) {
  struct Sensitivity {
    float a1, b1, a2, b2;
  };
  constexpr Sensitivity kTable[3] = {
      {1.0f, 0.0047f, 0.0f, 1e-5f}, {1.0f, 0.0053f, 0.0f, 1e-5f}, {34.1f, 0.04f, 13.5f, 0.025f}};
  const int radius =
      int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi * kPi)) * double(pixelsPerDegree)));
  Planes filtered;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& [a1, b1, a2, b2] = kTable[c];
    const auto [first, sum1] = contrastGaussian(b1, radius, pixelsPerDegree);
    filtered[c] = convolve(opponent[c], frame, first, first);
    if (a2 == 0.0f) continue;
    const auto [second, sum2] = contrastGaussian(b2, radius, pixelsPerDegree);
    const Plane other = convolve(opponent[c], frame, second, second);
    const float w1 = a1 * std::sqrt(float(kPi) / b1) * sum1 * sum1;
    const float w2 = a2 * std::sqrt(float(kPi) / b2) * sum2 * sum2;
    for (std::size_t i = 0; i < other.size(); ++i)
      filtered[c][i] = (w1 * filtered[c][i] + w2 * other[i]) / (w1 + w2);
  }
  return filtered;
}

/// Scaled so that its positive weights sum to 1 and its negative ones to −1.
Kernel balanced(Kernel kernel) {
  float positive = 0.0f, negative = 0.0f;
  for (const float w : kernel) (w > 0.0f ? positive : negative) += w;
  for (float& w : kernel) w /= w > 0.0f ? positive : -negative;
  return kernel;
}

struct Features {
  Plane edges, points;
};

Features findFeatures(const Plane& luminance, Frame frame, float pixelsPerDegree) {
  const float sigma = 0.5f * kFeatureWidth * pixelsPerDegree;
  const int radius = int(std::ceil(3.0f * sigma));
  Kernel smooth, first, second;
  float sum = 0.0f;
  for (int k = -radius; k <= radius; ++k) {
    const float x = float(k), g = std::exp(-x * x / (2.0f * sigma * sigma));
    smooth.push_back(g);
    sum += g;
    first.push_back(-x * g);
    second.push_back((x * x / (sigma * sigma) - 1.0f) * g);
  }
  for (float& w : smooth) w /= sum;
  first = balanced(first);
  second = balanced(second);
  const auto magnitude = [&](const Kernel& derivative) {
    Plane x = convolve(luminance, frame, derivative, smooth);
    const Plane y = convolve(luminance, frame, smooth, derivative);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
    return x;
  };
  return {magnitude(first), magnitude(second)};
}

/// What the colour pipeline and the feature pipeline make of one picture.
struct Seen {
  std::vector<Vec3> lab;
  Features features;
};

Seen see(const image::Image& image, float pixelsPerDegree) {
  const Frame frame{image.width, image.height};
  const std::size_t count = image.pixels.size();
  Planes opponent{Plane(count), Plane(count), Plane(count)};
  Plane luminance(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 ycc = opponentFromRgb(image.pixels[i].max(0.0f).min(1.0f));
    for (std::size_t c = 0; c < 3; ++c) opponent[c][i] = ycc[Eigen::Index(c)];
    luminance[i] = (ycc[0] + 16.0f) / 116.0f;
  }
  const Planes filtered = contrastFiltered(opponent, frame, pixelsPerDegree);
  Seen seen;
  seen.lab.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 xyz = xyzFromOpponent({filtered[0][i], filtered[1][i], filtered[2][i]});
    const Rgb shown = (rgbFromRelativeXyz() * xyz).array().max(0.0f).min(1.0f);
    seen.lab.push_back(huntLab(relativeXyzFromRgb() * shown.matrix()));
  }
  seen.features = findFeatures(luminance, frame, pixelsPerDegree);
  return seen;
}

}  // namespace

FlipMap flip(const image::Image& reference, const image::Image& test, float pixelsPerDegree) {
  assert(reference.width == test.width && reference.height == test.height);
  const Seen a = see(reference, pixelsPerDegree), b = see(test, pixelsPerDegree);
  const Vec3 green = huntLab(relativeXyzFromRgb() * Vec3(0, 1, 0));
  const Vec3 blue = huntLab(relativeXyzFromRgb() * Vec3(0, 0, 1));
  const float largest = std::pow(hyab(green, blue), kQc), knee = kPc * largest;

  FlipMap map{reference.width, reference.height, {}, 0.0};
  map.error.reserve(a.lab.size());
  for (std::size_t i = 0; i < a.lab.size(); ++i) {
    const float power = std::pow(hyab(a.lab[i], b.lab[i]), kQc);
    const float color =
        power < knee ? kPt / knee * power : kPt + (power - knee) / (largest - knee) * (1.0f - kPt);
    const float feature = std::max(std::abs(a.features.edges[i] - b.features.edges[i]),
                                   std::abs(a.features.points[i] - b.features.points[i]));
    const float structure = std::pow(std::min(feature / std::sqrt(2.0f), 1.0f), kQf);
    map.error.push_back(std::pow(std::min(color, 1.0f), 1.0f - structure));
    map.mean += double(map.error.back());
  }
  if (!map.error.empty()) map.mean /= double(map.error.size());
  return map;
}

}  // namespace lambent::compare
