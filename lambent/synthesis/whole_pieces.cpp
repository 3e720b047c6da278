#include "lambent/synthesis/whole_pieces.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "lambent/math/union_find.h"

namespace lambent::synthesis {
namespace {

constexpr double kWithin = 0.15;

/// What each texel shows of the patch, m² of a patch that lies as it is: as places around it change.
std::vector<double> patchAreas(const WornTexels& texels, const Vec2& period,
                               const Continuation& continuation) {
  constexpr float kMost = 4.0f;  // times as fast as a patch that lies as it is
  struct Slope {
    Eigen::Matrix2f ways = Eigen::Matrix2f::Zero(), places = Eigen::Matrix2f::Zero();
  };
  std::vector<Slope> slopes(texels.size());
  for (std::size_t i = 0; i < texels.steps.size(); ++i) {
    if (!continuation.goesOn[i]) continue;
    const auto& [a, b, width] = texels.steps[i];
    Vec2 place = texels.places[b] - texels.places[a];
    for (int k = 0; k < 2; ++k) place[k] = (place[k] - std::round(place[k])) * period[k];
    const Vec3 d = texels.positions[b] - texels.positions[a];
    if (place.norm() > kMost * d.norm()) continue;  // goes on as another of its like
    for (const std::uint32_t at : {a, b}) {
      const Vec2 way = laidAt(texels, at, d);
      slopes[at].ways += way * way.transpose();
      slopes[at].places += place * way.transpose();
    }
  }
  std::vector<double> areas(texels.areas.begin(), texels.areas.end());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const float ways = slopes[i].ways.determinant();
    const float across = slopes[i].ways.trace();
    if (ways > 1e-3f * across * across)
      areas[i] *= std::abs(double(slopes[i].places.determinant()) / double(ways));
  }
  return areas;
}

}  // namespace

std::optional<WholePieces> wholePieces(const WornTexels& texels, const Vec2& period,
                                       const Continuation& continuation,
                                       const PatchPieces& pieces) {
  assert(continuation.goesOn.size() == texels.steps.size());
  if (pieces.areas.empty()) return std::nullopt;
  const std::size_t count = texels.size();
  std::vector<int> pieceAt(count);
  for (std::size_t i = 0; i < count; ++i) pieceAt[i] = pieces.at(texels.places[i]);
  // What is connected to the eye, and within it what goes on as the patch does.
  math::UnionFind connected(count), unbroken(count);
  for (std::size_t i = 0; i < texels.steps.size(); ++i) {
    const auto& [a, b, width] = texels.steps[i];
    if (pieceAt[a] < 0 || pieceAt[b] < 0) continue;
    connected.join(a, b);
    if (continuation.goesOn[i]) unbroken.join(a, b);
  }
  const std::vector<double> shown = patchAreas(texels, period, continuation);
  std::vector<double> area(count, 0.0);  // on the surface; the others in the patch
  std::vector<double> pieceArea(count, 0.0), partArea(count, 0.0), largestPart(count, 0.0);
  std::vector<int> pieceOf(count, PatchPieces::kBetween);
  std::vector<std::uint8_t> cut(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (pieceAt[i] < 0) continue;
    const std::uint32_t root = connected.rootOf(i);
    area[root] += double(texels.areas[i]);
    pieceArea[root] += shown[i];
    partArea[unbroken.rootOf(i)] += shown[i];
    cut[root] |= texels.atEnd[i];
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (pieceAt[i] < 0 || !(partArea[i] > 0.0)) continue;  // a part's first texel stands for it
    const std::uint32_t root = connected.rootOf(i);
    if (partArea[i] > largestPart[root])
      largestPart[root] = partArea[i], pieceOf[root] = pieceAt[i];
  }
  const double whole = double(period.x()) * double(period.y());
  const auto alike = [&](double a, int piece) {
    return std::abs(a / (whole * pieces.areas[std::size_t(piece)]) - 1.0) <= kWithin;
  };
  WholePieces result;
  double all = 0.0, byArea = 0.0, asOne = 0.0;
  for (std::uint32_t root = 0; root < count; ++root) {
    if (!(area[root] > 0.0) || cut[root]) continue;
    ++result.count;
    all += area[root];
    for (int piece = 0; piece < int(pieces.areas.size()); ++piece)
      if (alike(area[root], piece)) {
        byArea += area[root];
        break;
      }
    if (alike(pieceArea[root], pieceOf[root]) && alike(largestPart[root], pieceOf[root]))
      asOne += area[root];
  }
  if (!(all > 0.0)) return std::nullopt;
  result.wholeByArea = byArea / all, result.whole = asOne / all;
  return result;
}

}  // namespace lambent::synthesis
