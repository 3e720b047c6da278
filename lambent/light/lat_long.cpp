// An environment map in latitude and longitude: the bilinear interpolant of the pixels' centres,
// in azimuth and elevation; it wraps around in azimuth, and is constant in the half pixel next to
// a pole. Look-up, sampling and projection are all of this one function, so that they agree.
//
// Projection. The function is separable in the frame whose pole is the image's, so a row needs
// only its Fourier sums over azimuth, and the rows' elevations a small quadrature each:
//   f_lm = Σ_rows W_row,l|m| · Δφ sinc²(mΔφ/2) Σ_x pixel_x {cos, sin} mφ_x
// where sinc² is the transform of the linear interpolation's hat. Then one rotation to the world.
//
// Sampling. A cell lies between four pixel centres. It is drawn by its mean importance times its
// solid angle per unit of the image; in the cell, (u, v) is drawn by the bilinear importance
// itself.
//
// This work is based on:
// - pharr2023physically: §12.5 image infinite lights, §A.5 sampling of bilinear functions.
// - ramamoorthi2001efficient: eq. 10, the projection of an image.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "lambent/light/built_in.h"
#include "lambent/light/grid_distribution.h"
#include "lambent/math/directions.h"
#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/rotation.h"

namespace lambent::light {
namespace {

/// The pixels that no rotation copies, with what was made of them.
struct Pixels {
  image::Image image;
  std::vector<double> rowFactor;  ///< mean cos(elevation) of the height+1 rows of cells
  GridDistribution cells;         ///< width × (height+1)
};

/// Cells of row r reach from pixel row r−1 to r; the first and the last are half as high.
double rowTop(int r, int height) {
  return std::max(0.0, (r - 0.5) / height);
}
double rowBottom(int r, int height) {
  return std::min(1.0, (r + 0.5) / height);
}

int clampRow(int y, int height) {
  return std::clamp(y, 0, height - 1);
}

std::shared_ptr<const Pixels> makePixels(image::Image image) {
  auto pixels = std::make_shared<Pixels>();
  for (Rgb& p : image.pixels)
    if (!p.isFinite().all()) p = Rgb::Zero();
  const int w = image.width, h = image.height;
  pixels->rowFactor.resize(h + 1);
  std::vector<double> weights(std::size_t(w) * (h + 1));
  std::vector<double> lum(image.pixels.size());
  for (std::size_t i = 0; i < lum.size(); ++i) lum[i] = importance(image.pixels[i]);
  for (int r = 0; r <= h; ++r) {
    const double top = rowTop(r, h), bottom = rowBottom(r, h);
    const double sines = std::sin(kPi * (0.5 - top)) - std::sin(kPi * (0.5 - bottom));
    pixels->rowFactor[r] = sines / (kPi * (bottom - top));
    const double area = pixels->rowFactor[r] * (bottom - top) / w;
    const double* above = lum.data() + std::size_t(clampRow(r - 1, h)) * w;
    const double* below = lum.data() + std::size_t(clampRow(r, h)) * w;
    for (int x = 0; x < w; ++x) {
      const int next = x + 1 == w ? 0 : x + 1;
      weights[std::size_t(r) * w + x] =
          0.25 * (above[x] + above[next] + below[x] + below[next]) * area;
    }
  }
  pixels->cells = GridDistribution(w, h + 1, weights);
  pixels->image = std::move(image);
  return pixels;
}

/// t in [0, 1] with density ∝ (1 − t) a + t b.
double drawLinear(double u, double a, double b) {
  if (!(a + b > 0)) return u;
  return std::min(1.0, u * (a + b) / (a + std::sqrt((1 - u) * a * a + u * b * b)));
}

class LatLong final : public Component {
 public:
  LatLong(std::shared_ptr<const Pixels> pixels, const Mat3& worldFromImage)
      : pixels_(std::move(pixels)), worldFromImage_(worldFromImage) {}

  double power() const override { return 2 * kPi * kPi * pixels_->cells.total(); }

  Rgb radiance(const Vec3& direction) const override { return tapsTowards(direction).radiance(); }

  double pdf(const Vec3& direction) const override {
    if (!(power() > 0)) return 1 / (4 * kPi);
    double cosElevation;
    const Taps taps = tapsTowards(direction, &cosElevation);
    return density(taps, cosElevation);
  }

