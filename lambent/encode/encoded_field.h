// TransferField → what is stored and shaded from: the same shape with numbers of 8, 16 or 32 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lambent/meso/radiance_transfer_texture.h"
#include "lambent/synthesis/id_map.h"
#include "lambent/transport/transfer_field.h"

namespace lambent::encode {

enum class Encoding { Float16, Float32, Snorm8 };

/// Numbers in one encoding.
struct Numbers {
  Encoding encoding = Encoding::Float32;
  std::vector<std::uint16_t> half;  ///< IEEE binary16 bits, if Float16
  std::vector<float> single;        ///< if Float32
  /// If Snorm8: −127 … 127, and for every run of `block` of them the value that 127 stands for.
  std::vector<std::int8_t> byte;
  std::vector<float> scales;
  std::size_t block = 0;

  std::size_t size() const {
    switch (encoding) {
      case Encoding::Float16:
        return half.size();
      case Encoding::Snorm8:
        return byte.size();
      case Encoding::Float32:
        break;
    }
    return single.size();
  }
  bool empty() const { return size() == 0; }
};

/// Rounds to the nearest. `block`, for Snorm8: how many numbers share a scale, their largest
/// magnitude; it divides the number of values.
Numbers encode(std::span<const float> values, Encoding encoding, std::size_t block = 0);
std::vector<float> decode(const Numbers& numbers);
/// The same of a stretch of them.
void decode(const Numbers& numbers, std::size_t first, std::span<float> values);

/// √(Σ (decoded − value)² / Σ value²): what an encoding costs. Spans of one length.
double encodingError(std::span<const float> values, const Numbers& numbers);

/// meso::RadianceTransferTexture with its numbers encoded; members mean the same.
struct EncodedRtt {
  std::string name;
  int width = 0, height = 0, views = 0, bands = 0;
  Vec2 size = Vec2(1.0f, 1.0f);
  float depth = 0.0f;
  Numbers values;  ///< Snorm8: one scale for each coefficient
};

EncodedRtt encode(const meso::RadianceTransferTexture& rtt, Encoding encoding);
meso::RadianceTransferTexture decode(const EncodedRtt& rtt);

/// What makes a mesh bi-scale: a patch spread over it. Its transfer matrices yield the light that
/// arrives at the meso-structure in the tangent frame (tangent, normal × tangent, normal) of each
/// receiver; exit radiance is B(q, v) · (M L) (Sloan 2003 eq. 4). Receivers are vertices.
struct EncodedBiScale {
  int rtt = 0;                 ///< index into EncodedField::rtts
  std::vector<Vec3> tangents;  ///< world space, unit, at right angles to the normals; per receiver
  /// Where the patch stands: q of a texel of TEXCOORD_0 or, without a map, q = tiles · (u, −v).
  std::optional<synthesis::IdMap> idMap;
  Vec2 tiles = Vec2(1.0f, 1.0f);
  /// Metres of the surface that one metre of the patch covers.
  float scale = 1.0f;
  int bands = 0;           ///< of the matrices, rows and columns alike
  Numbers shadowed;        ///< [receiver][n²][n²], or empty: nothing hides light
  int channels = 0;        ///< of `interreflected`: 1 or 3
  Numbers interreflected;  ///< [receiver][channel][n²][n²], shadows and bounces, or empty
};

/// Matrices and tangents; Snorm8: a scale for each matrix. Which patch, and where it stands, are
/// for the caller to fill in.
EncodedBiScale encode(const transport::LocalTransfer& local, Encoding encoding);

/// transport::ShadowedTransfer with its numbers encoded; members mean the same.
struct EncodedShadowed {
  int channels = 0;
  Numbers vectors;
  int matrixChannels = 0;
  Numbers matrices;

  bool empty() const { return vectors.empty() && matrices.empty(); }
};

/// transport::MeshTransfer with its numbers encoded; members mean the same.
struct EncodedMesh {
  transport::Layout layout = transport::Layout::None;
  int width = 0, height = 0;
  std::vector<Vec3> positions, normals;
  std::vector<std::uint8_t> covered;
  int bands = 0, channels = 0;
  transport::Albedo albedo = transport::Albedo::Included;
  Numbers vectors;
  int outBands = 0, inBands = 0, matrixChannels = 0;
  Numbers matrices;
  Rgb glossy = Rgb::Zero();
  float lobeExponent = 0.0f;
  EncodedShadowed shadowed;               ///< kept beside vectors and matrices, or empty
  std::optional<EncodedBiScale> biScale;  ///< then there are neither vectors nor matrices

  std::size_t receiverCount() const { return positions.size(); }
};

struct EncodedField {
  transport::TransferKind kind = transport::TransferKind::Shadowed;
  int bands = 5, directions = 0, bounces = 0;
  std::uint64_t seed = 0;
  std::vector<double> passEnergy;
  std::vector<EncodedMesh> meshes;
  std::vector<EncodedRtt> rtts;
};

/// Snorm8: vectors have a scale for each channel of a receiver, matrices one for each matrix.
EncodedField encode(const transport::TransferField& field, Encoding encoding);
transport::TransferField decode(const EncodedField& field);

}  // namespace lambent::encode
