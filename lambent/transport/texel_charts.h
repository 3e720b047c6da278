// Texel grids and the charts of a mesh's texture coordinates: what is too small for a texel, and
// what lies too close to another chart.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/transport/receivers.h"

namespace lambent::transport {

/// For every vertex the number of its position and texture coordinate: where both are the same, the
/// surface and its layout hang together. `mesh` has UVs.
std::vector<std::uint32_t> cornersOf(const scene::Mesh& mesh);

/// Of every triangle the number of its chart, from 0 on: triangles that share a corner hang
/// together, corners being the same where position and texture coordinate are.
std::vector<std::uint32_t> chartsOf(const scene::Mesh& mesh);

/// A chart between the centres of texels, and the texels around its middle, from which look-ups
/// there interpolate.
struct TinyChart {
  std::uint32_t triangle;             ///< its largest
  std::vector<std::uint32_t> texels;  ///< y·width + x, one to four
};

/// Charts that hold the centre of no texel of a width×height grid. `mesh` has UVs in [0, 1].
std::vector<TinyChart> tinyCharts(const scene::Mesh& mesh, int width, int height);

/// What is wrong with the layouts of meshes on texels: `uvs-tiny-charts`, charts for which there is
/// no texel; `uvs-without-gutter`, charts so close to each other that bilinear look-ups mix them.
Findings chartFindings(const scene::Scene& scene, const PlacedReceivers& receivers);

}  // namespace lambent::transport
