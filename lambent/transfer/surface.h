// Transfer to bare surfaces.
//
// Conventions: world frame, polar axis of the harmonics +z of the world. A diffuse transfer vector
// includes ρ/π: exit radiance = M · L (sloan2002precomputed eq. 8). A glossy transfer matrix yields
// incident radiance at the surface, before the lobe (eq. 9, 12).
#pragma once

#include <cstddef>
#include <optional>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"
#include "lambent/transfer/kind.h"
#include "lambent/transfer/receivers.h"

namespace lambent::transfer {

/// N is Floats as simulated, Numbers as stored; so throughout this room.
///
/// [receiver][channel][bands²].
template <class N>
struct Vectors {
  int bands = 0;     ///< of the light, 1 … 10
  int channels = 0;  ///< 1 (the same for R, G, B) or 3
  N numbers;

  std::size_t perVector() const { return std::size_t(sh::coefficientCount(bands)); }
};

/// [receiver][channel][outBands²][inBands²].
template <class N>
struct Matrices {
  int outBands = 0, inBands = 0;  ///< of rows and columns, 1 … 10
  int channels = 0;               ///< 1 (the same for R, G, B) or 3
  N numbers;

  std::size_t perMatrix() const {
    return std::size_t(sh::coefficientCount(outBands)) * std::size_t(sh::coefficientCount(inBands));
  }
};

/// Whether the receiver's own albedo is inside the vectors. Meshes with a base-colour texture keep
/// it outside (BaseColor), so that the texture's detail survives a per-vertex bake: exit radiance =
/// base colour(u, v) ⊙ (M · L).
enum class Albedo { Included, BaseColor };

template <class N>
struct Diffuse {
  Albedo albedo = Albedo::Included;
  Vectors<N> vectors;
};

/// A Phong lobe about the mirrored direction.
struct Lobe {
  Rgb reflectance = Rgb::Zero();  ///< k, to be applied when shading
  float exponent = 0.0f;          ///< r; free to change in shading unless bounces went through it
};

template <class N>
struct Glossy {
  Lobe lobe;
  Matrices<N> matrices;
};

/// How a bare surface answers to light under one kind of transfer: with the parts that its material
/// has, at least one.
template <class N>
struct SurfaceResponse {
  std::optional<Diffuse<N>> diffuse;
  std::optional<Glossy<N>> glossy;
};

/// Every kind that is held has the same parts, albedo and lobe; bands and channels can differ.
template <class N>
struct Surface {
  SharedReceivers receivers;
  ByKind<SurfaceResponse<N>> responses;
};

}  // namespace lambent::transfer
