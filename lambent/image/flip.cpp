// LDR-FLIP, andersson2020flip: two pipelines, colour and features, and their final combination.
//
//   colour (§4.1)     YCxCz → contrast sensitivity filters → L*a*b* with Hunt's adjustment →
//                     HyAB distance, raised to q_c, redistributed to [0, 1]: ΔE_c
//   features (§4.2)   edges and points of the achromatic channel by first and second derivatives
//                     of a Gaussian as wide as a just visible detail: ΔE_f
//   ΔE = ΔE_c^(1 − ΔE_f)                                                                  (eq. 13)
//
// Deviation: the paper filters with two-dimensional kernels; each is a Gaussian, a derivative of
// one, or a sum of two Gaussians, so it is applied here as one-dimensional passes. Beyond the rim
// the nearest pixel is repeated.
#include "lambent/image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "lambent/work/parallel_for.h"

namespace lambent::image {
namespace {

using Plane = std::vector<float>;

struct Planes {
  int width = 0, height = 0;
  std::array<Plane, 3> channel;
  Planes(int w, int h) : width(w), height(h) {
    for (Plane& plane : channel) plane.resize(size_t(w) * h);
  }
};

// XYZ of linear sRGB, IEC 61966-2-1; the white point is that of RGB (1, 1, 1).
constexpr float kXyz[3][3] = {{0.4124564f, 0.3575761f, 0.1804375f},
                              {0.2126729f, 0.7151522f, 0.0721750f},
                              {0.0193339f, 0.1191920f, 0.9503041f}};
constexpr float kRgb[3][3] = {{3.2404542f, -1.5371385f, -0.4985314f},
                              {-0.9692660f, 1.8760108f, 0.0415560f},
                              {0.0556434f, -0.2040259f, 1.0572252f}};

/// XYZ relative to white.
Rgb whiteRelative(const Rgb& rgb) {
  Rgb xyz;
  for (int i = 0; i < 3; ++i) {
    const float white = kXyz[i][0] + kXyz[i][1] + kXyz[i][2];
    xyz[i] = (kXyz[i][0] * rgb[0] + kXyz[i][1] * rgb[1] + kXyz[i][2] * rgb[2]) / white;
  }
  return xyz;
}

/// The opponent space of the filters: L*a*b* without its cube roots.
Rgb toYCxCz(const Rgb& rgb) {
  const Rgb n = whiteRelative(rgb);
  return Rgb(116 * n[1] - 16, 500 * (n[0] - n[1]), 200 * (n[1] - n[2]));
}

Rgb fromYCxCz(const Rgb& opponent) {
  const float y = (opponent[0] + 16) / 116;
  Rgb xyz(y + opponent[1] / 500, y, y - opponent[2] / 200);
  for (int i = 0; i < 3; ++i) xyz[i] *= kXyz[i][0] + kXyz[i][1] + kXyz[i][2];
  Rgb rgb;
  for (int i = 0; i < 3; ++i) {
    rgb[i] = kRgb[i][0] * xyz[0] + kRgb[i][1] * xyz[1] + kRgb[i][2] * xyz[2];
  }
  return rgb;
}

/// CIE L*a*b*, with chroma scaled by lightness as Hunt found: dark colours look less colourful.
Rgb toHuntLab(const Rgb& rgb) {
  constexpr float kDelta = 6.0f / 29.0f;
  const auto root = [](float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29.0f;
  };
  const Rgb n = whiteRelative(rgb);
  const float fx = root(n[0]), fy = root(n[1]), fz = root(n[2]);
  const float lightness = 116 * fy - 16;
  return Rgb(lightness, 0.01f * lightness * 500 * (fx - fy), 0.01f * lightness * 200 * (fy - fz));
}

/// HyAB: city block between lightness and chroma, Euclid within chroma.
float hyab(const Rgb& a, const Rgb& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// Convolution with across ⊗ down, both of odd length.
Plane convolve(const Plane& in, int width, int height, std::span<const float> across,
               std::span<const float> down) {
  Plane between(in.size()), out(in.size());
  const int rx = static_cast<int>(across.size() / 2), ry = static_cast<int>(down.size() / 2);
  work::parallelFor(height, [&](int y) {
    const float* const row = &in[size_t(y) * width];
    for (int x = 0; x < width; ++x) {
      float sum = 0;
      for (int k = -rx; k <= rx; ++k) sum += across[k + rx] * row[std::clamp(x + k, 0, width - 1)];
      between[size_t(y) * width + x] = sum;
    }
  });
  work::parallelFor(height, [&](int y) {
    float* const row = &out[size_t(y) * width];
    for (int k = -ry; k <= ry; ++k) {
      const float weight = down[k + ry];
      const float* const from = &between[size_t(std::clamp(y + k, 0, height - 1)) * width];
      for (int x = 0; x < width; ++x) row[x] += weight * from[x];
    }
  });
  return out;
}

/// One term a·√(π/b)·exp(−π²x²/b) of a contrast sensitivity function in space, x in degrees; its
/// two-dimensional form is exp(−π²(x² + y²)/b) with the same factor.
struct CsfTerm {
  double a, b;
};

// Table 1 of the paper: achromatic, red-green, blue-yellow.
constexpr std::array<CsfTerm, 1> kAchromatic{{{1.0, 0.0047}}};
constexpr std::array<CsfTerm, 1> kRedGreen{{{1.0, 0.0053}}};
constexpr std::array<CsfTerm, 2> kBlueYellow{{{34.1, 0.04}, {13.5, 0.025}}};

Plane filterByCsf(const Plane& in, int width, int height, std::span<const CsfTerm> terms,
                  double pixelsPerDegree) {
  // All three reach as far as the widest Gaussian, 3 standard deviations.
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixelsPerDegree));
  std::vector<std::vector<float>> kernels;
  std::vector<double> factors;
  double total = 0;
  for (const CsfTerm& term : terms) {
    std::vector<float>& kernel = kernels.emplace_back(2 * radius + 1);
    double sum = 0;
    for (int k = -radius; k <= radius; ++k) {
      const double x = k / pixelsPerDegree;
      const double value = std::exp(-kPi * kPi * x * x / term.b);
      kernel[k + radius] = static_cast<float>(value);
      sum += value;
    }
    factors.push_back(term.a * std::sqrt(kPi / term.b));
    total += factors.back() * sum * sum;
  }
  Plane out(in.size());
  for (size_t t = 0; t < terms.size(); ++t) {
    const auto weight = static_cast<float>(factors[t] / total);
    const Plane part = convolve(in, width, height, kernels[t], kernels[t]);
    for (size_t i = 0; i < out.size(); ++i) out[i] += weight * part[i];
  }
  return out;
}

Planes opponentOf(const Image& image) {
  Planes planes(image.width, image.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    Rgb clamped;
    for (int c = 0; c < 3; ++c) {
      const float v = image.pixels[i][c];
      clamped[c] = v > 0.0f ? std::min(v, 1.0f) : 0.0f;  // NaN too
    }
    const Rgb opponent = toYCxCz(clamped);
    for (int c = 0; c < 3; ++c) planes.channel[c][i] = opponent[c];
  }
  return planes;
}

/// What of a picture the eye resolves, in Hunt-adjusted L*a*b*.
std::vector<Rgb> perceived(const Planes& opponent, double pixelsPerDegree) {
  const int w = opponent.width, h = opponent.height;
  const Plane y = filterByCsf(opponent.channel[0], w, h, kAchromatic, pixelsPerDegree);
  const Plane cx = filterByCsf(opponent.channel[1], w, h, kRedGreen, pixelsPerDegree);
  const Plane cz = filterByCsf(opponent.channel[2], w, h, kBlueYellow, pixelsPerDegree);
  std::vector<Rgb> out(y.size());
  for (size_t i = 0; i < out.size(); ++i) {
    out[i] = toHuntLab(fromYCxCz(Rgb(y[i], cx[i], cz[i])).max(0.0f).min(1.0f));
  }
  return out;
}

/// Edge and point strengths.
struct Features {
  Plane edges, points;
};

Features featuresOf(const Planes& opponent, double pixelsPerDegree) {
  const int w = opponent.width, h = opponent.height;
  Plane grey(opponent.channel[0].size());
  for (size_t i = 0; i < grey.size(); ++i) grey[i] = (opponent.channel[0][i] + 16) / 116;

  const double sigma = 0.5 * 0.082 * pixelsPerDegree;  // half of a detail's width in degrees
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const size_t size = 2 * size_t(radius) + 1;
  std::vector<double> gauss(size), first(size), second(size);
  for (int k = -radius; k <= radius; ++k) {
    const double g = std::exp(-0.5 * k * k / (sigma * sigma));
    gauss[k + radius] = g;
    first[k + radius] = -k * g;
    second[k + radius] = (k * k / (sigma * sigma) - 1) * g;
  }
  // Positive weights sum to 1 and negative ones to −1, so that the answers lie in [−1, 1].
  const auto balanced = [](const std::vector<double>& kernel) {
    double positive = 0, negative = 0;
    for (const double v : kernel) (v > 0 ? positive : negative) += std::abs(v);
    std::vector<float> out;
    for (const double v : kernel) {
      out.push_back(static_cast<float>(v > 0 ? v / positive : negative > 0 ? v / negative : 0.0));
    }
    return out;
  };
  const std::vector<float> g = balanced(gauss), d1 = balanced(first), d2 = balanced(second);
  const auto strength = [&](const std::vector<float>& derivative) {
    Plane x = convolve(grey, w, h, derivative, g);
    const Plane y = convolve(grey, w, h, g, derivative);
    for (size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
    return x;
  };
  return {strength(d1), strength(d2)};
}

}  // namespace

std::vector<float> flip(const Image& test, const Image& reference, float pixelsPerDegree) {
  assert(test.width == reference.width && test.height == reference.height);
  const Planes a = opponentOf(test), b = opponentOf(reference);
  const std::vector<Rgb> seenA = perceived(a, pixelsPerDegree),
                         seenB = perceived(b, pixelsPerDegree);
  const Features featuresA = featuresOf(a, pixelsPerDegree),
                 featuresB = featuresOf(b, pixelsPerDegree);

  constexpr float kColourExponent = 0.7f;   // q_c
  constexpr float kFeatureExponent = 0.5f;  // q_f
  constexpr float kKnee = 0.4f;             // p_c: this part of the largest distance …
  constexpr float kKneeError = 0.95f;       // p_t: … is mapped to this error
  const float largest =
      std::pow(hyab(toHuntLab(Rgb(0, 1, 0)), toHuntLab(Rgb(0, 0, 1))), kColourExponent);
  const float knee = kKnee * largest;

  std::vector<float> map(test.pixels.size());
  for (size_t i = 0; i < map.size(); ++i) {
    const float distance = std::pow(hyab(seenA[i], seenB[i]), kColourExponent);
    const float colour = distance < knee
                             ? distance * kKneeError / knee
                             : kKneeError + (distance - knee) / (largest - knee) * (1 - kKneeError);
    const float feature = std::max(std::abs(featuresA.edges[i] - featuresB.edges[i]),
                                   std::abs(featuresA.points[i] - featuresB.points[i]));
    const float featureError = std::pow(feature * std::sqrt(0.5f), kFeatureExponent);
    map[i] = std::clamp(std::pow(colour, 1 - featureError), 0.0f, 1.0f);
  }
  return map;
}

double meanOf(const std::vector<float>& map) {
  double sum = 0;
  for (const float v : map) sum += v;
  return map.empty() ? 0.0 : sum / static_cast<double>(map.size());
}

}  // namespace lambent::image
