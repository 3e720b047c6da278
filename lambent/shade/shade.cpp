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

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/dispatch.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/lit_patch.h"
#include "lambent/shade/transfer_matrices.h"

namespace lambent::shade {

using encode::EncodedMesh;
using encode::Encoding;

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

DiffuseShader::DiffuseShader(const EncodedMesh& mesh)
    : receivers_(mesh.receiverCount()), bands_(mesh.bands), channels_(mesh.channels) {
  if (mesh.vectors.empty()) {
    bands_ = channels_ = 0;
    return;
  }
  const int coefficients = sh::coefficientCount(bands_);
  assert(channels_ == 1 || channels_ == 3);
  assert(mesh.vectors.size() == receivers_ * channels_ * coefficients);
  if (mesh.vectors.encoding == Encoding::Float32)
    single_ = inBlocks(mesh.vectors.single, receivers_, channels_, coefficients);
  else if (mesh.vectors.encoding == Encoding::Snorm8 ||
           math::bestIsa() == math::Isa::Baseline)  // decoding takes longer there than reading
    single_ = inBlocks(encode::decode(mesh.vectors), receivers_, channels_, coefficients);
  else
    half_ = inBlocks(mesh.vectors.half, receivers_, channels_, coefficients);
}

void DiffuseShader::shade(const sh::RgbCoefficients& light, std::span<float> out) const {
  assert(out.size() >= 3 * receivers_);
  if (channels_ == 0) {
    std::fill_n(out.begin(), 3 * receivers_, 0.0f);
    return;
  }
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

std::vector<float> transferredRadiance(const EncodedMesh& mesh, const sh::RgbCoefficients& light) {
  if (mesh.matrices.empty()) return {};
  return applyMatrices(mesh.matrices,
                       {mesh.receiverCount(), mesh.matrixChannels,
                        sh::coefficientCount(mesh.outBands), sh::coefficientCount(mesh.inBands)},
                       light);
}

namespace {

Vec3 directionToViewer(const View& view, const EncodedMesh& mesh, std::size_t receiver) {
  const Vec3& normal = mesh.normals[receiver];
  return view.eye ? Vec3((*view.eye - mesh.positions[receiver]).normalized()) : normal;
}

std::vector<Rgb> patchRadiance(const asset::Asset& asset, std::uint32_t meshIndex,
                               const EncodedMesh& mesh, const sh::RgbCoefficients& light,
                               const View& view) {
  const LitPatch lit(asset.scene.meshes[meshIndex], mesh, asset.transfer,
                     RttPyramids(asset.transfer, false).of(mesh.biScale->rtt), light, view.biScale);
  std::vector<Rgb> out(mesh.receiverCount());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 1024), [&](const auto& range) {
    for (std::size_t p = range.begin(); p < range.end(); ++p)
      out[p] = lit.atReceiver(std::uint32_t(p), directionToViewer(view, mesh, p));
  });
  return out;
}

}  // namespace

std::vector<Rgb> exitRadiance(const asset::Asset& asset, std::uint32_t meshIndex,
                              const sh::RgbCoefficients& light, const View& view) {
  assert(meshIndex < asset.transfer.meshes.size() && meshIndex < asset.scene.meshes.size());
  const ShownTransfer shown(asset, meshIndex, view.transfer, view.biScale.macro);
  const EncodedMesh& mesh = shown.get();
  if (mesh.layout == transport::Layout::None) return {};
  if (mesh.biScale) return patchRadiance(asset, meshIndex, mesh, light, view);
  const LitMesh lit = lightMesh(mesh, light, view.lobeExponent);
  const std::vector<Rgb> base = receiverBaseColors(asset.scene, meshIndex, mesh);

  std::vector<Rgb> out(mesh.receiverCount(), Rgb::Zero());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 1024), [&](const auto& range) {
    for (std::size_t p = range.begin(); p < range.end(); ++p) {
      const Receivers at = Receivers::one(std::uint32_t(p));
      const Rgb outside = base.empty() ? Rgb(Rgb::Ones()) : base[p];
      const Vec3& normal = mesh.normals[p];
      const Vec3 toViewer = directionToViewer(view, mesh, p);
      out[p] = lit.diffuseAt(at) * (lit.albedoOutside ? outside : Rgb(Rgb::Ones())) +
               lit.glossyAt(at, mirrored(toViewer, normal)) * outside;
    }
  });
  return out;
}

}  // namespace lambent::shade
