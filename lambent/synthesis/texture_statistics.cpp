// This work is based on:
// - heeger1995pyramid: a texture by the histograms of the bands of its pyramid.
// - portilla2000parametric: what they leave out, the correlations of the magnitudes of bands.
// - kwatra2005texture: the energy of a texture as the distance of each neighbourhood from the best of
//   the example's, here among the places that stand in it.
//
// Where we deviate: first derivatives along four directions for a steerable pyramid's bands; and the
// patch is not one picture but laid out flat in as many windows as the result is seen in, each from
// the place at the window's middle. So what is the patch laid flat has distance 0, but for the
// rounding of ids, however few windows there are.
#include "lambent/synthesis/texture_statistics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

constexpr int kScales = 4, kOriented = 4, kBands = 1 + kOriented;

/// One channel, without a border: what lies beyond is as at the border.
struct Plane {
  int side = 0;
  std::vector<float> values;
  float at(int x, int y) const {
    x = std::clamp(x, 0, side - 1), y = std::clamp(y, 0, side - 1);
    return values[std::size_t(y) * std::size_t(side) + std::size_t(x)];
  }
};

/// By 1 4 6 4 1 along both axes.
Plane blurred(const Plane& in) {
  constexpr std::array<float, 5> kernel = {1 / 16.f, 4 / 16.f, 6 / 16.f, 4 / 16.f, 1 / 16.f};
  Plane rows{in.side, std::vector<float>(in.values.size())}, out = rows;
  for (int pass = 0; pass < 2; ++pass) {
    const Plane& from = pass == 0 ? in : rows;
    Plane& to = pass == 0 ? rows : out;
    for (int y = 0; y < in.side; ++y)
      for (int x = 0; x < in.side; ++x) {
        float sum = 0.0f;
        for (int k = -2; k <= 2; ++k)
          sum += kernel[std::size_t(k + 2)] * (pass == 0 ? from.at(x + k, y) : from.at(x, y + k));
        to.values[std::size_t(y) * std::size_t(in.side) + std::size_t(x)] = sum;
      }
  }
  return out;
}

Plane halved(const Plane& in) {
  Plane out{in.side / 2, {}};
  for (int y = 0; y < out.side; ++y)
    for (int x = 0; x < out.side; ++x) out.values.push_back(in.at(2 * x, 2 * y));
  return out;
}

/// A picture of a window in perceived colours.
struct Picture {
  int side = 0;
  std::vector<Rgb> pixels;
};

/// The patch in perceived colours.
PatchLook asPerceived(PatchLook look) {
  for (Rgb& color : look.color) color = perceived(color);
  return look;
}

/// `seen`: as all that follow, in perceived colours.
Picture pictureOf(const SurfaceWindow& window, const PatchLook& seen) {
  Picture picture{window.pixels, {}};
  for (const Vec2& q : window.places) picture.pixels.push_back(seen.colorAt(q));
  return picture;
}

/// Step of q from a pixel to the next.
Vec2 stepOf(const SurfaceWindow& window, float size, const Vec2& period) {
  return Vec2::Constant(size / float(window.pixels)).cwiseQuotient(period);
}

/// The patch laid flat over the same square, from the place at its middle; pixels that the window does
/// not hold are taken from here into both.
SurfaceWindow laidFlat(const SurfaceWindow& window, float size, const Vec2& period) {
  SurfaceWindow flat = window;
  const Vec2 step = stepOf(window, size, period);
  const int half = window.pixels / 2;
  const std::size_t from = std::size_t(half) * std::size_t(window.pixels + 1);
  for (int y = 0; y < window.pixels; ++y)
    for (int x = 0; x < window.pixels; ++x)
      flat.places[std::size_t(y) * std::size_t(window.pixels) + std::size_t(x)] =
          window.places[from] + Vec2(float(x - half), float(y - half)).cwiseProduct(step);
  return flat;
}

/// The bands of one picture, scale by scale.
struct Bands {
  std::array<std::array<std::vector<float>, kBands>, kScales> at;
};

Bands bandsOf(const Picture& picture) {
  Plane lightness{picture.side, {}};
  for (const Rgb& c : picture.pixels) lightness.values.push_back(c.mean());
  Bands bands;
  for (int scale = 0; scale < kScales && lightness.side >= 8; ++scale) {
    const Plane soft = blurred(lightness);
    auto& b = bands.at[std::size_t(scale)];
    for (int y = 0; y < soft.side; ++y)
      for (int x = 0; x < soft.side; ++x) {
        const float dx = 0.5f * (soft.at(x + 1, y) - soft.at(x - 1, y));
        const float dy = 0.5f * (soft.at(x, y + 1) - soft.at(x, y - 1));
        b[0].push_back(lightness.at(x, y) - soft.at(x, y));
        b[1].push_back(dx), b[2].push_back(std::sqrt(0.5f) * (dx + dy));
        b[3].push_back(dy), b[4].push_back(std::sqrt(0.5f) * (dy - dx));
      }
    lightness = halved(soft);
  }
  return bands;
}

