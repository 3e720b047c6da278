// TransferField → what is stored and shaded from: the same shape with numbers of 16 or 32 bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/transport/transfer_field.h"

namespace lambent::encode {

enum class Encoding { Float16, Float32 };

/// A block of numbers in one encoding.
struct Numbers {
  Encoding encoding = Encoding::Float32;
  std::vector<std::uint16_t> half;  ///< IEEE binary16 bits, if Float16
  std::vector<float> single;        ///< if Float32

  std::size_t size() const { return encoding == Encoding::Float16 ? half.size() : single.size(); }
  bool empty() const { return size() == 0; }
};

Numbers encode(std::span<const float> values, Encoding encoding);  ///< round to nearest even
std::vector<float> decode(const Numbers& numbers);

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

  std::size_t receiverCount() const { return positions.size(); }
};

struct EncodedField {
  transport::TransferKind kind = transport::TransferKind::Shadowed;
  int bands = 5, directions = 0, bounces = 0;
  std::uint64_t seed = 0;
  std::vector<double> passEnergy;
  std::vector<EncodedMesh> meshes;
};

EncodedField encode(const transport::TransferField& field, Encoding encoding);
transport::TransferField decode(const EncodedField& field);

}  // namespace lambent::encode
