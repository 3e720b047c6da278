// This work is based on:
// - linde1980vector: vector quantisation by splitting (its §III, "Initial guess by splitting") and
//   Lloyd's iteration.
// - sloan2002precomputed: §6.1, where the same iteration goes by the name of "iterated closest
//   point".
//
// Where we deviate: one cell is split at a time, the one with the largest distortion, along its
// longest axis, so that any number of points can be had and none is spent where few are needed.
#include "lambent/capture/sample_points.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace lambent::capture {
namespace {

constexpr int kGrid = 64;            ///< pieces along the longest side of the surface's box
constexpr int kSettling = 6;         ///< steps of Lloyd's between two splits
constexpr int kMostSteps = 200;      ///< at the full number of points
constexpr double kLeastGain = 1e-5;  ///< of the distortion, for another step

/// A piece of surface: its area, the centroid, and the second moment about it (metres⁴), which no
/// choice of points can do away with.
struct Piece {
  double area = 0;
  Vec3d center = Vec3d::Zero();
  double inertia = 0;

  void add(double otherArea, const Vec3d& otherCenter, double otherInertia) {
    const double sum = area + otherArea;
    if (!(sum > 0)) return;
    inertia += otherInertia + area * otherArea / sum * (otherCenter - center).squaredNorm();
    center += otherArea / sum * (otherCenter - center);
    area = sum;
  }
};

/// The surface in pieces no longer than a cell of a grid, one piece a cell: as many as the surface
/// is large, however it is tessellated.
class Pieces {
 public:
  explicit Pieces(const scene::Box& box)
      : origin_(box.lower.cast<double>()),
        cell_(std::max(double((box.upper - box.lower).maxCoeff()) / kGrid, 1e-30)) {}

  void add(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    const double longest = std::max({ab, bc, ca});
    if (longest > cell_ * cell_) {
      if (longest == ab) return split(c, a, b);
      if (longest == bc) return split(a, b, c);
      return split(b, c, a);
    }
    const Vec3d center = (a + b + c) / 3;
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const Eigen::Vector3i at = ((center - origin_) / cell_).array().floor().cast<int>();
    const int key = (at.x() * (kGrid + 2) + at.y()) * (kGrid + 2) + at.z();
    const auto [entry, isNew] = places_.try_emplace(key, pieces_.size());
    if (isNew) pieces_.emplace_back();
    // ∫ |x − center|² over a triangle is area · (sum of its sides' squares) / 36.
    pieces_[entry->second].add(area, center, area * (ab + bc + ca) / 36);
  }
  std::vector<Piece> take() {
    std::erase_if(pieces_, [](const Piece& piece) { return !(piece.area > 0); });
    return std::move(pieces_);
  }

 private:
  void split(const Vec3d& apex, const Vec3d& from, const Vec3d& to) {
    const Vec3d middle = 0.5 * (from + to);
    add(apex, from, middle);
    add(apex, middle, to);
  }
  Vec3d origin_;
  double cell_;
  std::unordered_map<int, std::size_t> places_;
  std::vector<Piece> pieces_;
};

std::vector<Piece> piecesOf(const scene::Scene& surface) {
  Pieces pieces(scene::bounds(surface));
  for (const scene::Mesh& mesh : surface.meshes)
    for (const scene::Triangle& t : mesh.triangles)
      pieces.add(mesh.positions[t[0]].cast<double>(), mesh.positions[t[1]].cast<double>(),
                 mesh.positions[t[2]].cast<double>());
  return pieces.take();
}

class Quantiser {
 public:
  explicit Quantiser(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
    Piece whole;
    for (const Piece& piece : pieces_) whole.add(piece.area, piece.center, piece.inertia);
    area_ = whole.area;
    inertia_ = 0;
    for (const Piece& piece : pieces_) inertia_ += piece.inertia;
    points_ = {whole.center};
    owner_.assign(pieces_.size(), 0);
    assign();
  }

