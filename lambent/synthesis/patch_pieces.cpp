// This work is based on:
// - otsu1979threshold: the threshold between two classes that leaves least variance within them.
#include "lambent/synthesis/patch_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lambent/synthesis/whole_pieces.h"

namespace lambent::synthesis {
namespace {

constexpr int kFiner = 4;  ///< samples along a position of the patch
constexpr int kNeck = 4;   ///< half the width of a neck at which pieces part, in samples
constexpr double kSpeck = 0.05;
constexpr double kToldApart = 0.97;  ///< whole, of the patch laid flat
constexpr double kMostOfIt = 0.25;   ///< of the patch, that pieces cover at least

/// The colour around which most places lie: the densest cell of a coarse grid of colours, and the
/// mean of what lies near it.
Rgb mostFrequent(const std::vector<Rgb>& colors) {
  constexpr float kCell = 0.08f;
  std::map<std::array<int, 3>, int> cells;
  const auto cellOf = [](const Rgb& c) {
    return std::array<int, 3>{int(std::floor(c[0] / kCell)), int(std::floor(c[1] / kCell)),
                              int(std::floor(c[2] / kCell))};
  };
  for (const Rgb& c : colors) ++cells[cellOf(c)];
  std::array<int, 3> densest{};
  int most = -1;
  for (const auto& [cell, count] : cells) {  // with its neighbours: no border of cells decides
    int sum = 0;
    for (int k = 0; k < 27; ++k) {
      const auto at =
          cells.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      if (at != cells.end()) sum += at->second * (k == 13 ? 2 : 1);
    }
    if (sum > most) most = sum, densest = cell;
  }
  Rgb sum = Rgb::Zero();
  float count = 0.0f;
  for (const Rgb& c : colors)
    if (cellOf(c) == densest) sum += c, count += 1.0f;
  return sum / count;
}

double otsuThreshold(const std::vector<float>& values) {
  constexpr int kBins = 256;
  const float most = *std::max_element(values.begin(), values.end());
  if (!(most > 0.0f)) return 0.0;
  std::array<double, kBins> counts{};
  for (const float v : values) counts[std::size_t(std::min(kBins - 1, int(v / most * kBins)))] += 1;
  double all = double(values.size()), moment = 0.0, below = 0.0, momentBelow = 0.0;
  for (int k = 0; k < kBins; ++k) moment += k * counts[std::size_t(k)];
  double best = -1.0;
  int first = 0, last = 0;  // of several as good, the middle
  for (int k = 0; k + 1 < kBins; ++k) {
    below += counts[std::size_t(k)], momentBelow += k * counts[std::size_t(k)];
    const double above = all - below;
    if (below == 0.0 || above == 0.0) continue;
    const double apart = momentBelow / below - (moment - momentBelow) / above;
    const double between = below * above * apart * apart;
    if (between > best) best = between, first = k;
    if (between >= best) last = k;
  }
  return (0.5 * (first + last) + 1.0) / kBins * double(most);
}

/// visit(sample) for those within `reach` samples of (x, y), over the borders of the period.
template <class Visit>
void around(int x, int y, int reach, int width, int height, const Visit& visit) {
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      if (dx * dx + dy * dy > reach * reach) continue;
      const int px = (x + dx + width) % width, py = (y + dy + height) % height;
      visit(std::size_t(py) * std::size_t(width) + std::size_t(px));
    }
}

/// What is left of a class without its rim.
std::vector<std::uint8_t> withoutRim(const std::vector<std::uint8_t>& isIn, int width, int height) {
  std::vector<std::uint8_t> left = isIn;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t& here = left[std::size_t(y) * std::size_t(width) + std::size_t(x)];
      if (here) around(x, y, kNeck, width, height, [&](std::size_t at) { here &= isIn[at]; });
    }
  return left;
}

/// Gives pieces their rims back, where they do not come near another.
void growRims(const std::vector<std::uint8_t>& isIn, PatchPieces& pieces) {
  const std::vector<int> cores = pieces.pieceAt;
  const double sample = 1.0 / double(cores.size());
  pieces.areas.assign(pieces.areas.size(), 0.0);
  for (int y = 0; y < pieces.height; ++y)
    for (int x = 0; x < pieces.width; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(pieces.width) + std::size_t(x);
      int& here = pieces.pieceAt[i];
      bool alone = true;
      // Rims of two do not come nearer than five samples: no texel of a map leaps over that.
      around(x, y, 2 * kNeck, pieces.width, pieces.height, [&](std::size_t at) {
        if (cores[at] == PatchPieces::kBetween) return;
        alone &= here == PatchPieces::kBetween || here == cores[at];
        here = cores[at];
      });
      bool near = cores[i] >= 0;
      around(x, y, kNeck, pieces.width, pieces.height,
             [&](std::size_t at) { near |= cores[at] != PatchPieces::kBetween; });
      if (!alone || !near || !isIn[i]) here = PatchPieces::kBetween;
      if (here >= 0) pieces.areas[std::size_t(here)] += sample;
    }
}

