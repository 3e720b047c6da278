#include "lambent/synthesis/whole_pieces.h"

#include <cassert>
#include <cmath>

#include "lambent/math/union_find.h"

namespace lambent::synthesis {
namespace {

constexpr double kWithin = 0.15;

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
  std::vector<double> area(count, 0.0), partArea(count, 0.0), largestPart(count, 0.0);
  std::vector<int> pieceOf(count, PatchPieces::kBetween);
  std::vector<std::uint8_t> cut(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (pieceAt[i] < 0) continue;
    const std::uint32_t root = connected.rootOf(i);
    area[root] += double(texels.areas[i]);
    partArea[unbroken.rootOf(i)] += double(texels.areas[i]);
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
    if (alike(area[root], pieceOf[root]) && alike(largestPart[root], pieceOf[root]))
      asOne += area[root];
  }
  if (!(all > 0.0)) return std::nullopt;
  result.wholeByArea = byArea / all, result.whole = asOne / all;
  return result;
}

}  // namespace lambent::synthesis
