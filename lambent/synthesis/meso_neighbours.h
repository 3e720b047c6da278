// Which samples of a surface lie next to each other on the surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/scene/scene.h"
#include "lambent/synthesis/manifold.h"
#include "lambent/synthesis/meso_mesh.h"
#include "lambent/synthesis/surface_samples.h"

namespace lambent::synthesis {

/// Of each sample, at most `wanted` others by rising distance: those of its nearest in space that
/// it can reach over the surface without leaving the ball that holds them, and whose front is
/// turned less than about 100° against its own.
MesoMesh::Level neighboursOf(const scene::Mesh& mesh, const Manifold& manifold,
                             const std::vector<Vec3>& faceNormals,
                             std::span<const SurfaceSample> samples, int wanted);

}  // namespace lambent::synthesis
