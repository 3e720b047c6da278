// Projection of environment maps: sloan2002precomputed eq. 1 and §6.2 (B_i(s) = y_i(s) ds),
// ramamoorthi2001efficient eq. 10.
//
//   ds       solid angle of a pixel. The paper uses the differential one at the pixel's centre,
//            4/n² (1 + a² + b²)^(−3/2) on a cube; we use the exact one, so that a constant is
//            projected without error (six 4×4 faces: worst squared error .94 % against 1.21 %).
//
// Latitude-longitude pictures are projected row by row. Along a row, at a fixed elevation, each
// y_i is a trigonometric polynomial of the azimuth φ of degree < bands:
//
//   y_i(row, φ) = Σ_k A_ik cos kφ + B_ik sin kφ
//
// so a row needs its own 2·bands − 1 Fourier sums, 3 channels each, instead of bands² basis values
// at every pixel: O(bands) a pixel. A and B come from 2·bands samples of y_i around the row.
#include "lambent/image/project.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/math/directions.h"
#include "lambent/sh/basis.h"
#include "lambent/work/parallel_for.h"

namespace lambent::image {
namespace {

constexpr int kLanes = 8;

/// A sum in eight fixed lanes: the compiler may use vectors, and the bytes do not depend on it.
double dot(const double* a, const double* b, int paddedCount) {
  std::array<double, kLanes> lanes{};
  for (int i = 0; i < paddedCount; i += kLanes) {
    for (int k = 0; k < kLanes; ++k) lanes[k] += a[i + k] * b[i + k];
  }
  return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
         ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

using Sums = std::vector<double>;  ///< 3·bands², channel after channel

/// Work in blocks of rows whose limits depend on the picture alone, added up in sequence.
Sums sumOverRows(int rows, int count, const auto& addRows) {
  constexpr int kMaxBlocks = 64;
  const int blockRows = (rows + kMaxBlocks - 1) / kMaxBlocks;
  const int blocks = (rows + blockRows - 1) / blockRows;
  std::vector<Sums> partial(blocks, Sums(count));
  work::parallelFor(blocks, [&](int b) {
    addRows(b * blockRows, std::min((b + 1) * blockRows, rows), partial[b]);
  });
  Sums total(count);
  for (const Sums& block : partial) {
    for (int i = 0; i < count; ++i) total[i] += block[i];
  }
  return total;
}

class LatLongProjection {
 public:
  LatLongProjection(const Image& map, int bands)
      : map_(map),
        bands_(bands),
        terms_(2 * bands - 1),
        padded_((map.width + kLanes - 1) / kLanes * kLanes),
        waves_(size_t(terms_) * padded_) {
    for (int x = 0; x < map.width; ++x) {
      const double phi = 2 * kPi * ((x + 0.5) / map.width - 0.5);
      for (int t = 0; t < terms_; ++t) waves_[size_t(t) * padded_ + x] = wave(t, phi);
    }
  }

  Sums run() const {
    return sumOverRows(map_.height, 3 * bands_ * bands_,
                       [this](int begin, int end, Sums& sums) { addRows(begin, end, sums); });
  }

 private:
  /// Term 0 is 1, terms 2k − 1 and 2k are cos kφ and sin kφ.
  static double wave(int term, double phi) {
    const int k = (term + 1) / 2;
    return term % 2 ? std::cos(k * phi) : term == 0 ? 1.0 : std::sin(k * phi);
  }

  void addRows(int begin, int end, Sums& sums) const {
    const int coefficients = bands_ * bands_;
    std::vector<double> planes(3 * size_t(padded_));
    std::vector<double> fourier(3 * size_t(terms_));
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < map_.width; ++x) {
        for (int c = 0; c < 3; ++c) planes[size_t(c) * padded_ + x] = map_.at(x, y)[c];
      }
      const double elevation = kPi * (0.5 - (y + 0.5) / map_.height);
      const double solidAngle =
          2 * kPi / map_.width * 2 * std::cos(elevation) * std::sin(0.5 * kPi / map_.height);
      for (int c = 0; c < 3; ++c) {
        for (int t = 0; t < terms_; ++t) {
          fourier[size_t(c) * terms_ + t] =
              solidAngle * dot(&planes[size_t(c) * padded_], &waves_[size_t(t) * padded_], padded_);
        }
      }
      const std::vector<double> series = seriesOfRow(elevation);
      for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < coefficients; ++i) {
          double sum = 0;
          for (int t = 0; t < terms_; ++t) {
            sum += series[size_t(i) * terms_ + t] * fourier[size_t(c) * terms_ + t];
          }
          sums[size_t(c) * coefficients + i] += sum;
        }
      }
    }
  }

  /// A and B of every basis function: bands² × terms.
  std::vector<double> seriesOfRow(double elevation) const {
    const int coefficients = bands_ * bands_;
    const int samples = 2 * bands_;
    std::vector<double> series(size_t(coefficients) * terms_);
    std::vector<double> values(coefficients);
    for (int s = 0; s < samples; ++s) {
      const double phi = 2 * kPi * s / samples;
      sh::evaluate(bands_, math::directionFromAzimuthElevation(phi, elevation), values);
      for (int t = 0; t < terms_; ++t) {
        const double weight = (t == 0 ? 1.0 : 2.0) / samples * wave(t, phi);
        for (int i = 0; i < coefficients; ++i) {
          series[size_t(i) * terms_ + t] += weight * values[i];
        }
      }
    }
    return series;
  }

  const Image& map_;
  int bands_, terms_, padded_;
  std::vector<double> waves_;  ///< terms × padded width; zeros beyond the width
};

Sums projectPixels(const Image& map, MapKind kind, int bands) {
  const MapShape shape{kind, map.width, map.height};
  const std::vector<double> angles = solidAngles(shape);
  const int coefficients = bands * bands;
  return sumOverRows(map.height, 3 * coefficients, [&](int begin, int end, Sums& sums) {
    std::vector<double> basis(coefficients);
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const double angle = angles[size_t(y) * map.width + x];
        if (angle == 0) continue;
        const std::optional<Vec3d> centre = directionOf(shape, {x + 0.5, y + 0.5});
        // A pixel of a round map whose centre lies beyond the rim, while a part of it does not,
        // shows −z; what is stored in it may be black.
        const Vec3d direction = centre.value_or(-Vec3d::UnitZ());
        const Rgb value = centre ? map.at(x, y) : sample(map, kind, direction);
        sh::evaluate(bands, direction, basis);
        for (int c = 0; c < 3; ++c) {
          const double weight = angle * value[c];
          double* const out = &sums[size_t(c) * coefficients];
          for (int i = 0; i < coefficients; ++i) out[i] += weight * basis[i];
        }
      }
    }
  });
}

}  // namespace

sh::RgbCoefficients project(const Image& map, MapKind kind, int bands) {
  assert(checkShape({kind, map.width, map.height}));
  assert(bands >= 1 && bands <= 32);
  const Sums sums = kind == MapKind::LatLong ? LatLongProjection(map, bands).run()
                                             : projectPixels(map, kind, bands);
  sh::RgbCoefficients result(bands);
  std::transform(sums.begin(), sums.end(), result.values.begin(),
                 [](double v) { return static_cast<float>(v); });
  return result;
}

}  // namespace lambent::image