  Drawn draw(double u1, double u2) const override {
    const image::Image& im = pixels_->image;
    Taps taps;
    if (power() > 0) {
      const GridDistribution::Cell cell = pixels_->cells.draw(u1, u2);
      taps = tapsAt(cell.x, cell.y);
      double i[4];
      for (int k = 0; k < 4; ++k) i[k] = importance(*taps.pixel[k]);
      if (cell.y == 0 || cell.y == im.height) {  // half a cell, the same above and below
        taps.v = cell.y == 0 ? 0.5 + 0.5 * cell.v : 0.5 * cell.v;
      } else {
        taps.v = drawLinear(cell.v, i[0] + i[1], i[2] + i[3]);
      }
      taps.u = drawLinear(cell.u, (1 - taps.v) * i[0] + taps.v * i[2],
                          (1 - taps.v) * i[1] + taps.v * i[3]);
    } else {
      // Black: any direction will do, and the density that pdf() gives.
      const double y = 1 - 2 * u2, r = std::sqrt(std::max(0.0, 1 - y * y));
      const Vec3d s(r * std::cos(2 * kPi * u1), y, r * std::sin(2 * kPi * u1));
      return {worldFromImage_ * s.cast<float>(), Rgb::Zero(), 1 / (4 * kPi)};
    }
    const double azimuth = 2 * kPi * ((taps.x + 0.5 + taps.u) / im.width - 0.5);
    const double elevation = kPi * (0.5 - (taps.row - 0.5 + taps.v) / im.height);
    const double cosElevation = std::cos(elevation);
    const Vec3d s = math::directionFromAzimuthElevation(azimuth, elevation);
    return {worldFromImage_ * s.cast<float>(), taps.radiance(), density(taps, cosElevation)};
  }

  void addProjection(int bands, std::span<double> out) const override;

  ComponentPtr rotated(const Mat3& dstFromSrc) const override {
    return std::make_shared<LatLong>(pixels_, dstFromSrc * worldFromImage_);
  }

  bool addTo(Environment::Parts& parts) const override {
    parts.images.push_back({{pixels_, &pixels_->image}, worldFromImage_});
    return true;
  }

 private:
  /// The four pixels around a place, left before right, above before below.
  struct Taps {
    int x, row;  ///< the cell
    const Rgb* pixel[4];
    double u = 0, v = 0;  ///< place within the cell, in [0, 1]
    Rgb radiance() const {
      const float a = float(u), b = float(v);
      return (1 - b) * ((1 - a) * *pixel[0] + a * *pixel[1]) +
             b * ((1 - a) * *pixel[2] + a * *pixel[3]);
    }
  };

  Taps tapsAt(int x, int row) const {
    const image::Image& im = pixels_->image;
    const int next = x + 1 == im.width ? 0 : x + 1;
    const int above = clampRow(row - 1, im.height), below = clampRow(row, im.height);
    return {x, row, {&im.at(x, above), &im.at(next, above), &im.at(x, below), &im.at(next, below)}};
  }

  Taps tapsTowards(const Vec3& direction, double* cosElevation = nullptr) const {
    const image::Image& im = pixels_->image;
    const Vec3 s = worldFromImage_.transpose() * direction;
    const auto [azimuth, elevation] = math::azimuthElevationOf(s);
    const double column = (azimuth / (2 * kPi) + 0.5) * im.width - 0.5;
    const double row = (0.5 - elevation / kPi) * im.height + 0.5;
    const double x = std::floor(column), y = std::clamp(std::floor(row), 0.0, double(im.height));
    Taps taps = tapsAt((int(x) + im.width) % im.width, int(y));
    taps.u = column - x;
    taps.v = std::clamp(row - y, 0.0, 1.0);
    if (cosElevation) *cosElevation = std::sqrt(s.x() * s.x() + s.z() * s.z());
    return taps;
  }

  /// Density per steradian: du dv = ds / (2π² cos elevation).
  double density(const Taps& taps, double cosElevation) const {
    double i[4];
    for (int k = 0; k < 4; ++k) i[k] = importance(*taps.pixel[k]);
    const double here = (1 - taps.v) * ((1 - taps.u) * i[0] + taps.u * i[1]) +
                        taps.v * ((1 - taps.u) * i[2] + taps.u * i[3]);
    // At the pole itself the density has an integrable peak; cut to stay finite.
    return here * pixels_->rowFactor[taps.row] /
           (pixels_->cells.total() * 2 * kPi * kPi * std::max(cosElevation, 1e-6));
  }

