#include "lambent/encode/encoded_field.h"

#include "lambent/encode/half.h"

namespace lambent::encode {

Numbers encode(std::span<const float> values, Encoding encoding) {
  Numbers numbers;
  numbers.encoding = encoding;
  if (encoding == Encoding::Float16) {
    numbers.half.resize(values.size());
    halvesFromFloats(values, numbers.half);
  } else {
    numbers.single.assign(values.begin(), values.end());
  }
  return numbers;
}

std::vector<float> decode(const Numbers& numbers) {
  if (numbers.encoding == Encoding::Float32) return numbers.single;
  std::vector<float> values(numbers.half.size());
  floatsFromHalves(numbers.half, values);
  return values;
}

namespace {

/// The members that both structs share; the numbers themselves are the caller's.
template <class To, class From>
To copyShape(const From& from) {
  To to;
  to.layout = from.layout;
  to.width = from.width;
  to.height = from.height;
  to.positions = from.positions;
  to.normals = from.normals;
  to.covered = from.covered;
  to.bands = from.bands;
  to.channels = from.channels;
  to.albedo = from.albedo;
  to.outBands = from.outBands;
  to.inBands = from.inBands;
  to.matrixChannels = from.matrixChannels;
  to.glossy = from.glossy;
  to.lobeExponent = from.lobeExponent;
  return to;
}

template <class To, class From>
To copyStatement(const From& from) {
  To to;
  to.kind = from.kind;
  to.bands = from.bands;
  to.directions = from.directions;
  to.bounces = from.bounces;
  to.seed = from.seed;
  to.passEnergy = from.passEnergy;
  to.meshes.reserve(from.meshes.size());
  return to;
}

}  // namespace

EncodedField encode(const transport::TransferField& field, Encoding encoding) {
  auto encoded = copyStatement<EncodedField>(field);
  for (const transport::MeshTransfer& mesh : field.meshes) {
    EncodedMesh& out = encoded.meshes.emplace_back(copyShape<EncodedMesh>(mesh));
    out.vectors = encode(mesh.vectors, encoding);
    out.matrices = encode(mesh.matrices, encoding);
  }
  return encoded;
}

transport::TransferField decode(const EncodedField& field) {
  auto decoded = copyStatement<transport::TransferField>(field);
  for (const EncodedMesh& mesh : field.meshes) {
    transport::MeshTransfer& out =
        decoded.meshes.emplace_back(copyShape<transport::MeshTransfer>(mesh));
    out.vectors = decode(mesh.vectors);
    out.matrices = decode(mesh.matrices);
  }
  return decoded;
}

}  // namespace lambent::encode