/// Distance between two distributions of as many values each, in standard deviations of the second.
double wasserstein(std::vector<float> a, std::vector<float> b) {
  assert(a.size() == b.size());
  if (a.empty()) return 0.0;
  double mean = 0.0, square = 0.0, sum = 0.0;
  for (const float v : b) mean += double(v) / double(b.size());
  for (const float v : b) square += (double(v) - mean) * (double(v) - mean) / double(b.size());
  std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a[i]) - double(b[i]));
  return square > 1e-14 ? sum / double(a.size()) / std::sqrt(square) : 0.0;
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  const double n = double(a.size());
  double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += double(a[i]) / n, mb += double(b[i]) / n;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = double(a[i]) - ma, y = double(b[i]) - mb;
    aa += x * x, bb += y * y, ab += x * y;
  }
  return aa > 1e-20 && bb > 1e-20 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// Values of one band in all windows, and their magnitudes.
std::vector<float> pooled(const std::vector<Bands>& all, int scale, int band) {
  std::vector<float> values;
  for (const Bands& b : all) {
    const auto& more = b.at[std::size_t(scale)][std::size_t(band)];
    values.insert(values.end(), more.begin(), more.end());
  }
  return values;
}

std::vector<float> magnitudes(std::vector<float> values) {
  for (float& v : values) v = std::abs(v);
  return values;
}

double statisticsApart(const std::vector<Picture>& result, const std::vector<Picture>& flat) {
  std::vector<Bands> ours(result.size()), theirs(flat.size());
  work::parallelFor(result.size(), [&](std::size_t k) {
    ours[k] = bandsOf(result[k]), theirs[k] = bandsOf(flat[k]);
  });
  std::vector<double> apart;
  for (int scale = 0; scale < kScales; ++scale) {
    std::array<std::vector<float>, kBands> a, b;
    for (int band = 0; band < kBands; ++band) {
      a[std::size_t(band)] = pooled(ours, scale, band);
      b[std::size_t(band)] = pooled(theirs, scale, band);
      apart.push_back(wasserstein(a[std::size_t(band)], b[std::size_t(band)]));
      a[std::size_t(band)] = magnitudes(std::move(a[std::size_t(band)]));
      b[std::size_t(band)] = magnitudes(std::move(b[std::size_t(band)]));
    }
    for (std::size_t i = 0; i < kBands; ++i)
      for (std::size_t j = i + 1; j < kBands; ++j)
        apart.push_back(std::abs(correlation(a[i], a[j]) - correlation(b[i], b[j])));
  }
  for (int c = 0; c < 3; ++c) {
    std::vector<float> a, b;
    for (std::size_t k = 0; k < result.size(); ++k)
      for (std::size_t p = 0; p < result[k].pixels.size(); ++p)
        a.push_back(result[k].pixels[p][c]), b.push_back(flat[k].pixels[p][c]);
    apart.push_back(wasserstein(std::move(a), std::move(b)));
  }
  double sum = 0.0;
  for (const double v : apart) sum += v / double(apart.size());
  return sum;
}

/// Variance of colours over the patch, summed over channels.
double varianceOf(const PatchLook& seen) {
  Rgb mean = Rgb::Zero(), square = Rgb::Zero();
  for (const Rgb& c : seen.color) mean += c / float(seen.color.size());
  for (const Rgb& c : seen.color) square += (c - mean).square() / float(seen.color.size());
  return double(square.sum());
}

