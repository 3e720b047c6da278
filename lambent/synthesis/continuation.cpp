#include "lambent/synthesis/continuation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lambent/math/union_find.h"
#include "lambent/synthesis/similar_places.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

Vec2 rotated(const Vec2& v, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return Vec2(c * v.x() - s * v.y(), s * v.x() + c * v.y());
}

}  // namespace

Continuation continuationOf(const WornTexels& texels, const Vec2& period,
                            std::span<const LookSymmetry> symmetries,
                            const ContinuationOptions& options) {
  const std::size_t count = texels.steps.size();
  const float least = options.tolerance * period.minCoeff();
  Continuation result;
  result.goesOn.assign(count, 0);
  work::parallelRanges(count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b, width] = texels.steps[i];
      const Vec3 d = texels.positions[b] - texels.positions[a];
      const Vec2 fromA = laidAt(texels, a, d), fromB = laidAt(texels, b, d);
      // How b's frame sees what a's frame sees: turned by whole right angles, which are the
      // patch's affair, and a rest, of which each takes half.
      const float angle =
          std::atan2(fromA.x() * fromB.y() - fromA.y() * fromB.x(), fromA.dot(fromB));
      const int quarters = int(std::lround(angle / float(0.5 * kPi)));
      const float rest = angle - float(quarters) * float(0.5 * kPi);
      const Vec2 way = rotated(fromA, 0.5f * rest).cwiseQuotient(period);
      const Vec2 expected = texels.places[a] + way;
      const float allowed = std::max(least, options.strain * d.norm());
      for (const LookSymmetry& symmetry : symmetries) {
        if (symmetry.quarters != ((quarters % 4) + 4) % 4) continue;
        const Vec2 off =
            wrapped(texels.places[b] - turned(expected, symmetry.quarters) - symmetry.shift);
        if (off.cwiseProduct(period).norm() > allowed) continue;
        result.goesOn[i] = 1;
        break;
      }
    }
  });

  double all = 0.0, torn = 0.0;
  math::UnionFind runs(texels.size());
  std::vector<std::uint8_t> atTear(texels.size(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, width] = texels.steps[i];
    all += double(width);
    if (result.goesOn[i]) continue;
    torn += double(width);
    atTear[a] = atTear[b] = 1;
    runs.join(a, b);
  }
  for (const auto& [a, b, width] : texels.steps)
    if (atTear[a] && atTear[b]) runs.join(a, b);
  struct Sum {
    double length = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  };
  std::map<std::uint32_t, Sum> sums;
  const double crofton = 0.25 * kPi;
  for (std::size_t i = 0; i < count; ++i) {
    if (result.goesOn[i]) continue;
    const auto [a, b, width] = texels.steps[i];
    Sum& sum = sums[runs.rootOf(a)];
    sum.length += crofton * double(width);
    sum.moment +=
        crofton * double(width) * 0.5 * (texels.positions[a] + texels.positions[b]).cast<double>();
  }
  for (const auto& [root, sum] : sums)
    if (sum.length > 0.0)
      result.tears.push_back({(sum.moment / sum.length).cast<float>(), float(sum.length)});
  std::stable_sort(result.tears.begin(), result.tears.end(),
                   [](const Tear& x, const Tear& y) { return x.length > y.length; });
  result.share = all > 0.0 ? 1.0 - torn / all : 1.0;
  result.tearLength = crofton * torn;
  return result;
}

}  // namespace lambent::synthesis
