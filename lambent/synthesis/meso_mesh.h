// The dense mesh that texture is synthesised on (sloan2003biscale §4.3, "meso-mesh";
// turk2001texture §4).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/synthesis/tangent_field.h"

namespace lambent::synthesis {

/// Evenly spread vertices over a surface, in nested levels from coarse to fine: level k consists of
/// the vertices 0 … levelEnd[k] − 1, and each level has about four times as many as the one before.
struct MesoMesh {
  std::vector<Vec3> positions, normals, tangents;  ///< unit; tangents at right angles to normals
  std::vector<std::uint32_t> levelEnd;             ///< coarse to fine; back() = positions.size()
  float area = 0.0f;                               ///< of the surface, m²

  /// The vertices next to each vertex of the finest level and of every other, on the surface: not
  /// those of another sheet that comes near. CSR per level.
  struct Level {
    std::vector<std::uint32_t> begin;       ///< levelEnd[k] + 1
    std::vector<std::uint32_t> neighbours;  ///< by rising distance
  };
  std::vector<Level> levels;
  /// Distance between next neighbours in a hexagonal lattice as dense as a level, metres.
  float spacing(std::size_t level) const;
  std::span<const std::uint32_t> neighbours(std::size_t level, std::uint32_t vertex) const {
    const Level& l = levels[level];
    return {l.neighbours.data() + l.begin[vertex], l.begin[vertex + 1] - l.begin[vertex]};
  }
};

struct MesoMeshOptions {
  std::uint32_t vertices = 960000;  ///< about as many
  std::uint32_t coarsest = 256;     ///< levels stop at about as few
  int neighbours = 12;              ///< at most, of each vertex
  std::uint64_t seed = 0;
};

Result<MesoMesh> mesoMesh(const scene::Mesh& mesh, const TangentField& field,
                          const MesoMeshOptions& options, const Progress& progress);

}  // namespace lambent::synthesis
