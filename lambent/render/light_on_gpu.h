// Transfer · light by compute shaders (sloan2002precomputed §6, step 3), a chunk of receivers at a
// time.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "lambent/encode/encoded_field.h"
#include "lambent/render/gl_objects.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/bi_scale_options.h"

namespace lambent::render {

/// The line that tells shaders how numbers are stored (shaders/numbers.glsl).
std::string numbersDefine(encode::Encoding encoding);

class TransferOnGpu {
 public:
  /// `light` must outlive it. No buffer that is made here exceeds `largestBlock` bytes.
  TransferOnGpu(const sh::RgbCoefficients& light, std::size_t largestBlock);

  /// Exit radiance M · L of the named receivers of a mesh: [receiver][3] floats.
  Result<Buffer> diffuse(const encode::EncodedMesh& mesh, std::span<const std::uint32_t> receivers);
  /// α_i G_i (M L)_i k: [receiver][coefficient][3] floats.
  Result<Buffer> lobe(const encode::EncodedMesh& mesh, std::span<const std::uint32_t> receivers,
                      std::optional<float> lobeExponent);
  /// Light that arrives at the meso-structure of the named receivers of a bi-scale mesh, times a
  /// factor for each of bands² coefficients: rttStride(bands) floats a receiver, laid out as
  /// shade::RttPyramid's numbers are. `macro` must be held.
  Result<Buffer> incident(const encode::EncodedMesh& mesh, std::span<const std::uint32_t> receivers,
                          int bands, std::span<const float> factors,
                          std::optional<shade::MacroTransport> macro);

 private:
  enum class Kind { Vectors, Matrices };
  /// As shade::MatrixShape, and what becomes of the products.
  struct Product {
    int channels = 1, rows = 0, columns = 0;
    int rowsUsed = 0, stride = 0;  ///< numbers of a receiver in the output
    Rgb reflectance = Rgb::Ones();
  };
  Result<const Program*> program(Kind kind, encode::Encoding encoding);
  Status multiply(const encode::Numbers& matrices, const Product& product,
                  std::span<const std::uint32_t> receivers, std::span<const float> factors,
                  const Buffer& out);

  const sh::RgbCoefficients& lightOnCpu_;
  int lightCoefficients_ = 0;
  std::size_t largestBlock_ = 0;
  Buffer light_;
  std::map<std::pair<Kind, encode::Encoding>, Program> programs_;
};

/// Bytes that lobe() makes for each receiver.
inline std::size_t lobeBytes(int outBands) {
  return sizeof(float) * 3 * sh::coefficientCount(outBands);
}

}  // namespace lambent::render