/// Of the window's neighbourhoods, the mean squared difference from the best of the places in them.
double misfitOf(const SurfaceWindow& window, const Picture& picture, const PatchLook& seen,
                const Vec2& step) {
  const int n = window.pixels, size = std::max(4, n / 4), stride = std::max(1, size / 8);
  double sum = 0.0;
  int count = 0;
  for (int y0 = 0; y0 + size <= n; y0 += size)
    for (int x0 = 0; x0 + size <= n; x0 += size) {
      double best = -1.0;
      for (int cy = size / 8; cy < size; cy += std::max(1, size / 4))
        for (int cx = size / 8; cx < size; cx += std::max(1, size / 4)) {
          const Vec2 from =
              window.places[std::size_t(y0 + cy) * std::size_t(n) + std::size_t(x0 + cx)];
          double off = 0.0;
          int pixels = 0;
          for (int y = 0; y < size; y += stride)
            for (int x = 0; x < size; x += stride) {
              const Vec2 q = from + Vec2(float(x - cx), float(y - cy)).cwiseProduct(step);
              const std::size_t p = std::size_t(y0 + y) * std::size_t(n) + std::size_t(x0 + x);
              off += double((seen.colorAt(q) - picture.pixels[p]).square().sum());
              ++pixels;
            }
          off /= double(pixels);
          if (best < 0.0 || off < best) best = off;
        }
      sum += best, ++count;
    }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

Unlikeness unlikenessOf(std::span<const SurfaceWindow> windows, float size, const Vec2& period,
                        const PatchLook& look) {
  assert(!windows.empty());
  const PatchLook seen = asPerceived(look);
  std::vector<Picture> result(windows.size()), flat(windows.size());
  std::vector<double> misfits(windows.size());
  work::parallelFor(windows.size(), [&](std::size_t k) {
    SurfaceWindow window = windows[k];
    const SurfaceWindow level = laidFlat(window, size, period);
    for (std::size_t p = 0; p < window.places.size(); ++p)
      if (!window.held[p]) window.places[p] = level.places[p];
    result[k] = pictureOf(window, seen), flat[k] = pictureOf(level, seen);
    misfits[k] = misfitOf(window, result[k], seen, stepOf(window, size, period));
  });
  Unlikeness unlikeness;
  unlikeness.statistics = statisticsApart(result, flat);
  const double variance = varianceOf(seen);
  for (const double m : misfits)
    if (variance > 0.0) unlikeness.misfit += m / (2.0 * variance) / double(windows.size());
  return unlikeness;
}

namespace {

/// Autocorrelation of the patch at its own shifts, none near a whole period.
double ownRepetition(const PatchLook& seen) {
  std::vector<Rgb> centred = seen.color;
  Rgb mean = Rgb::Zero();
  for (const Rgb& c : centred) mean += c / float(centred.size());
  for (Rgb& c : centred) c -= mean;
  const double variance = varianceOf(seen);
  if (!(variance > 0.0)) return 1.0;
  const int w = seen.width, h = seen.height;
  const int sx = w >= 32 ? 2 : 1, sy = h >= 32 ? 2 : 1;
  std::vector<double> best(std::size_t(h / 2 + 1), 0.0);
  work::parallelFor(h / 2 + 1, [&](int dy) {
    for (int dx = 0; dx < w; ++dx) {
      if (4 * std::min(dx, w - dx) < w && 4 * dy < h) continue;
      double sum = 0.0;
      int count = 0;
      for (int y = 0; y < h; y += sy)
        for (int x = 0; x < w; x += sx) {
          const Rgb& a = centred[std::size_t(y) * std::size_t(w) + std::size_t(x)];
          const Rgb& b =
              centred[std::size_t((y + dy) % h) * std::size_t(w) + std::size_t((x + dx) % w)];
          sum += double((a * b).sum()), ++count;
        }
      best[std::size_t(dy)] = std::max(best[std::size_t(dy)], sum / count / variance);
    }
  });
  return *std::max_element(best.begin(), best.end());
}

}  // namespace

double repetitionOf(std::span<const SurfaceWindow> windows, float size, const Vec2& period,
                    const PatchLook& look) {
  assert(!windows.empty());
  const int n = windows.front().pixels;
  const PatchLook seen = asPerceived(look);
  std::vector<Picture> pictures(windows.size());
  work::parallelFor(windows.size(),
                    [&](std::size_t k) { pictures[k] = pictureOf(windows[k], seen); });
  Rgb mean = Rgb::Zero();
  double count = 0.0;
  for (std::size_t k = 0; k < windows.size(); ++k)
    for (std::size_t p = 0; p < pictures[k].pixels.size(); ++p)
      if (windows[k].held[p]) mean += pictures[k].pixels[p], count += 1.0;
  mean /= float(count);
  for (Picture& picture : pictures)
    for (Rgb& c : picture.pixels) c -= mean;
  const float nearest = 0.25f * period.minCoeff() / size * float(n);
  const int most = n / 2;
  std::vector<double> best(std::size_t(most) + 1, 0.0);
  work::parallelFor(most + 1, [&](int dy) {
    for (int dx = -most; dx <= most; ++dx) {
      if (float(dx * dx + dy * dy) < nearest * nearest) continue;
      double ab = 0.0, aa = 0.0, bb = 0.0;
      for (std::size_t k = 0; k < pictures.size(); ++k)
        for (int y = 0; y + dy < n; y += 2)
          for (int x = std::max(0, -dx); x < std::min(n, n - dx); x += 2) {
            const std::size_t p = std::size_t(y) * std::size_t(n) + std::size_t(x);
            const std::size_t q = std::size_t(y + dy) * std::size_t(n) + std::size_t(x + dx);
            if (!windows[k].held[p] || !windows[k].held[q]) continue;
            const Rgb &a = pictures[k].pixels[p], &b = pictures[k].pixels[q];
            ab += double((a * b).sum()), aa += double(a.square().sum());
            bb += double(b.square().sum());
          }
      if (aa > 0.0 && bb > 0.0)
        best[std::size_t(dy)] = std::max(best[std::size_t(dy)], ab / std::sqrt(aa * bb));
    }
  });
  return std::max(0.0, *std::max_element(best.begin(), best.end()) - ownRepetition(seen));
}

}  // namespace lambent::synthesis
