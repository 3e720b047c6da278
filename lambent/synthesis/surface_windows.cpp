#include "lambent/synthesis/surface_windows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "lambent/math/random.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

/// The texels next to each texel.
struct Adjacency {
  std::vector<std::uint32_t> begin, others;

  explicit Adjacency(const WornTexels& texels) : begin(texels.size() + 1, 0) {
    for (const auto& step : texels.steps) ++begin[step.a + 1], ++begin[step.b + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    others.resize(begin.back());
    std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
    for (const auto& step : texels.steps)
      others[at[step.a]++] = step.b, others[at[step.b]++] = step.a;
  }
};

/// Which texels a search has come to, without a sweep before each.
struct Visited {
  std::vector<std::uint32_t> last;
  std::uint32_t search = 0;
  bool first(std::uint32_t texel) { return std::exchange(last[texel], search) != search; }
};

std::optional<SurfaceWindow> windowAbout(const WornTexels& texels, const Adjacency& adjacency,
                                         const Vec2& period, std::uint32_t middle,
                                         const WindowOptions& options, Visited& visited) {
  const int n = options.pixels;
  const float pixel = options.size / float(n), half = 0.5f * options.size;
  SurfaceWindow window{middle, n, std::vector<Vec2>(std::size_t(n) * std::size_t(n), Vec2::Zero()),
                       std::vector<std::uint8_t>(std::size_t(n) * std::size_t(n), 0)};
  std::vector<float> nearest(window.held.size(), std::numeric_limits<float>::infinity());
  ++visited.search;
  visited.first(middle);
  std::vector<std::uint32_t> queue = {middle};
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const std::uint32_t texel = queue[k];
    const Vec2 at = laidAt(texels, middle, texels.positions[texel] - texels.positions[middle]);
    // What lies in the square and a little around it is gone through; each texel says what is at
    // the pixels around it, the nearest one has the word.
    if (at.cwiseAbs().maxCoeff() > half + 2.0f * pixel) continue;
    if (texels.normals[texel].dot(texels.normals[middle]) < options.steepest) continue;
    Vec2 x(texels.along[middle].dot(texels.along[texel]),
           texels.along[middle].dot(texels.across[texel]));
    if (x.norm() > 1e-4f)
      x.normalize();
    else
      x = Vec2::UnitX();
    const Vec2 y(-x.y(), x.x());
    const Vec2 grid = (at + Vec2::Constant(half)) / pixel - Vec2::Constant(0.5f);
    const float texelSize = std::sqrt(texels.areas[texel]) / pixel;
    const int reach = texelSize < 0.4f ? 0 : std::min(int(std::ceil(texelSize)), 8);
    const int cx = int(std::lround(grid.x())), cy = int(std::lround(grid.y()));
    for (int py = std::max(0, cy - reach); py <= std::min(n - 1, cy + reach); ++py)
      for (int px = std::max(0, cx - reach); px <= std::min(n - 1, cx + reach); ++px) {
        const Vec2 off = Vec2(float(px), float(py)) - grid;
        const float away = off.squaredNorm();
        const std::size_t p = std::size_t(py) * std::size_t(n) + std::size_t(px);
        if (away > 2.0f * std::max(1.0f, texelSize * texelSize) || away >= nearest[p]) continue;
        nearest[p] = away, window.held[p] = 1;
        window.places[p] =
            texels.places[texel] + Vec2(pixel * (off.x() * x + off.y() * y)).cwiseQuotient(period);
      }
    for (std::uint32_t e = adjacency.begin[texel]; e < adjacency.begin[texel + 1]; ++e)
      if (visited.first(adjacency.others[e])) queue.push_back(adjacency.others[e]);
  }
  const auto held = std::count(window.held.begin(), window.held.end(), std::uint8_t(1));
  if (float(held) < options.filled * float(window.held.size())) return std::nullopt;
  return window;
}

}  // namespace

std::vector<SurfaceWindow> windowsOn(const WornTexels& texels, const Vec2& period, int count,
                                     const WindowOptions& options, std::uint64_t seed) {
  std::vector<SurfaceWindow> windows;
  if (texels.size() == 0 || count <= 0) return windows;
  std::vector<double> upTo;
  double sum = 0.0;
  for (const float area : texels.areas) upTo.push_back(sum += double(area));
  if (!(sum > 0.0)) return windows;
  const Adjacency adjacency(texels);
  std::vector<std::optional<SurfaceWindow>> batch{std::size_t(count)};
  for (int round = 0; round < 8 && windows.size() < std::size_t(count); ++round) {
    work::parallelRanges(batch.size(), 16, [&](std::size_t begin, std::size_t end) {
      Visited visited{std::vector<std::uint32_t>(texels.size(), 0), 0};
      for (std::size_t k = begin; k < end; ++k) {
        math::Random random(seed, 0x77696e64u + std::uint64_t(round), k);
        const auto at = std::upper_bound(upTo.begin(), upTo.end(), random.uniformDouble() * sum);
        const auto middle = std::min(std::size_t(at - upTo.begin()), texels.size() - 1);
        batch[k] = windowAbout(texels, adjacency, period, std::uint32_t(middle), options, visited);
      }
    });
    for (auto& window : batch)
      if (window && windows.size() < std::size_t(count)) windows.push_back(std::move(*window));
  }
  return windows;
}

}  // namespace lambent::synthesis
