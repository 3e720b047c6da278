// Meshes cut into pieces whose buffers fit into one shader storage block each (128 MiB with
// software GL).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::render {

/// A run of triangles with the vertices that they use, numbered anew.
struct TriangleBatch {
  std::vector<std::uint32_t> vertices;  ///< the mesh's numbers of the batch's vertices
  std::vector<std::uint32_t> corners;   ///< three for each triangle, indices into `vertices`
};
/// In the mesh's sequence; a batch has at least one triangle, whatever the limits.
std::vector<TriangleBatch> splitTriangles(const scene::Mesh& mesh, std::size_t mostVertices,
                                          std::size_t mostTriangles);

/// Rows of a texel grid. A draw shades the points whose upper texel row is in [begin, end), and
/// needs the texels of rows begin … last.
struct RowBand {
  int begin = 0, end = 0, last = 0;
};
/// Empty if not even two rows have mostTexels or fewer.
std::vector<RowBand> splitRows(int width, int height, std::size_t mostTexels);

}  // namespace lambent::render
