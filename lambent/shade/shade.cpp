// Radiance transfer applied to a light (sloan2002precomputed §6, steps 3 and 4).
//
//   M · L          vectors ⊙ light            exit radiance of a diffuse surface      eq. 8
//   M L            matrices · light           radiance that reaches a glossy surface  eq. 9
//   α_i G_i        sh::phongLobe moments      convolution with the lobe
//   Σ α_i G_i (M L)_i y_i(R)                  exit radiance towards the viewer        eq. 12
//
// R is the direction to the viewer mirrored about the normal: R = 2 (N·v) N − v.

#include "lambent/shade/shade.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/dispatch.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/lit_patch.h"
#include "lambent/shade/unshadowed.h"
#include "lambent/work/parallel_for.h"

namespace lambent::shade {

using transfer::Encoding;
using transfer::Numbers;

namespace {

template <class Number>
AlignedVector<Number> inBlocks(const std::vector<Number>& vectors, std::size_t receivers,
                               int channels, int coefficients) {
  const std::size_t blocks = (receivers + kBlock - 1) / kBlock;
  AlignedVector<Number> result(blocks * kBlock * channels * coefficients);
  for (std::size_t p = 0; p < receivers; ++p) {
    Number* block = result.data() + p / kBlock * kBlock * channels * coefficients + p % kBlock;
    const Number* vector = vectors.data() + p * channels * coefficients;
    for (int c = 0; c < channels; ++c)
      for (int k = 0; k < coefficients; ++k)
        block[(k * channels + c) * kBlock] = vector[c * coefficients + k];
  }
  return result;
}

template <class Number>
void shadeAll(DiffuseKernel<Number> kernel, const AlignedVector<Number>& blocks,
              std::size_t receivers, int channels, int stride, int count, const float* light,
              std::span<float> out) {
  const std::size_t whole = receivers / kBlock, rest = receivers % kBlock;
  kernel(blocks.data(), whole, channels, stride, count, light, out.data());
  if (rest > 0) {
    std::array<float, 3 * kBlock> last;
    kernel(blocks.data() + whole * kBlock * channels * stride, 1, channels, stride, count, light,
           last.data());
    std::copy_n(last.data(), 3 * rest, out.data() + whole * kBlock * 3);
  }
}

}  // namespace

DiffuseShader::DiffuseShader(const transfer::Vectors<Numbers>& vectors)
    : bands_(vectors.bands), channels_(vectors.channels) {
  const Numbers& numbers = vectors.numbers;
  const int coefficients = sh::coefficientCount(bands_);
  const std::size_t each = std::size_t(channels_) * std::size_t(coefficients);
  assert(channels_ == 1 || channels_ == 3);
  assert(numbers.size() % each == 0);
  receivers_ = numbers.size() / each;
  if (numbers.encoding == Encoding::Float32)
    single_ = inBlocks(numbers.single, receivers_, channels_, coefficients);
  else if (numbers.encoding == Encoding::Snorm8 ||
           math::bestIsa() == math::Isa::Baseline)  // decoding takes longer there than reading
    single_ = inBlocks(transfer::decode(numbers), receivers_, channels_, coefficients);
  else
    half_ = inBlocks(numbers.half, receivers_, channels_, coefficients);
}

void DiffuseShader::shade(const sh::RgbCoefficients& light, std::span<float> out) const {
  assert(out.size() >= 3 * receivers_);
  const int stride = sh::coefficientCount(bands_);
  const int count = std::min(stride, sh::coefficientCount(light.bands));
  std::array<float, 3 * sh::coefficientCount(sh::kMaxBands)> interleaved;
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 3; ++c) interleaved[3 * k + c] = light.channel(c)[k];
  const Kernels kernels = kernelsFor(math::bestIsa());
  if (!half_.empty())
    shadeAll(kernels.diffuseHalf, half_, receivers_, channels_, stride, count, interleaved.data(),
             out);
  else
    shadeAll(kernels.diffuseSingle, single_, receivers_, channels_, stride, count,
             interleaved.data(), out);
}

namespace {

Vec3 directionToViewer(const ReceiverView& view, const transfer::Receivers& receivers,
                       std::size_t receiver) {
  return view.eye ? Vec3((*view.eye - receivers.positions[receiver]).normalized())
                  : receivers.normals[receiver];
}

/// of(p) for all receivers.
template <class Of>
std::vector<Rgb> atAll(const transfer::Receivers& receivers, const Of& of) {
  std::vector<Rgb> out(receivers.size());
  work::parallelRanges(out.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) out[p] = of(p);
  });
  return out;
}

std::vector<Rgb> patchRadiance(const asset::Asset& asset, std::uint32_t mesh,
                               const sh::RgbCoefficients& light, const ReceiverView& view) {
  const auto& biScale = std::get<transfer::BiScale<Numbers>>(asset.transfer.meshes[mesh]);
  const LitPatch lit(asset, mesh, RttPyramids(asset.transfer, false).of(biScale.patch.rtt), light,
                     view.showing);
  const std::vector<Rgb> tint = receiverBaseColors(asset.scene, mesh, *biScale.receivers);
  return atAll(*biScale.receivers, [&](std::size_t p) -> Rgb {
    const Vec3 toViewer = directionToViewer(view, *biScale.receivers, p);
    const Rgb sent = lit.atReceiver(std::uint32_t(p), toViewer);
    return tint.empty() ? sent : Rgb(tint[p] * sent);
  });
}

std::vector<Rgb> surfaceRadiance(const asset::Asset& asset, std::uint32_t mesh,
                                 const sh::RgbCoefficients& light, const ReceiverView& view) {
  const transfer::Receivers& receivers =
      *std::get<transfer::Surface<Numbers>>(asset.transfer.meshes[mesh]).receivers;
  const transfer::Kind kind = kindShown(asset.transfer.meshes[mesh], view.showing);
  const LitMesh lit = lightMesh(*responseUnder(asset, mesh, kind), kind, light, view.showing);
  const std::vector<Rgb> base = receiverBaseColors(asset.scene, mesh, receivers);
  return atAll(receivers, [&](std::size_t p) -> Rgb {
    const ReceiverWeights at = ReceiverWeights::one(std::uint32_t(p));
    const Rgb outside = base.empty() ? Rgb(Rgb::Ones()) : base[p];
    const Vec3 toViewer = directionToViewer(view, receivers, p);
    return lit.diffuseAt(at) * (lit.albedoOutside ? outside : Rgb(Rgb::Ones())) +
           lit.glossyAt(at, toViewer, receivers.normals[p]) * outside;
  });
}

}  // namespace

std::vector<Rgb> exitRadiance(const asset::Asset& asset, std::uint32_t mesh,
                              const sh::RgbCoefficients& light, const ReceiverView& view) {
  assert(mesh < asset.transfer.meshes.size() && mesh < asset.scene.meshes.size());
  using Radiance = std::vector<Rgb>;
  return std::visit(transfer::ForEachKind{[](const transfer::NoTransfer&) { return Radiance(); },
                                          [&](const transfer::Surface<Numbers>&) {
                                            return surfaceRadiance(asset, mesh, light, view);
                                          },
                                          [&](const transfer::BiScale<Numbers>&) {
                                            return patchRadiance(asset, mesh, light, view);
                                          }},
                    asset.transfer.meshes[mesh]);
}

}  // namespace lambent::shade
