#include "lambent/synthesis/result_quality.h"

#include <algorithm>
#include <cmath>

#include "lambent/synthesis/patch_look.h"
#include "lambent/synthesis/surface_windows.h"
#include "lambent/synthesis/texture_statistics.h"
#include "lambent/synthesis/whole_pieces.h"

namespace lambent::synthesis {
namespace {

constexpr int kWindows = 96, kWideWindows = 32;
constexpr int kWidePixels = 24;  ///< of a wide window, along a period

/// Every few texels of a map, the one in the middle of its square or next to it.
transfer::IdMap coarser(const transfer::IdMap& map, int factor) {
  transfer::IdMap out;
  out.width = map.width / factor, out.height = map.height / factor;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const std::size_t from = 2 * (std::size_t(y * factor + factor / 2) * std::size_t(map.width) +
                                    std::size_t(x * factor + factor / 2));
      out.ids.insert(out.ids.end(), {map.ids[from], map.ids[from + 1]});
    }
  return out;
}

/// How many texels make one that is still finer than a wide window's pixels.
int factorOf(const Worn& worn, const WornTexels& texels, double area) {
  const double texel = std::sqrt(area / double(std::max<std::size_t>(texels.size(), 1)));
  const int most = std::min(worn.map.width, worn.map.height) / 64;
  return std::clamp(int(double(worn.period.minCoeff()) / kWidePixels / texel), 1,
                    std::max(1, std::min(most, 8)));
}

}  // namespace

ResultQuality resultQualityOf(const Worn& worn, const transfer::Rtt<transfer::Floats>& rtt) {
  const WornTexels texels = texelsOf(worn);
  const PatchLook look = lookOf(rtt);
  const Vec2& period = worn.period;
  const bool square = std::abs(period.x() / period.y() - 1.0f) < 1e-3f;
  Continuation continuation = continuationOf(texels, period, symmetriesOf(look, square));

  ResultQuality quality;
  quality.continued = continuation.share;
  double area = 0.0;
  for (const float a : texels.areas) area += double(a);
  if (area > 0.0)
    quality.tearLength =
        continuation.tearLength * std::sqrt(double(period.x()) * double(period.y())) / area;
  if (const auto pieces = wholePieces(texels, period, continuation, piecesOf(look))) {
    quality.wholeByArea = pieces->wholeByArea;
    quality.whole = pieces->whole;
  }
  quality.tears = std::move(continuation.tears);

  WindowOptions options;
  options.size = 0.5f * period.maxCoeff();
  options.pixels = 48;
  if (const auto windows = windowsOn(texels, period, kWindows, options); !windows.empty()) {
    const Unlikeness unlikeness = unlikenessOf(windows, options.size, period, look);
    quality.unlikeness = unlikeness.statistics, quality.misfit = unlikeness.misfit;
  }
  options.size = 3.0f * period.maxCoeff();
  options.pixels = 3 * kWidePixels, options.filled = 0.6f, options.steepest = 0.3f;
  const transfer::IdMap map = coarser(worn.map, factorOf(worn, texels, area));
  const WornTexels wide = texelsOf({worn.mesh, worn.tangents, map, period});
  if (const auto windows = windowsOn(wide, period, kWideWindows, options); !windows.empty())
    quality.repetition = repetitionOf(windows, options.size, period, look);
  return quality;
}

}  // namespace lambent::synthesis