  std::shared_ptr<const Pixels> pixels_;
  Mat3 worldFromImage_;
};

/// ∫ hat_y(elevation) y_lm(cos, 0, sin) cos(elevation) d elevation for every row y of pixels and
/// every coefficient with m ≥ 0; [row][bands²].
std::vector<double> rowWeights(int height, int bands) {
  const int count = sh::coefficientCount(bands);
  std::vector<double> weights(std::size_t(height) * count), basis(count);
  // The integrand is a polynomial in sine and cosine of degree `bands` times a linear function.
  const int nodes = height < 64 ? 24 : 6;
  for (int r = 0; r <= height; ++r) {
    const double top = rowTop(r, height), bottom = rowBottom(r, height);
    const math::Quadrature rule = math::gaussLegendre(nodes, top, bottom);
    for (int k = 0; k < nodes; ++k) {
      const double elevation = kPi * (0.5 - rule.nodes[k]);
      const Vec3d s(std::cos(elevation), 0, std::sin(elevation));
      sh::evaluate(bands, s, std::span<double>(basis));
      const double w = rule.weights[k] * kPi * s.x();
      const double below = rule.nodes[k] * height + 0.5 - r;
      double* a = weights.data() + std::size_t(clampRow(r - 1, height)) * count;
      double* b = weights.data() + std::size_t(clampRow(r, height)) * count;
      for (int i = 0; i < count; ++i) {
        a[i] += w * (1 - below) * basis[i];
        b[i] += w * below * basis[i];
      }
    }
  }
  return weights;
}

void LatLong::addProjection(int bands, std::span<double> out) const {
  const image::Image& im = pixels_->image;
  const int w = im.width, h = im.height, count = sh::coefficientCount(bands);
  // The frame of the sums has its +z at the image's pole: (x, −z, y), so its azimuth is −a where a
  // is the image's.
  Mat3d imageFromPolar;
  imageFromPolar << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const double step = 2 * kPi / w;
  std::vector<double> cosines(std::size_t(bands) * w), sines(std::size_t(bands) * w);
  for (int m = 0; m < bands; ++m) {
    const double half = 0.5 * m * step;
    const double sinc = m ? std::sin(half) / half : 1;
    for (int x = 0; x < w; ++x) {
      const double angle = -m * 2 * kPi * ((x + 0.5) / w - 0.5);
      cosines[std::size_t(m) * w + x] = step * sinc * sinc * std::cos(angle);
      sines[std::size_t(m) * w + x] = step * sinc * sinc * std::sin(angle);
    }
  }
  const std::vector<double> weights = rowWeights(h, bands);
  std::vector<double> polar(3 * std::size_t(count));
  for (int y = 0; y < h; ++y) {
    const Rgb* row = &im.at(0, y);
    for (int m = 0; m < bands; ++m) {
      const double* cosine = cosines.data() + std::size_t(m) * w;
      const double* sine = sines.data() + std::size_t(m) * w;
      double even[3] = {}, odd[3] = {};
      for (int x = 0; x < w; ++x)
        for (int c = 0; c < 3; ++c) {
          even[c] += cosine[x] * double(row[x][c]);
          odd[c] += sine[x] * double(row[x][c]);
        }
      for (int l = m; l < bands; ++l) {
        const double weight = weights[std::size_t(y) * count + sh::index(l, m)];
        for (int c = 0; c < 3; ++c) {
          polar[c * count + sh::index(l, m)] += weight * even[c];
          if (m) polar[c * count + sh::index(l, -m)] += weight * odd[c];
        }
      }
    }
  }
  const std::vector<double> rotation =
      sh::rotationMatrix(bands, worldFromImage_.cast<double>() * imageFromPolar);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        out[c * count + i] += rotation[std::size_t(i) * count + j] * polar[c * count + j];
}

}  // namespace

ComponentPtr makeLatLong(image::Image image) {
  assert(image.width > 0 && image.height > 0 &&
         image.pixels.size() == std::size_t(image.width) * image.height);
  return std::make_shared<LatLong>(makePixels(std::move(image)), Mat3(Mat3::Identity()));
}

}  // namespace lambent::light
