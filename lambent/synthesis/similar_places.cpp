// This work is based on:
// - tong2002synthesis (§4): k-coherence; a place's candidates are its neighbours' places moved on
//   and the k places most similar to them, found once before synthesis.
// - lefebvre2006appearance (§3): neighbourhoods are compared by their principal components.
// - lefebvre2005parallel (§3.1): the patch of each level is prefiltered, not decimated.
#include "lambent/synthesis/similar_places.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

constexpr int kGrid = 64;        ///< listed places a side at most
constexpr int kWindow = 2;       ///< a neighbourhood is (2·kWindow + 1)² places
constexpr int kComponents = 12;  ///< of a neighbourhood

int wrap(int i, int n) {
  const int r = i % n;
  return r < 0 ? r + n : r;
}

}  // namespace

Vec2 intoPatch(const Vec2& q) {
  Vec2 r(q.x() - std::floor(q.x()), q.y() - std::floor(q.y()));
  if (r.x() >= 1.0f) r.x() = 0.0f;  // −1e-9 rounds up to 1
  if (r.y() >= 1.0f) r.y() = 0.0f;
  return r;
}

PatchLevel::PatchLevel(const Appearance& appearance, const Vec2& size, float spacing,
                       int candidates)
    : width_(appearance.width),
      height_(appearance.height),
      dimensions_(std::min(appearance.dimensions, kMaximumDimensions)),
      stride_((dimensions_ + 3) / 4 * 4),
      candidates_(candidates) {
  assert(width_ > 0 && height_ > 0 && dimensions_ > 0);
  values_.assign(std::size_t(width_) * std::size_t(height_) * std::size_t(stride_), 0.0f);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      std::copy_n(appearance.at(x, y), dimensions_,
                  values_.data() + (std::size_t(y) * std::size_t(width_) + std::size_t(x)) *
                                       std::size_t(stride_));
  const Vec2 step(spacing / size.x(), spacing / size.y());
  // Half the spacing: what vertices so far apart can still tell apart.
  prefilter(Vec2(0.5f * step.x() * float(width_), 0.5f * step.y() * float(height_)));
  std::vector<double> sum(std::size_t(dimensions_), 0.0), squares(std::size_t(dimensions_), 0.0);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::size_t d = i % std::size_t(stride_);
    if (d >= std::size_t(dimensions_)) continue;
    sum[d] += double(values_[i]), squares[d] += double(values_[i]) * double(values_[i]);
  }
  const double places = double(width_) * double(height_);
  for (std::size_t d = 0; d < sum.size(); ++d) {
    variance_ += float(std::max(squares[d] / places - sum[d] / places * sum[d] / places, 0.0));
  }
  gridWidth_ = std::min(width_, kGrid), gridHeight_ = std::min(height_, kGrid);
  findWindows(step);

  const Vec2 separation(std::max(step.x(), 2.0f / float(gridWidth_)),
                        std::max(step.y(), 2.0f / float(gridHeight_)));
  const auto points = std::uint32_t(gridWidth_ * gridHeight_);
  std::vector<std::vector<Found>> found(points);
  work::parallelRanges(points, 64, [&](std::uint32_t begin, std::uint32_t end) {
    std::vector<float> distances;
    for (std::uint32_t p = begin; p < end; ++p) {
      found[p] = search(p, candidates, separation, distances);
    }
  });
  similar_.resize(std::size_t(points) * std::size_t(candidates_));
  for (std::uint32_t p = 0; p < points; ++p) {
    for (std::size_t k = 0; k < std::size_t(candidates_); ++k) {
      // A patch of few places may have fewer: then the place itself stands in for the missing.
      similar_[p * std::size_t(candidates_) + k] = k < found[p].size() ? found[p][k].point : p;
    }
  }
}

void PatchLevel::prefilter(const Vec2& sigma) {
  for (int axis = 0; axis < 2; ++axis) {
    if (sigma[axis] < 0.4f) continue;  // a texel's own width does as much
    const int n = axis == 0 ? width_ : height_;
    const int radius = int(std::ceil(3.0f * sigma[axis]));
    std::vector<float> kernel(std::size_t(n), 0.0f);
    float total = 0.0f;
    for (int i = -radius; i <= radius; ++i) {
      const float x = float(i) / sigma[axis];
      const float w = std::exp(-0.5f * x * x);
      kernel[std::size_t(wrap(i, n))] += w;  // wrapped around: the patch is a torus
      total += w;
    }
    std::vector<float> filtered(values_.size(), 0.0f);
    work::parallelFor(height_, [&](int y) {
      for (int x = 0; x < width_; ++x) {
        float* out = filtered.data() +
                     (std::size_t(y) * std::size_t(width_) + std::size_t(x)) * std::size_t(stride_);
        for (int i = 0; i < n; ++i) {
          const float w = kernel[std::size_t(i)] / total;
          if (w < 1e-7f) continue;
          const int sx = axis == 0 ? wrap(x + i, n) : x, sy = axis == 0 ? y : wrap(y + i, n);
          const float* in =
              values_.data() +
              (std::size_t(sy) * std::size_t(width_) + std::size_t(sx)) * std::size_t(stride_);
          for (int d = 0; d < stride_; ++d) out[d] += w * in[d];
        }
      }
    });
    values_.swap(filtered);
  }
}

