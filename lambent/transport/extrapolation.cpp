#include "lambent/transport/extrapolation.h"

#include <algorithm>

namespace lambent::transport {

namespace {

/// λ. A wanted receiver that weighs a third at three places has a sum of squares of a third itself:
/// it is left to them, and one that weighs a tenth is not.
constexpr double kTowardsMean = 0.02;

}  // namespace

Extrapolation::Extrapolation(std::span<const std::uint8_t> wanted, std::vector<Interpolated> places,
                             std::vector<Mean> means)
    : means_(std::move(means)) {
  std::vector<std::uint32_t> unknowns;
  for (const Interpolated& place : places)
    for (const auto& [receiver, weight] : place.weights)
      if (wanted[receiver]) unknowns.push_back(receiver);
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  const auto numberOf = [&](std::uint32_t receiver) {
    const auto at = std::lower_bound(unknowns.begin(), unknowns.end(), receiver);
    return static_cast<std::uint32_t>(at - unknowns.begin());
  };
  std::vector<double> sums(unknowns.size(), 0.0);  // Σ_s w of each unknown
  for (const Interpolated& place : places)
    for (const auto& [receiver, weight] : place.weights)
      if (wanted[receiver]) sums[numberOf(receiver)] += weight;

  std::vector<RowSystem::Entry> normal;
  std::vector<RowSystem::Term> terms;
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    normal.emplace_back(static_cast<int>(k), static_cast<int>(k), kTowardsMean);
  for (const Interpolated& place : places)
    for (const auto& [b, wb] : place.weights) {
      if (!wanted[b]) continue;
      const std::uint32_t row = numberOf(b);
      terms.push_back(
          {row, place.witness, wb + (sums[row] > 0.0 ? kTowardsMean * wb / sums[row] : 0.0)});
      for (const auto& [k, wk] : place.weights) {
        if (wanted[k])
          normal.emplace_back(static_cast<int>(row), static_cast<int>(numberOf(k)),
                              double(wb) * wk);
        else
          terms.push_back({row, k, -double(wb) * wk});
      }
    }
  system_ = RowSystem(std::move(unknowns), normal, std::move(terms));
}

void Extrapolation::fill(RowsToFill rows, std::span<const std::uint32_t> rowOf) const {
  system_.solve(rows, rowOf);
  for (const Mean& mean : means_) {
    float* row = rowAt(rows, rowOf, mean.receiver);
    if (row == nullptr) continue;
    std::fill_n(row, rows.stride, 0.0f);
    for (const std::uint32_t receiver : mean.of) {
      const float* other = rowAt(rows, rowOf, receiver);
      for (std::size_t j = 0; j < rows.stride; ++j)
        row[j] += other[j] / static_cast<float>(mean.of.size());
    }
  }
}

}  // namespace lambent::transport
