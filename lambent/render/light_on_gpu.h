// Transfer · light by compute shaders (sloan2002precomputed §6, step 3), a chunk of receivers at a
// time.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "lambent/encode/encoded_field.h"
#include "lambent/render/gl_objects.h"
#include "lambent/sh/coefficients.h"

namespace lambent::render {

class TransferOnGpu {
 public:
  /// No buffer that is made here exceeds `largestBlock` bytes.
  TransferOnGpu(const sh::RgbCoefficients& light, std::size_t largestBlock);

  /// Exit radiance M · L of the named receivers of a mesh: [receiver][3] floats.
  Result<Buffer> diffuse(const encode::EncodedMesh& mesh, std::span<const std::uint32_t> receivers);
  /// α_i G_i (M L)_i k: [receiver][coefficient][3] floats.
  Result<Buffer> lobe(const encode::EncodedMesh& mesh, std::span<const std::uint32_t> receivers,
                      std::optional<float> lobeExponent);

 private:
  enum class Kind { Vectors, Matrices };
  Result<const Program*> program(Kind kind, encode::Encoding encoding);

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
