#include "lambent/render/batches.h"

#include <algorithm>

namespace lambent::render {

std::vector<TriangleBatch> splitTriangles(const scene::Mesh& mesh, std::size_t mostVertices,
                                          std::size_t mostTriangles) {
  constexpr std::uint32_t kNone = ~std::uint32_t(0);
  std::vector<TriangleBatch> batches;
  std::vector<std::uint32_t> local(mesh.positions.size(), kNone);
  for (const scene::Triangle& triangle : mesh.triangles) {
    const auto fits = [&](const TriangleBatch& batch) {
      std::size_t added = 0;
      for (int k = 0; k < 3; ++k) added += local[triangle[k]] == kNone;
      return batch.vertices.size() + added <= mostVertices &&
             batch.corners.size() / 3 < mostTriangles;
    };
    if (batches.empty() || !fits(batches.back())) {
      if (!batches.empty())
        for (const std::uint32_t vertex : batches.back().vertices) local[vertex] = kNone;
      batches.emplace_back();
    }
    TriangleBatch& batch = batches.back();
    for (const std::uint32_t vertex : triangle) {
      if (local[vertex] == kNone) {
        local[vertex] = std::uint32_t(batch.vertices.size());
        batch.vertices.push_back(vertex);
      }
      batch.corners.push_back(local[vertex]);
    }
  }
  return batches;
}

std::vector<RowBand> splitRows(int width, int height, std::size_t mostTexels) {
  std::vector<RowBand> bands;
  const std::size_t rows = mostTexels / std::size_t(width);
  if (rows >= std::size_t(height)) return {{0, height, height - 1}};
  if (rows < 2) return {};
  for (int begin = 0; begin < height;) {
    const int end = std::min<int>(height, begin + int(rows) - 1);
    bands.push_back({begin, end, std::min(end, height - 1)});
    begin = end;
  }
  return bands;
}

}  // namespace lambent::render
