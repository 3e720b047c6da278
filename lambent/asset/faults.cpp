#include "lambent/asset/faults.h"

#include <algorithm>
#include <cmath>

#include "lambent/asset/format.h"

namespace lambent::asset {

using transfer::Encoding;
using transfer::Numbers;

bool bandsInRange(int bands) {
  return bands >= 1 && bands <= sh::kMaxBands;
}
bool channelsInRange(int channels) {
  return channels == 1 || channels == 3;
}
std::string text(std::uint64_t value) {
  return std::to_string(value);
}

std::optional<std::size_t> firstNonFinite(const Numbers& numbers) {
  const auto first = [](const auto& values, auto isBad) -> std::optional<std::size_t> {
    const auto at = std::find_if(values.begin(), values.end(), isBad);
    if (at == values.end()) return std::nullopt;
    return std::size_t(at - values.begin());
  };
  const auto notFinite = [](float f) { return !std::isfinite(f); };
  switch (numbers.encoding) {
    case Encoding::Float16:
      return first(numbers.half, [](std::uint16_t h) { return (h & 0x7c00u) == 0x7c00u; });
    case Encoding::Snorm8:
      if (const auto scale = first(numbers.scales, notFinite)) return *scale * numbers.block;
      return std::nullopt;
    case Encoding::Float32:
      break;
  }
  return first(numbers.single, notFinite);
}

std::optional<std::size_t> firstNonFinite(std::span<const Vec3> vectors) {
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if (!vectors[i].allFinite()) return i;
  return std::nullopt;
}

Wrong faultOfScales(const Numbers& numbers, const std::string& name) {
  if (numbers.encoding != Encoding::Snorm8 || numbers.empty()) return std::nullopt;
  if (numbers.block > 0 && numbers.size() % numbers.block == 0 &&
      numbers.scales.size() == numbers.size() / numbers.block)
    return std::nullopt;
  return name + ": " + text(numbers.scales.size()) + " scales, each for " + text(numbers.block) +
         " of " + text(numbers.size()) + " numbers, do not add up";
}

Wrong faultOf(const transfer::Vectors<Numbers>& vectors, std::size_t receivers,
              const std::string& name) {
  if (!bandsInRange(vectors.bands))
    return name + ": bands is " + std::to_string(vectors.bands) + ", not 1 to 10";
  if (!channelsInRange(vectors.channels))
    return name + ": channels is " + std::to_string(vectors.channels) + ", not 1 or 3";
  const std::uint64_t coefficients = vectors.perVector();
  const std::uint64_t each = std::uint64_t(vectors.channels) * coefficients;
  if (vectors.numbers.size() != receivers * each)
    return name + ": " + text(vectors.numbers.size()) + " numbers where " + text(receivers) +
           " receivers × " + text(std::uint64_t(vectors.channels)) + " channels × " +
           text(coefficients) + " coefficients need " + text(receivers * each);
  if (auto wrong = faultOfScales(vectors.numbers, name)) return wrong;
  if (const auto at = firstNonFinite(vectors.numbers))
    return name + ": not a finite number at receiver " + text(*at / each) + ", channel " +
           text(*at % each / coefficients) + ", coefficient " + text(*at % coefficients);
  return std::nullopt;
}

Wrong faultOf(const transfer::Matrices<Numbers>& matrices, std::size_t receivers,
              const std::string& name) {
  if (!bandsInRange(matrices.outBands) || !bandsInRange(matrices.inBands))
    return name + ": outBands is " + std::to_string(matrices.outBands) + " and inBands " +
           std::to_string(matrices.inBands) + ", not 1 to 10";
  if (!channelsInRange(matrices.channels))
    return name + ": channels is " + std::to_string(matrices.channels) + ", not 1 or 3";
  const std::uint64_t rows = std::uint64_t(sh::coefficientCount(matrices.outBands)),
                      columns = std::uint64_t(sh::coefficientCount(matrices.inBands));
  const std::uint64_t each = std::uint64_t(matrices.channels) * rows * columns;
  if (matrices.numbers.size() != receivers * each)
    return name + ": " + text(matrices.numbers.size()) + " numbers where " + text(receivers) +
           " receivers × " + text(std::uint64_t(matrices.channels)) + " channels × " + text(rows) +
           " rows × " + text(columns) + " columns need " + text(receivers * each);
  if (auto wrong = faultOfScales(matrices.numbers, name)) return wrong;
  if (const auto at = firstNonFinite(matrices.numbers))
    return name + ": not a finite number at receiver " + text(*at / each) + ", channel " +
           text(*at % each / (rows * columns)) + ", row " + text(*at / columns % rows) +
           ", column " + text(*at % columns);
  return std::nullopt;
}

namespace {

/// Vertex receivers are not stored: they are the primitive's vertices.
Wrong faultAtVertices(const transfer::Receivers& receivers, const scene::Mesh& mesh) {
  if (receivers.positions.size() != mesh.positions.size() ||
      receivers.normals.size() != mesh.normals.size())
    return text(receivers.size()) + " receivers for " + text(mesh.positions.size()) + " vertices";
  for (std::size_t i = 0; i < receivers.size(); ++i)
    if (receivers.positions[i] != mesh.positions[i] ||
        !receivers.normals[i].isApprox(mesh.normals[i], 1e-3f))
      return "receiver " + text(i) + " does not stand at vertex " + text(i);
  return std::nullopt;
}

Wrong faultAtTexels(const transfer::Receivers& receivers, const transfer::AtTexels& grid,
                    const scene::Mesh& mesh) {
  const auto within = [](int side) { return side >= 1 && side <= kLargestGrid; };
  if (!within(grid.width) || !within(grid.height))
    return "grid: " + std::to_string(grid.width) + "×" + std::to_string(grid.height) +
           " texels, not 1 to " + std::to_string(kLargestGrid) + " each way";
  const std::uint64_t texels = std::uint64_t(grid.width) * std::uint64_t(grid.height);
  if (receivers.positions.size() != texels)
    return "grid: " + text(receivers.positions.size()) + " positions for " + text(texels) +
           " texels";
  if (receivers.normals.size() != texels)
    return "grid: " + text(receivers.normals.size()) + " normals for " + text(texels) + " texels";
  if (grid.covered.size() != texels)
    return "grid: " + text(grid.covered.size()) + " coverage flags for " + text(texels) + " texels";
  if (scene::texelUvsOf(mesh).size() != mesh.positions.size())
    return std::string("grid: the primitive has no texture coordinates to look texels up with");
  if (const auto at = firstNonFinite(receivers.positions))
    return "grid: not a finite position at texel " + text(*at);
  if (const auto at = firstNonFinite(receivers.normals))
    return "grid: not a finite normal at texel " + text(*at);
  const auto odd =
      std::find_if(grid.covered.begin(), grid.covered.end(), [](auto c) { return c > 1; });
  if (odd != grid.covered.end())
    return "grid: covered is " + std::to_string(*odd) + ", not 0 or 1, at texel " +
           text(std::uint64_t(odd - grid.covered.begin()));
  return std::nullopt;
}

}  // namespace

Wrong faultOf(const transfer::Receivers& receivers, const scene::Mesh& mesh) {
  if (const transfer::AtTexels* grid = receivers.texels())
    return faultAtTexels(receivers, *grid, mesh);
  return faultAtVertices(receivers, mesh);
}

}  // namespace lambent::asset
