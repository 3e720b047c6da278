// Lines along which a surface bends sharply, or ends: what a patch that lies on it should respect.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/scene/scene.h"
#include "lambent/synthesis/manifold.h"

namespace lambent::synthesis {

struct FeatureOptions {
  float crease = 40.0f;  ///< degrees that triangles beside an edge bend by, above which it is sharp
  float corner = 50.0f;  ///< degrees that a line may bend by at a vertex: else it ends there
  /// Metres for a surface of 1 m², and in proportion for others: lines that hang together and are
  /// no longer in all are left out. They are the noise of scans and coarse meshes.
  float least = 0.5f;
};

struct FeatureLine {
  struct Step {
    std::uint32_t halfEdge;
    bool reversed;  ///< the line runs from its head to its tail
  };
  std::vector<Step> steps;  ///< from vertex to vertex of the manifold
  double length = 0.0;      ///< metres
};

/// Every sharp or open edge is in one line, but for those that are left out. A line ends at corners
/// and where several meet.
std::vector<FeatureLine> featureLines(const scene::Mesh& mesh, const Manifold& manifold,
                                      const FeatureOptions& options = {});

}  // namespace lambent::synthesis
