#include "lambent/image/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lambent/radiometry/srgb.h"

namespace lambent::image {

Result<Comparison> compare(std::span<const Rgb> test, std::span<const Rgb> reference) {
  assert(test.size() == reference.size());
  Comparison result;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double squared = 0, relative = 0, power = 0, whole = 0;
  float brightest = 0;
  std::uint64_t pixels = 0;
  for (size_t i = 0; i < test.size(); ++i) {
    const Rgb& t = test[i];
    const Rgb& r = reference[i];
    if (!t.isFinite().all() || !r.isFinite().all()) {
      ++result.nonFinitePixels;
      continue;
    }
    const Eigen::Array3d error = t.cast<double>() - r.cast<double>();
    const Eigen::Array3d square = r.cast<double>().square();
    sum += error;
    squared += error.square().sum();
    relative += (error.square() / (square + 0.01)).sum();
    power += square.sum();
    whole += r.cast<double>().sum();
    brightest = std::max(brightest, r.maxCoeff());
    result.largest = std::max(result.largest, error.abs().maxCoeff());
    ++pixels;
  }
  if (pixels == 0) {
    return report::badInput("no pixel is finite in both pictures: there is nothing to compare");
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto samples = 3.0 * static_cast<double>(pixels);
  result.bias = (sum / static_cast<double>(pixels)).cast<float>();
  result.meanBias = sum.sum() / samples;
  result.relativeBias = sum.sum() == 0 ? 0 : whole != 0 ? sum.sum() / whole : kInfinity;
  result.rmse = std::sqrt(squared / samples);
  result.relativeMse = relative / samples;
  result.relativeRmse = squared == 0 ? 0 : power > 0 ? std::sqrt(squared / power) : kInfinity;
  result.psnrPeak = brightest > 0 ? brightest : 1.0;
  result.psnr = squared == 0 ? kInfinity : 20 * std::log10(result.psnrPeak / result.rmse);
  return result;
}

Image difference(const Image& test, const Image& reference, float scale) {
  assert(test.width == reference.width && test.height == reference.height);
  Image out(test.width, test.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    out.pixels[i] = (test.pixels[i] - reference.pixels[i]).abs() * scale;
  }
  return out;
}

Image colourMap(const std::vector<float>& values, int width, int height) {
  assert(values.size() == size_t(width) * height);
  // Nine stops of matplotlib's "magma" (Smith and van der Walt, CC0), sRGB 0 … 255.
  constexpr std::array<std::array<float, 3>, 9> kStops{{{0, 0, 4},
                                                        {28, 16, 68},
                                                        {79, 18, 123},
                                                        {129, 37, 129},
                                                        {181, 54, 122},
                                                        {229, 80, 100},
                                                        {251, 135, 97},
                                                        {254, 194, 135},
                                                        {252, 253, 191}}};
  Image out(width, height);
  for (size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) {
      out.pixels[i] = Rgb(0, 1, 0);
      continue;
    }
    const float at = std::clamp(values[i], 0.0f, 1.0f) * (kStops.size() - 1);
    const size_t stop = std::min<size_t>(static_cast<size_t>(at), kStops.size() - 2);
    const float t = at - static_cast<float>(stop);
    for (int c = 0; c < 3; ++c) {
      const float code = (1 - t) * kStops[stop][c] + t * kStops[stop + 1][c];
      out.pixels[i][c] = radiometry::srgbDecode(code / 255.0f);
    }
  }
  return out;
}

}  // namespace lambent::image
