// What a bake yields: how every receiver answers to light, before any light is known.
//
// Conventions: world frame, polar axis of the harmonics +z of the world. A diffuse transfer vector
// includes ρ/π: exit radiance = M · L (Sloan 2002 eq. 8). A glossy transfer matrix yields incident
// radiance at the surface, before the lobe (eq. 9, 12).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::transport {

enum class TransferKind { Unshadowed, Shadowed, Interreflected };

/// Where a mesh's receivers stand. Mirrors have none.
enum class Layout { None, Vertices, Texels };

/// Whether the receiver's own albedo is inside the vectors. Meshes with a base-colour texture keep
/// it outside (BaseColor), so that the texture's detail survives a per-vertex bake: exit radiance =
/// base colour(u, v) ⊙ (M · L).
enum class Albedo { Included, BaseColor };

/// Transfer to a surface that carries meso-structure, in the tangent frame of each receiver: the
/// matrices that yield the light which arrives at the structure (Sloan 2003 §3, §4.1). Rows are in
/// the frame (tangent, normal × tangent, normal), columns in the world's.
struct LocalTransfer {
  std::vector<Vec3> tangents;         ///< of the receivers: world space, unit
  int bands = 0;                      ///< of rows and columns
  std::vector<float> shadowed;        ///< [receiver][n²][n²], or empty: nothing hides light
  int channels = 0;                   ///< of `interreflected`: 1 or 3
  std::vector<float> interreflected;  ///< [receiver][channel][n²][n²], or empty
};

/// Transfer of the direct light alone, kept beside the interreflected one of the same mesh
/// (BakeOptions::keepShadowed): with fewer channels where the light's bounces alone have colours.
/// Bands, albedo and lobe are the mesh's.
struct ShadowedTransfer {
  int channels = 0;             ///< of `vectors`: 1 or 3
  std::vector<float> vectors;   ///< [receiver][channel][n²], or empty
  int matrixChannels = 0;       ///< of `matrices`: 1 or 3
  std::vector<float> matrices;  ///< [receiver][channel][outBands²][inBands²], or empty

  bool empty() const { return vectors.empty() && matrices.empty(); }
};

/// The receivers of one mesh and their transfer. Empty vectors or matrices: the material has no
/// diffuse, or no glossy, part.
struct MeshTransfer {
  Layout layout = Layout::None;
  int width = 0, height = 0;  ///< Texels: the grid over TEXCOORD_0, row 0 at v = 0

  std::vector<Vec3> positions, normals;  ///< world space, one per receiver
  std::vector<std::uint8_t> covered;  ///< Texels: 1 where a surface point stands, 0 dilated/empty

  int bands = 0;     ///< n of the light that vectors take
  int channels = 0;  ///< 1 (grey: the same for R, G, B) or 3
  Albedo albedo = Albedo::Included;
  std::vector<float> vectors;  ///< [receiver][channel][n²]

  int outBands = 0, inBands = 0;  ///< of the matrices: outBands² rows, inBands² columns
  int matrixChannels = 0;         ///< 1 (shadowed: the same for R, G, B) or 3
  std::vector<float> matrices;    ///< [receiver][channel][outBands²][inBands²]
  Rgb glossy = Rgb::Zero();       ///< lobe reflectance k, to be applied when shading
  float lobeExponent = 0.0f;      ///< r; free to change in shading unless interreflection is baked

  ShadowedTransfer shadowed;           ///< kept beside vectors and matrices, or empty
  std::optional<LocalTransfer> local;  ///< bi-scale meshes: then neither vectors nor matrices

  std::size_t receiverCount() const { return positions.size(); }
};

struct TransferField {
  TransferKind kind = TransferKind::Shadowed;
  int bands = 5;       ///< of the light that relights it
  int directions = 0;  ///< sampled over the sphere
  int bounces = 0;     ///< simulated beyond the direct light
  std::uint64_t seed = 0;
  std::vector<double> passEnergy;    ///< energy of pass 0 (direct), 1, 2, …: Σ|M|² / receivers
  std::vector<MeshTransfer> meshes;  ///< one for each mesh of the scene
};

}  // namespace lambent::transport
