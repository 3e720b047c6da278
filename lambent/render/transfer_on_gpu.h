// Transfer · light by compute shaders (sloan2002precomputed §6, steps 2 and 3), a chunk of
// receivers at a time. Transfer either stays on the GPU, so that a new light costs one dispatch a
// chunk, or streams through it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "lambent/capture/blending.h"
#include "lambent/render/gl_objects.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/rtt_pyramid.h"
#include "lambent/shade/showing.h"
#include "lambent/transfer/field.h"

namespace lambent::render {

/// The line that tells shaders how numbers are stored (opengl/numbers.glsl).
std::string numbersDefine(transfer::Encoding encoding);

/// Matrices or vectors as they are stored, and what becomes of their products with the light.
struct ProductShape {
  enum class Kind { Vectors, Matrices } kind = Kind::Vectors;
  transfer::Encoding encoding = transfer::Encoding::Float32;
  int channels = 1, rows = 1, columns = 0;
  int rowsUsed = 1, stride = 3;  ///< numbers of a receiver in the output
  Rgb reflectance = Rgb::Ones();
};

/// Some receivers of a mesh, the products of their transfer with the light, and what it takes to
/// make these anew (nothing, if transfer streams).
struct Relit {
  struct Chunk {
    Buffer numbers, scales;            ///< as numbers.glsl reads them; scales of bytes only
    std::size_t first = 0, count = 0;  ///< receivers
  };
  std::vector<std::uint32_t> receivers;  ///< the mesh's numbers of them
  /// What its product is with: all of the light, its Sun's share of it, the rest, or what reaches soft
  /// lobes (shade::Showing::softLobes). Light fields are taken as they are.
  enum class Light { Whole, Sun, WithoutSun, SoftLobes };
  Light light = Light::Whole;
  Buffer product;  ///< [receiver][ProductShape::stride] floats
  ProductShape shape;
  Buffer factors;  ///< [rowsUsed], what each row is multiplied with; matrices only
  std::vector<Chunk> chunks;
  Buffer blend;  ///< [receiver] samples and weights of a light field

  /// Bytes that a receiver's part of `blend` takes.
  static constexpr std::size_t kBlendBytes = 6 * sizeof(std::uint32_t);
};

class TransferOnGpu {
 public:
  /// Keep: relight() can be called with ever new lights. Stream: transfer is applied to the light
  /// while it passes, and dropped.
  enum class Residence { Keep, Stream };

  /// No buffer that is made here exceeds `largestBlock` bytes.
  TransferOnGpu(std::size_t largestBlock, Residence residence)
      : largestBlock_(largestBlock), residence_(residence) {}

  /// One light for all receivers.
  void setLight(const sh::RgbCoefficients& light);
  /// What a Sun that is sharp (shade/sharp_sun.h) is of it; none: nothing.
  void setSunShare(const std::optional<sh::RgbCoefficients>& share);
  /// A light for each of some samples: [sample][coefficient][3] floats in a buffer of the caller's.
  /// Every Relit must have been blended().
  Status setField(GLuint lights, int bands);
  /// Uploads how samples blend over the receivers of `relit`: one for each receiver of its mesh.
  static Status setBlend(Relit& relit, std::span<const capture::BlendWeights> weights);

  /// Exit radiance M · L of the named receivers of a mesh: [receiver][3].
  Result<Relit> diffuse(const transfer::Vectors<transfer::Numbers>& vectors,
                        std::vector<std::uint32_t> receivers,
                        Relit::Light light = Relit::Light::Whole);
  /// α_i G_i (M L)_i k: [receiver][rttStride(outBands)], coefficient after coefficient, each R, G,
  /// B, filled up with zeros.
  Result<Relit> lobe(const transfer::Glossy<transfer::Numbers>& glossy,
                     std::vector<std::uint32_t> receivers, const shade::Showing& showing);
  /// Another lobe for what lobe() made of these.
  static void setLobe(Relit& relit, const transfer::Glossy<transfer::Numbers>& glossy,
                      const shade::Showing& showing);
  /// Light that arrives at the meso-structure of the named receivers under a kind (which must be
  /// held, or Unshadowed), times a factor for each of bands² coefficients:
  /// [receiver][rttStride(bands)], laid out as shade::RttPyramid's numbers are.
  Result<Relit> incident(const transfer::BiScale<transfer::Numbers>& biScale,
                         std::vector<std::uint32_t> receivers, int bands,
                         std::span<const float> factors, transfer::Kind kind);

  /// Makes the products anew: the light, or the lobe, has changed.
  Status relight(const Relit& relit);

 private:
  struct LightBuffer;
  Status multiply(Relit& relit, const transfer::Numbers& transfer);
  Relit turned(const transfer::BiScale<transfer::Numbers>& biScale,
               const std::vector<std::uint32_t>& receivers, int bands,
               std::span<const float> factors) const;
  Status dispatch(const Relit& relit, const Relit::Chunk& chunk);
  /// Whether receivers have lights of their own for it.
  bool takesField(const Relit& relit) const {
    return field_ != 0 && relit.light != Relit::Light::Sun;
  }
  Result<const Program*> program(const Relit& relit, transfer::Encoding encoding);
  void uploadSun();
  const LightBuffer& lightOf(const Relit& relit);

  std::size_t largestBlock_;
  Residence residence_;
  /// Coefficients as numbers.glsl reads them.
  struct LightBuffer {
    Buffer buffer;
    int bands = 0;
    void write(const sh::RgbCoefficients& light);
  };
  sh::RgbCoefficients lightOnCpu_;
  std::optional<sh::RgbCoefficients> sunShare_;
  LightBuffer light_, sun_, withoutSun_, ofSoftLobes_;
  bool softLobesStale_ = true;  ///< ofSoftLobes_ is not of this light
  GLuint field_ = 0;            ///< the caller's buffer, or 0: one light
  int fieldBands_ = 0;
  Buffer blended_;  ///< the field at the receivers of one dispatch: [receiver][coefficient][3]
  std::size_t blendedBytes_ = 0;
  std::optional<Program> blend_;
  std::map<std::tuple<ProductShape::Kind, transfer::Encoding, bool>, Program>
      programs_;  ///< … field
};

/// Bytes that lobe() makes for each receiver.
inline std::size_t lobeBytes(int outBands) {
  return sizeof(float) * std::size_t(shade::rttStride(outBands));
}

}  // namespace lambent::render
