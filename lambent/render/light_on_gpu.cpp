#include "lambent/render/light_on_gpu.h"

#include <algorithm>

#include "lambent/render/shader_sources.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/lit_patch.h"
#include "lambent/shade/macro_transport.h"

namespace lambent::render {

using encode::Encoding;
using encode::Numbers;

std::string numbersDefine(Encoding encoding) {
  const char* kind = encoding == Encoding::Snorm8 ? "2" : encoding == Encoding::Float16 ? "1" : "0";
  return std::string("#define LAMBENT_NUMBERS ") + kind;
}

namespace {

constexpr std::size_t kChunkBytes = std::size_t(32) << 20;  // of transfer on its way to the GPU
constexpr std::size_t kMostInvocations = 65535 * 64;        // every GL takes as many work groups

template <class Number>
std::vector<Number> gather(const std::vector<Number>& numbers, std::size_t each,
                           std::span<const std::uint32_t> receivers) {
  std::vector<Number> chunk(receivers.size() * each);
  for (std::size_t p = 0; p < receivers.size(); ++p)
    std::copy_n(numbers.begin() + receivers[p] * each, each, chunk.begin() + p * each);
  return chunk;
}

/// Numbers on the GPU as shaders/numbers.glsl reads them.
struct Uploaded {
  Buffer numbers, scales;  ///< scales of bytes only
};

Uploaded upload(const Numbers& numbers, std::size_t each,
                std::span<const std::uint32_t> receivers) {
  switch (numbers.encoding) {
    case Encoding::Float16:
      return {makeBuffer(gather(numbers.half, each, receivers)), {}};
    case Encoding::Snorm8:
      return {makeBuffer(gather(numbers.byte, each, receivers)),
              makeBuffer(gather(numbers.scales, each / numbers.block, receivers))};
    case Encoding::Float32:
      break;
  }
  return {makeBuffer(gather(numbers.single, each, receivers)), {}};
}

/// Numbers go up in chunks of receivers, and so do scales. Where a scale spans several receivers:
/// the numbers as floats; empty otherwise.
Numbers asFloatsIfScalesSpan(const Numbers& numbers, std::size_t each) {
  if (numbers.encoding != Encoding::Snorm8 || each % numbers.block == 0) return {};
  return encode::encode(encode::decode(numbers), Encoding::Float32);
}

std::size_t bytesOf(Encoding encoding) {
  return encoding == Encoding::Snorm8 ? 1 : encoding == Encoding::Float16 ? 2 : 4;
}

/// Uploads chunk after chunk and runs `program` on each: `perReceiver` invocations a receiver.
Status runInChunks(const Program& program, const Numbers& numbers, std::size_t each,
                   std::size_t perReceiver, std::span<const std::uint32_t> receivers,
                   std::size_t largestBlock) {
  const std::size_t bytes = each * bytesOf(numbers.encoding);
  const std::size_t most = std::max<std::size_t>(
      1, std::min(std::min(kChunkBytes, largestBlock) / bytes, kMostInvocations / perReceiver));
  program.use();
  for (std::size_t first = 0; first < receivers.size(); first += most) {
    const auto chunk = receivers.subspan(first, std::min(most, receivers.size() - first));
    const Uploaded transfer = upload(numbers, each, chunk);
    if (Status s = checkGl("uploading transfer"); !s) return s;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, transfer.numbers.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, transfer.scales.name());
    program.set("block", unsigned(numbers.block));
    program.set("receivers", unsigned(chunk.size()));
    program.set("first", unsigned(first));
    glDispatchCompute(GLuint((chunk.size() * perReceiver + 63) / 64), 1, 1);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  return checkGl("applying transfer to the light");
}

}  // namespace

TransferOnGpu::TransferOnGpu(const sh::RgbCoefficients& light, std::size_t largestBlock)
    : lightOnCpu_(light),
      lightCoefficients_(sh::coefficientCount(light.bands)),
      largestBlock_(largestBlock) {
  std::vector<float> interleaved;
  for (int k = 0; k < lightCoefficients_; ++k)
    for (int c = 0; c < 3; ++c) interleaved.push_back(light.channel(c)[k]);
  light_ = makeBuffer(interleaved);
}

Result<const Program*> TransferOnGpu::program(Kind kind, Encoding encoding) {
  const std::pair key(kind, encoding);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    const char* name =
        kind == Kind::Vectors ? "transfer_vectors.comp.glsl" : "transfer_matrices.comp.glsl";
    const Program::Stage stage{GL_COMPUTE_SHADER,
                               name,
                               {numbersDefine(encoding), std::string(shaderSource("numbers.glsl")),
                                std::string(shaderSource(name))}};
    Result<Program> made = Program::make({&stage, 1});
    if (!made) return made.error();
    found = programs_.emplace(key, std::move(*made)).first;
  }
  return &found->second;
}