  /// Every piece to its nearest point; returns the distortion.
  double assign() {
    spread_.assign(points_.size(), 0);
    double sum = inertia_;
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < points_.size(); ++k) {
        const double distance = (pieces_[p].center - points_[k]).squaredNorm();
        if (distance < nearest) nearest = distance, owner_[p] = k;
      }
      spread_[owner_[p]] += pieces_[p].area * nearest;
      sum += pieces_[p].area * nearest;
    }
    return sum / area_;
  }

  /// Every point to the centroid of its pieces; one without pieces to the piece that is farthest
  /// from its point in the cell that is worst served.
  void center() {
    std::vector<Piece> cells(points_.size());
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      cells[owner_[p]].add(pieces_[p].area, pieces_[p].center, 0);
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (cells[k].area > 0) points_[k] = cells[k].center;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (cells[k].area > 0) continue;
      const std::size_t worst = worstServed(), far = farthestIn(worst);
      points_[k] = pieces_[far].center;
      owner_[far] = k;
      spread_[worst] = 0;  // another empty cell looks elsewhere
    }
  }

  /// Two points for the one whose cell is worst served; false if every piece has its own point.
  bool split() {
    const std::size_t worst = worstServed();
    if (!(spread_[worst] > 0)) return false;
    Mat3d moments = Mat3d::Zero();
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if (owner_[p] != worst) continue;
      const Vec3d off = pieces_[p].center - points_[worst];
      moments += pieces_[p].area * off * off.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Mat3d> axes(moments);
    Vec3d step = axes.eigenvectors().col(2) *
                 std::sqrt(axes.eigenvalues()[2] / std::max(areaOf(worst), 1e-300));
    // An eigenvector has no sign of its own.
    Eigen::Index largest = 0;
    step.cwiseAbs().maxCoeff(&largest);
    if (step[largest] < 0) step = -step;
    const Vec3d middle = points_[worst];
    points_[worst] = middle - step;
    points_.push_back(middle + step);
    return true;
  }

  const std::vector<Vec3d>& points() const { return points_; }

 private:
  std::size_t worstServed() const {
    return std::size_t(std::max_element(spread_.begin(), spread_.end()) - spread_.begin());
  }
  std::size_t farthestIn(std::size_t cell) const {
    std::size_t far = 0;
    double most = -1;
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const double distance = (pieces_[p].center - points_[cell]).squaredNorm();
      if (owner_[p] == cell && distance > most) most = distance, far = p;
    }
    return far;
  }
  double areaOf(std::size_t cell) const {
    double sum = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      if (owner_[p] == cell) sum += pieces_[p].area;
    return sum;
  }

  std::vector<Piece> pieces_;
  double area_ = 0, inertia_ = 0;
  std::vector<Vec3d> points_;
  std::vector<std::size_t> owner_;  ///< point of each piece
  std::vector<double> spread_;      ///< of each point: Σ area · squared distance
};

}  // namespace

SamplePoints samplePoints(const scene::Scene& surface, int count) {
  assert(count >= 1 && count <= 65535);
  std::vector<Piece> pieces = piecesOf(surface);
  assert(!pieces.empty());
  Quantiser quantiser(std::move(pieces));
  while (int(quantiser.points().size()) < count) {
    if (!quantiser.split()) break;
    for (int step = 0; step < kSettling; ++step) {
      quantiser.assign();
      quantiser.center();
    }
    quantiser.assign();
  }
  SamplePoints result;
  result.distortions = {quantiser.assign()};
  for (int step = 0; step < kMostSteps && quantiser.points().size() > 1; ++step) {
    quantiser.center();
    const double before = result.distortions.back(), after = quantiser.assign();
    result.distortions.push_back(after);
    if (before - after <= kLeastGain * before) break;
  }
  for (const Vec3d& point : quantiser.points()) result.points.push_back(point.cast<float>());
  return result;
}

}  // namespace lambent::capture
