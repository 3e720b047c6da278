// Macro-scale radiance transfer (Sloan 2002 §5): Scene → TransferField.
#pragma once

#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/transfer_field.h"

namespace lambent::transport {

/// A mesh whose receivers are to be texels of a width×height grid over its UV set.
struct TexelGrid {
  std::uint32_t mesh = 0;
  int width = 256, height = 256;
};

/// A mesh that carries meso-structure: its receivers are its vertices, and what they record is the
/// light that arrives there, as matrices in their tangent frames (MeshTransfer::local).
struct LocalFrames {
  std::uint32_t mesh = 0;
  std::vector<Vec3> tangents;  ///< one per vertex: world space, unit, at right angles to the normal
};

struct BakeOptions {
  TransferKind kind = TransferKind::Interreflected;
  int bands = 5;          ///< of the light, 1 … 10
  int glossyBands = 0;    ///< rows of glossy matrices, 1 … 10; 0: as bands
  int directions = 8192;  ///< over the whole sphere; half of them face any receiver
  int bounces = 2;        ///< at most, for Interreflected
  double energyThreshold =
      0.0;                 ///< stop when a pass has less than this fraction of pass 0's energy
  std::uint64_t seed = 0;  ///< turns the direction set; two seeds give independent errors
  int threads = 0;         ///< 0: as many as the machine has. No effect on the result's bytes
  /// Bytes for remembered hits; what does not fit is cast again in every bounce.
  std::size_t hitMemory = std::size_t(3) << 30;
  std::vector<TexelGrid> texels;     ///< meshes not named here are baked at their vertices
  std::vector<LocalFrames> biScale;  ///< meshes whose transfer is local
  /// For Interreflected: keep the shadowed vectors and matrices beside, to switch between them.
  /// They cost memory and a larger asset, and no time.
  bool keepShadowed = false;
};

/// `findings` gathers what was odd: receivers inside a mesh, rays that met back faces.
Result<TransferField> bake(const scene::Scene& scene, const trace::RayScene& rays,
                           const BakeOptions& options, const Progress& progress,
                           Findings& findings);

}  // namespace lambent::transport
