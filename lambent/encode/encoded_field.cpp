#include "lambent/encode/encoded_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/encode/half.h"

namespace lambent::encode {

namespace {
constexpr float kSnorm8One = 127.0f;  ///< as OpenGL's signed normalised bytes
}

Numbers encode(std::span<const float> values, Encoding encoding, std::size_t block) {
  Numbers numbers;
  numbers.encoding = encoding;
  switch (encoding) {
    case Encoding::Float16:
      numbers.half.resize(values.size());
      halvesFromFloats(values, numbers.half);
      break;
    case Encoding::Float32:
      numbers.single.assign(values.begin(), values.end());
      break;
    case Encoding::Snorm8:
      if (values.empty()) break;
      assert(block > 0 && values.size() % block == 0);
      numbers.block = block;
      numbers.byte.resize(values.size());
      numbers.scales.resize(values.size() / block);
      for (std::size_t b = 0; b < numbers.scales.size(); ++b) {
        const std::span<const float> run = values.subspan(b * block, block);
        float largest = 0.0f;
        for (const float value : run) largest = std::max(largest, std::abs(value));
        numbers.scales[b] = largest;
        const float perUnit = largest > 0.0f ? kSnorm8One / largest : 0.0f;
        for (std::size_t i = 0; i < block; ++i)
          numbers.byte[b * block + i] = static_cast<std::int8_t>(std::lround(run[i] * perUnit));
      }
      break;
  }
  return numbers;
}

void decode(const Numbers& numbers, std::size_t first, std::span<float> values) {
  assert(first + values.size() <= numbers.size());
  switch (numbers.encoding) {
    case Encoding::Float16:
      floatsFromHalves(std::span(numbers.half).subspan(first, values.size()), values);
      break;
    case Encoding::Float32:
      std::copy_n(numbers.single.begin() + std::ptrdiff_t(first), values.size(), values.begin());
      break;
    case Encoding::Snorm8:
      for (std::size_t i = 0; i < values.size();) {
        const std::size_t block = (first + i) / numbers.block;
        const std::size_t end = std::min(values.size(), (block + 1) * numbers.block - first);
        const float unit = numbers.scales[block] / kSnorm8One;
        for (; i < end; ++i) values[i] = unit * static_cast<float>(numbers.byte[first + i]);
      }
      break;
  }
}

std::vector<float> decode(const Numbers& numbers) {
  std::vector<float> values(numbers.size());
  decode(numbers, 0, values);
  return values;
}

double encodingError(std::span<const float> values, const Numbers& numbers) {
  assert(values.size() == numbers.size());
  const std::vector<float> decoded = decode(numbers);
  double error = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double difference = double(decoded[i]) - values[i];
    error += difference * difference;
    whole += double(values[i]) * values[i];
  }
  return whole > 0.0 ? std::sqrt(error / whole) : 0.0;
}

EncodedRtt encode(const meso::RadianceTransferTexture& rtt, Encoding encoding) {
  EncodedRtt out;
  out.name = rtt.name;
  out.width = rtt.width;
  out.height = rtt.height;
  out.views = rtt.views;
  out.bands = rtt.bands;
  out.size = rtt.size;
  out.depth = rtt.depth;
  out.values = encode(rtt.values, encoding, rtt.planeSize());
  return out;
}

meso::RadianceTransferTexture decode(const EncodedRtt& rtt) {
  meso::RadianceTransferTexture out;
  out.name = rtt.name;
  out.width = rtt.width;
  out.height = rtt.height;
  out.views = rtt.views;
  out.bands = rtt.bands;
  out.size = rtt.size;
  out.depth = rtt.depth;
  out.values = decode(rtt.values);
  return out;
}

namespace {

constexpr std::size_t coefficients(int bands) {
  return std::size_t(bands) * std::size_t(bands);
}

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

EncodedBiScale encode(const transport::LocalTransfer& local, Encoding encoding) {
  EncodedBiScale out;
  out.tangents = local.tangents;
  out.bands = local.bands;
  out.channels = local.channels;
  const std::size_t matrix = coefficients(local.bands) * coefficients(local.bands);
  out.shadowed = encode(local.shadowed, encoding, matrix);
  out.interreflected = encode(local.interreflected, encoding, matrix);
  return out;
}

EncodedField encode(const transport::TransferField& field, Encoding encoding) {
  auto encoded = copyStatement<EncodedField>(field);
  for (const transport::MeshTransfer& mesh : field.meshes) {
    EncodedMesh& out = encoded.meshes.emplace_back(copyShape<EncodedMesh>(mesh));
    const std::size_t vector = coefficients(mesh.bands);
    const std::size_t matrix = coefficients(mesh.outBands) * coefficients(mesh.inBands);
    out.vectors = encode(mesh.vectors, encoding, vector);
    out.matrices = encode(mesh.matrices, encoding, matrix);
    if (!mesh.shadowed.empty())
      out.shadowed = {mesh.shadowed.channels, encode(mesh.shadowed.vectors, encoding, vector),
                      mesh.shadowed.matrixChannels,
                      encode(mesh.shadowed.matrices, encoding, matrix)};
    if (mesh.local) out.biScale = encode(*mesh.local, encoding);
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
    out.shadowed = {mesh.shadowed.channels, decode(mesh.shadowed.vectors),
                    mesh.shadowed.matrixChannels, decode(mesh.shadowed.matrices)};
    if (mesh.biScale) {
      transport::LocalTransfer& local = out.local.emplace();
      local.tangents = mesh.biScale->tangents;
      local.bands = mesh.biScale->bands;
      local.shadowed = decode(mesh.biScale->shadowed);
      local.channels = mesh.biScale->channels;
      local.interreflected = decode(mesh.biScale->interreflected);
    }
  }
  return decoded;
}

}  // namespace lambent::encode