Result<Buffer> TransferOnGpu::diffuse(const encode::EncodedMesh& mesh,
                                      std::span<const std::uint32_t> receivers) {
  const int coefficients = sh::coefficientCount(mesh.bands);
  const std::size_t each = std::size_t(mesh.channels) * coefficients;
  const Numbers decoded = asFloatsIfScalesSpan(mesh.vectors, each);
  const Numbers& vectors = decoded.empty() ? mesh.vectors : decoded;
  Result<const Program*> program = this->program(Kind::Vectors, vectors.encoding);
  if (!program) return program.error();
  Buffer out = makeBuffer(receivers.size() * 3 * sizeof(float));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, light_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, out.name());
  (*program)->set("channels", unsigned(mesh.channels));
  (*program)->set("coefficients", unsigned(coefficients));
  (*program)->set("used", unsigned(std::min(coefficients, lightCoefficients_)));
  const Status done = runInChunks(**program, vectors, each, 1, receivers, largestBlock_);
  if (!done) return done.error();
  return out;
}

Status TransferOnGpu::multiply(const Numbers& matrices, const Product& product,
                               std::span<const std::uint32_t> receivers,
                               std::span<const float> factors, const Buffer& out) {
  const std::size_t each = std::size_t(product.channels) * product.rows * product.columns;
  const Numbers decoded = asFloatsIfScalesSpan(matrices, each);
  const Numbers& numbers = decoded.empty() ? matrices : decoded;
  Result<const Program*> program = this->program(Kind::Matrices, numbers.encoding);
  if (!program) return program.error();
  const Buffer factorBuffer = makeBuffer(factors.size_bytes(), factors.data());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, light_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, out.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, factorBuffer.name());
  (*program)->set("channels", unsigned(product.channels));
  (*program)->set("rows", unsigned(product.rows));
  (*program)->set("rowsUsed", unsigned(product.rowsUsed));
  (*program)->set("stride", unsigned(product.stride));
  (*program)->set("columns", unsigned(product.columns));
  (*program)->set("used", unsigned(std::min(product.columns, lightCoefficients_)));
  (*program)->set("reflectance", product.reflectance.x(), product.reflectance.y(),
                  product.reflectance.z());
  return runInChunks(**program, numbers, each, product.rowsUsed, receivers, largestBlock_);
}

Result<Buffer> TransferOnGpu::lobe(const encode::EncodedMesh& mesh,
                                   std::span<const std::uint32_t> receivers,
                                   std::optional<float> lobeExponent) {
  Buffer out = makeBuffer(receivers.size() * lobeBytes(mesh.outBands));
  const int rows = sh::coefficientCount(mesh.outBands);
  const Product product{
      mesh.matrixChannels, rows, sh::coefficientCount(mesh.inBands), rows, 3 * rows, mesh.glossy};
  const std::vector<float> factors =
      shade::lobeFactors(mesh.outBands, lobeExponent.value_or(mesh.lobeExponent));
  if (Status s = multiply(mesh.matrices, product, receivers, factors, out); !s) return s.error();
  return out;
}

Result<Buffer> TransferOnGpu::incident(const encode::EncodedMesh& mesh,
                                       std::span<const std::uint32_t> receivers, int bands,
                                       std::span<const float> factors,
                                       std::optional<shade::MacroTransport> macro) {
  using shade::MacroTransport;
  const encode::EncodedBiScale& biScale = *mesh.biScale;
  const int count = sh::coefficientCount(bands), stride = shade::rttStride(bands);
  std::vector<float> zeros(receivers.size() * stride);
  const MacroTransport chosen = macro.value_or(shade::bestOf(biScale));
  if (chosen == MacroTransport::Off) {
    // A rotation of the light for each receiver has no matrix to multiply with: made here.
    const std::vector<float> light =
        shade::inRttLayout(shade::incidentLight(mesh, lightOnCpu_, bands, chosen), bands);
    for (std::size_t p = 0; p < receivers.size(); ++p)
      for (int i = 0; i < 3 * count; ++i)
        zeros[p * stride + i] = factors[i / 3] * light[receivers[p] * std::size_t(stride) + i];
    return makeBuffer(zeros);
  }
  Buffer out = makeBuffer(zeros);
  const bool shadowed = chosen == MacroTransport::Shadowed;
  const int n = sh::coefficientCount(biScale.bands);
  const Product product{shadowed ? 1 : biScale.channels, n, n, std::min(n, count), stride};
  if (Status s = multiply(shadowed ? biScale.shadowed : biScale.interreflected, product, receivers,
                          factors, out);
      !s)
    return s.error();
  return out;
}

}  // namespace lambent::render
