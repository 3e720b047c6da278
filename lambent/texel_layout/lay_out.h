// Meshes laid out for receivers on texels: any mesh cut into charts, flattened and packed with
// gutters, with texels where shadows want them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/receivers.h"

namespace lambent::texel_layout {

struct LayoutOptions {
  std::size_t budget = 65536;  ///< texels of all grids together, gutters and all
  /// How far interpolated light may be off, shadows and how normals turn, as macro::placeErrors
  /// counts it: charts get texels until its root mean square over the eighth of their places where
  /// it is largest is below this. None: texels are as dense everywhere.
  std::optional<double> error = 0.01;
  int gutter = 2;  ///< texels between charts, ≥ 2: bilinear look-ups mix none
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: as many as the machine has. No effect on the result
};

/// How a mesh was laid out.
struct MeshLayout {
  std::uint32_t mesh = 0;
  std::uint32_t charts = 0;
  int size = 0;           ///< texels a side of its grid
  double finest = 0.0;    ///< texels a metre, of the densest chart
  double coarsest = 0.0;  ///< … and of the least dense one
};

struct LaidOutScene {
  /// With the layout as texel UVs of the meshes, beside the texture coordinates that they have, or
  /// as these where they have none; vertices are cut where charts meet. All triangles keep their
  /// sequence and place: what was hit by rays is what it was.
  scene::Scene scene;
  std::vector<transport::TexelGrid> grids;
  std::vector<MeshLayout> meshes;
  /// The error that is left, a root mean square, over the meshes that were laid out;
  /// none if it was not asked for.
  std::optional<double> error;
  std::optional<double> worst;  ///< … of the worst chart, as LayoutOptions::error has it
  std::size_t texels = 0;       ///< of all grids
  bool spent = false;           ///< the budget ended it, and not the error
};

/// Lays out `meshes`, each once. Charts end where shading normals or colours do not go on. Each
/// mesh gets a square grid, or two beside each other where it has backs; of each chart the density
/// is chosen by its error: coarse grids first, then, with what they were found to miss, three more
/// rounds in which a given number of texels is spread so that the squared error over all surfaces
/// is least. Findings: `texels-no-room`, meshes with so many charts that the budget has no room for
/// them, which are left as they are. `rays` are the scene's. BadInput for meshes without area;
/// BadUsage for options out of range; Cancelled.
Result<WithFindings<LaidOutScene>> layOut(const scene::Scene& scene,
                                          std::span<const std::uint32_t> meshes,
                                          const trace::RayScene& rays, const LayoutOptions& options,
                                          const Progress& progress);

}  // namespace lambent::texel_layout