void PatchLevel::descriptor(const Vec2& q, Descriptor& out) const {
  const float x = q.x() * float(width_) - 0.5f, y = q.y() * float(height_) - 0.5f;
  const float fx = std::floor(x), fy = std::floor(y);
  const float u = x - fx, v = y - fy;
  int x0 = int(fx), y0 = int(fy);
  if (x0 < 0 || x0 >= width_) x0 = wrap(x0, width_);
  if (y0 < 0 || y0 >= height_) y0 = wrap(y0, height_);
  const int x1 = x0 + 1 == width_ ? 0 : x0 + 1, y1 = y0 + 1 == height_ ? 0 : y0 + 1;
  const auto at = [&](int i, int j) {
    return values_.data() +
           (std::size_t(j) * std::size_t(width_) + std::size_t(i)) * std::size_t(stride_);
  };
  const float *a = at(x0, y0), *b = at(x1, y0), *c = at(x0, y1), *d = at(x1, y1);
  const float wa = (1.0f - u) * (1.0f - v), wb = u * (1.0f - v), wc = (1.0f - u) * v, wd = u * v;
  for (int k = 0; k < stride_; k += 4) {
    for (int l = k; l < k + 4; ++l) {
      out[std::size_t(l)] = wa * a[l] + wb * b[l] + wc * c[l] + wd * d[l];
    }
  }
}

float PatchLevel::distance(const Vec2& q, const Descriptor& other) const {
  Descriptor own;
  descriptor(q, own);
  float sum = 0.0f;
  for (int k = 0; k < stride_; ++k) {
    const float d = own[std::size_t(k)] - other[std::size_t(k)];
    sum += d * d;
  }
  return sum;
}

void PatchLevel::findWindows(const Vec2& step) {
  constexpr int kSide = 2 * kWindow + 1;
  const Eigen::Index points = gridWidth_ * gridHeight_;
  const Eigen::Index full = Eigen::Index(kSide) * kSide * dimensions_;
  // No further apart than lets the window cover the patch once.
  const Vec2 apart(std::min(step.x(), 1.0f / kSide), std::min(step.y(), 1.0f / kSide));
  Eigen::MatrixXf all(full, points);
  work::parallelFor(points, [&](Eigen::Index p) {
    Descriptor d;
    Eigen::Index row = 0;
    for (int y = -kWindow; y <= kWindow; ++y) {
      for (int x = -kWindow; x <= kWindow; ++x) {
        descriptor(place(std::uint32_t(p)) + Vec2(float(x) * apart.x(), float(y) * apart.y()), d);
        const float w = std::exp(-0.25f * float(x * x + y * y));
        for (int k = 0; k < dimensions_; ++k) all(row++, p) = w * d[std::size_t(k)];
      }
    }
  });
  all.colwise() -= Eigen::VectorXf(all.rowwise().mean());
  const Eigen::MatrixXd covariance = (all * all.transpose()).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  windowDimensions_ = int(std::min<Eigen::Index>(kComponents, full));
  windows_ = eigen.eigenvectors().rightCols(windowDimensions_).cast<float>().transpose() * all;
  windowVariance_ = windows_.squaredNorm() / float(points);
}

Vec2 PatchLevel::place(std::uint32_t point) const {
  return Vec2((float(int(point) % gridWidth_) + 0.5f) / float(gridWidth_),
              (float(int(point) / gridWidth_) + 0.5f) / float(gridHeight_));
}

std::uint32_t PatchLevel::gridPoint(const Vec2& q) const {
  const Vec2 p = intoPatch(q);
  const int x = std::min(int(p.x() * float(gridWidth_)), gridWidth_ - 1);
  const int y = std::min(int(p.y() * float(gridHeight_)), gridHeight_ - 1);
  return std::uint32_t(y * gridWidth_ + x);
}

std::vector<PatchLevel::Found> PatchLevel::search(std::uint32_t point, int count,
                                                  const Vec2& separation,
                                                  std::vector<float>& distances) const {
  const auto points = std::size_t(gridWidth_ * gridHeight_);
  distances.assign(points, 0.0f);
  for (std::size_t p = 0; p < points; ++p) {
    const float* a = windows_.data() + std::size_t(windowDimensions_) * p;
    const float* b = windows_.data() + std::size_t(windowDimensions_) * point;
    float sum = 0.0f;
    for (int k = 0; k < windowDimensions_; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    distances[p] = sum;
  }
  constexpr float kTaken = 3e38f;
  const auto take = [&](std::uint32_t p) {
    const int rx = std::min(int(std::ceil(separation.x() * float(gridWidth_))) - 1, gridWidth_ / 2);
    const int ry =
        std::min(int(std::ceil(separation.y() * float(gridHeight_))) - 1, gridHeight_ / 2);
    for (int y = -ry; y <= ry; ++y) {
      for (int x = -rx; x <= rx; ++x) {
        distances[std::size_t(wrap(int(p) / gridWidth_ + y, gridHeight_) * gridWidth_ +
                              wrap(int(p) % gridWidth_ + x, gridWidth_))] = kTaken;
      }
    }
  };
  take(point);
  std::vector<Found> found;
  for (int k = 0; k < count; ++k) {
    const auto best = std::min_element(distances.begin(), distances.end());
    if (*best == kTaken) break;
    found.push_back({std::uint32_t(best - distances.begin()), *best});
    take(found.back().point);
  }
  return found;
}

Vec2 PatchLevel::similar(const Vec2& q, int k) const {
  const std::uint32_t p = gridPoint(q);
  return intoPatch(q - place(p) + place(similar_[p * std::size_t(candidates_) + std::size_t(k)]));
}

std::vector<PatchLevel::Place> PatchLevel::mostSimilar(const Vec2& q, int count,
                                                       float separation) const {
  const std::uint32_t p = gridPoint(q);
  std::vector<float> distances;
  std::vector<Place> places;
  for (const Found& s : search(p, count, Vec2(separation, separation), distances)) {
    places.push_back({intoPatch(q - place(p) + place(s.point)), s.distance});
  }
  return places;
}

}  // namespace lambent::synthesis
