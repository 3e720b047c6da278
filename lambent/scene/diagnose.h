// What a mesh must be for a bake, asked before hours are spent on it: closed where light must not
// leak, and laid out without overlap where texels are the receivers.
#pragma once

#include <cstddef>

#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene {

/// How the triangles hang together, with vertices of equal position taken as one.
struct Topology {
  std::size_t vertices = 0;           ///< distinct positions in use
  std::size_t edges = 0;              ///< distinct undirected edges
  std::size_t boundaryEdges = 0;      ///< of one triangle: a hole begins there
  std::size_t nonManifoldEdges = 0;   ///< of three triangles or more
  std::size_t inconsistentEdges = 0;  ///< of two triangles that are wound against each other
  double signedVolume = 0.0;          ///< m³; negative: the fronts of a closed mesh point inwards

  bool closed() const { return boundaryEdges == 0 && nonManifoldEdges == 0; }
  bool consistent() const { return inconsistentEdges == 0; }
  /// Closed, consistently wound and inside out: right for a room seen from within, wrong for a
  /// body seen from outside, which will be black.
  bool insideOut() const { return closed() && consistent() && edges > 0 && signedVolume < 0.0; }
};
Topology topology(const Mesh& mesh);

/// Whether every texel of a width×height grid over the mesh's texel UVs (texelUvsOf) belongs to one
/// triangle at most. Triangles that share an edge do not overlap: a texel counts where its centre
/// lies more than 1/64 texel inside two triangles. BadInput if UVs are missing, outside [0, 1],
/// cover no texel (hold no centre by visitTexels of texel_map.h, borders included), or overlap; the
/// message names two triangles, the number of texels and the remedy.
Status checkUvs(const Mesh& mesh, int width, int height);

}  // namespace lambent::scene