/// The connected parts of a class that end, numbered.
PatchPieces endingParts(const std::vector<std::uint8_t>& isIn, int width, int height) {
  PatchPieces pieces{width, height, std::vector<int>(isIn.size(), PatchPieces::kBetween), {}};
  struct Visit {
    int x, y;  // not wrapped
  };
  std::vector<Visit> at(isIn.size());
  std::vector<std::uint8_t> visited(isIn.size(), 0);
  std::vector<std::vector<std::size_t>> parts;
  for (int y0 = 0; y0 < height; ++y0)
    for (int x0 = 0; x0 < width; ++x0) {
      const std::size_t start = std::size_t(y0) * std::size_t(width) + std::size_t(x0);
      if (!isIn[start] || visited[start]) continue;
      std::vector<std::size_t> part = {start};
      visited[start] = 1, at[start] = {x0, y0};
      bool ends = true;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const Visit here = at[part[k]];
        for (const auto& [dx, dy] : {Visit{1, 0}, Visit{-1, 0}, Visit{0, 1}, Visit{0, -1}}) {
          const int x = here.x + dx, y = here.y + dy;
          const std::size_t next =
              std::size_t((y % height + height) % height) * std::size_t(width) +
              std::size_t((x % width + width) % width);
          if (!isIn[next]) continue;
          if (visited[next]) {
            ends &= at[next].x == x && at[next].y == y;  // else it has come round the period
            continue;
          }
          visited[next] = 1, at[next] = {x, y};
          part.push_back(next);
        }
      }
      if (ends) parts.push_back(std::move(part));
    }
  std::size_t largest = 0;
  for (const auto& part : parts) largest = std::max(largest, part.size());
  for (const auto& part : parts) {
    if (double(part.size()) < kSpeck * double(largest)) continue;
    for (const std::size_t i : part) pieces.pieceAt[i] = int(pieces.areas.size());
    pieces.areas.push_back(double(part.size()) / double(isIn.size()));
  }
  return pieces;
}

/// What is measured of the patch laid flat, a unit a period, on texels askew to it.
double wholeLaidFlat(const PatchPieces& pieces) {
  constexpr int kSide = 288;
  constexpr float kTexel = 1.0f / 96.0f;
  const Vec2 x = kTexel * Vec2(std::cos(0.4f), std::sin(0.4f)), y(-x.y(), x.x());
  WornTexels texels;
  for (std::uint32_t v = 0; v < kSide; ++v)
    for (std::uint32_t u = 0; u < kSide; ++u) {
      const std::uint32_t i = v * kSide + u;
      texels.positions.push_back(Vec3::Zero());  // of no matter to pieces
      texels.places.push_back(float(u) * x + float(v) * y);
      texels.areas.push_back(kTexel * kTexel);
      texels.atEnd.push_back(u == 0 || v == 0 || u + 1 == kSide || v + 1 == kSide);
      if (u + 1 < kSide) texels.steps.push_back({i, i + 1, kTexel});
      if (v + 1 < kSide) texels.steps.push_back({i, i + kSide, kTexel});
    }
  Continuation unbroken;
  unbroken.goesOn.assign(texels.steps.size(), 1);
  const auto whole = wholePieces(texels, Vec2::Ones(), unbroken, pieces);
  return whole ? whole->whole : 0.0;
}

}  // namespace

int PatchPieces::at(const Vec2& q) const {
  const auto wrap = [](float t, int count) {
    return std::min(int((t - std::floor(t)) * float(count)), count - 1);
  };
  return pieceAt[std::size_t(wrap(q.y(), height)) * std::size_t(width) +
                 std::size_t(wrap(q.x(), width))];
}

double PatchPieces::covered() const {
  double sum = 0.0;
  for (const double area : areas) sum += area;
  return sum;
}

bool PatchPieces::leaveRoom() const {
  constexpr double kMost = 0.55;
  return !areas.empty() && covered() < kMost;
}

PatchPieces piecesOf(const PatchLook& look) {
  const int width = kFiner * look.width, height = kFiner * look.height;
  std::vector<Rgb> colors;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      colors.push_back(perceived(
          look.colorAt(Vec2((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height)))));
  const Rgb mode = mostFrequent(colors);
  std::vector<float> away;
  for (const Rgb& c : colors) away.push_back((c - mode).matrix().norm());
  const double threshold = otsuThreshold(away);
  std::array<PatchPieces, 2> classes;
  for (int k = 0; k < 2; ++k) {
    std::vector<std::uint8_t> isIn;
    for (const float a : away) isIn.push_back((double(a) > threshold) == (k == 0));
    classes[std::size_t(k)] = endingParts(withoutRim(isIn, width, height), width, height);
    growRims(isIn, classes[std::size_t(k)]);
  }
  PatchPieces& more = classes[0].covered() >= classes[1].covered() ? classes[0] : classes[1];
  if (more.covered() >= kMostOfIt && wholeLaidFlat(more) >= kToldApart) return std::move(more);
  return {width, height, std::vector<int>(away.size(), PatchPieces::kBetween), {}};
}

}  // namespace lambent::synthesis
