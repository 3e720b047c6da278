// Which receivers stand beside each other on one mesh.
#pragma once

#include <cstdint>

#include "lambent/transport/receivers.h"

namespace lambent::transport {

/// visit(a, b) for pairs of receivers of a mesh that are neighbours: the ends of every edge of its
/// triangles (an edge of two triangles comes twice), or texels side by side, both covered.
template <class Visit>
void visitNeighbours(const scene::Mesh& mesh, const PlacedReceivers::PerMesh& place,
                     const Visit& visit) {
  if (place.layout == Layout::Vertices)
    for (const scene::Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) visit(place.first + t[k], place.first + t[(k + 1) % 3]);
  if (place.layout != Layout::Texels) return;
  const auto texel = [&](int x, int y) { return std::size_t(y) * place.width + x; };
  for (int y = 0; y < place.height; ++y)
    for (int x = 0; x < place.width; ++x) {
      if (!place.covered[texel(x, y)]) continue;
      const std::uint32_t here = place.receiverOfTexel[texel(x, y)];
      if (x + 1 < place.width && place.covered[texel(x + 1, y)])
        visit(here, place.receiverOfTexel[texel(x + 1, y)]);
      if (y + 1 < place.height && place.covered[texel(x, y + 1)])
        visit(here, place.receiverOfTexel[texel(x, y + 1)]);
    }
}

}  // namespace lambent::transport
