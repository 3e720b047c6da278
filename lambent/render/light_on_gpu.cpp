#include "lambent/render/light_on_gpu.h"

#include <algorithm>

#include "lambent/render/shader_sources.h"
#include "lambent/shade/lit_mesh.h"

namespace lambent::render {

using encode::Encoding;
using encode::Numbers;

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

Buffer upload(const Numbers& numbers, std::size_t each, std::span<const std::uint32_t> receivers) {
  if (numbers.encoding == Encoding::Float16) {
    const std::vector<std::uint16_t> chunk = gather(numbers.half, each, receivers);
    return makeBuffer(chunk);
  }
  const std::vector<float> chunk = gather(numbers.single, each, receivers);
  return makeBuffer(chunk);
}

/// Uploads chunk after chunk and runs `program` on each: `perReceiver` invocations a receiver.
Status runInChunks(const Program& program, const Numbers& numbers, std::size_t each,
                   std::size_t perReceiver, std::span<const std::uint32_t> receivers,
                   std::size_t largestBlock) {
  const std::size_t bytes = each * (numbers.encoding == Encoding::Float16 ? 2 : 4);
  const std::size_t most = std::max<std::size_t>(
      1, std::min(std::min(kChunkBytes, largestBlock) / bytes, kMostInvocations / perReceiver));
  program.use();
  for (std::size_t first = 0; first < receivers.size(); first += most) {
    const auto chunk = receivers.subspan(first, std::min(most, receivers.size() - first));
    const Buffer transfer = upload(numbers, each, chunk);
    if (Status s = checkGl("uploading transfer"); !s) return s;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, transfer.name());
    program.set("receivers", unsigned(chunk.size()));
    program.set("first", unsigned(first));
    glDispatchCompute(GLuint((chunk.size() * perReceiver + 63) / 64), 1, 1);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  return checkGl("applying transfer to the light");
}

}  // namespace

TransferOnGpu::TransferOnGpu(const sh::RgbCoefficients& light, std::size_t largestBlock)
    : lightCoefficients_(sh::coefficientCount(light.bands)), largestBlock_(largestBlock) {
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
    const Program::Stage stage{
        GL_COMPUTE_SHADER,
        name,
        {encoding == Encoding::Float16 ? "#define LAMBENT_HALF 1" : "#define LAMBENT_HALF 0",
         std::string(shaderSource("numbers.glsl")), std::string(shaderSource(name))}};
    Result<Program> made = Program::make({&stage, 1});
    if (!made) return made.error();
    found = programs_.emplace(key, std::move(*made)).first;
  }
  return &found->second;
}

Result<Buffer> TransferOnGpu::diffuse(const encode::EncodedMesh& mesh,
                                      std::span<const std::uint32_t> receivers) {
  Result<const Program*> program = this->program(Kind::Vectors, mesh.vectors.encoding);
  if (!program) return program.error();
  Buffer out = makeBuffer(receivers.size() * 3 * sizeof(float));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, light_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, out.name());
  const int coefficients = sh::coefficientCount(mesh.bands);
  (*program)->set("channels", unsigned(mesh.channels));
  (*program)->set("coefficients", unsigned(coefficients));
  (*program)->set("used", unsigned(std::min(coefficients, lightCoefficients_)));
  const Status done =
      runInChunks(**program, mesh.vectors, std::size_t(mesh.channels) * coefficients, 1, receivers,
                  largestBlock_);
  if (!done) return done.error();
  return out;
}

Result<Buffer> TransferOnGpu::lobe(const encode::EncodedMesh& mesh,
                                   std::span<const std::uint32_t> receivers,
                                   std::optional<float> lobeExponent) {
  Result<const Program*> program = this->program(Kind::Matrices, mesh.matrices.encoding);
  if (!program) return program.error();
  Buffer out = makeBuffer(receivers.size() * lobeBytes(mesh.outBands));
  const std::vector<float> factors =
      shade::lobeFactors(mesh.outBands, lobeExponent.value_or(mesh.lobeExponent));
  const Buffer factorBuffer = makeBuffer(factors);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, light_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, out.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, factorBuffer.name());
  const int rows = sh::coefficientCount(mesh.outBands);
  const int columns = sh::coefficientCount(mesh.inBands);
  (*program)->set("channels", unsigned(mesh.matrixChannels));
  (*program)->set("rows", unsigned(rows));
  (*program)->set("columns", unsigned(columns));
  (*program)->set("used", unsigned(std::min(columns, lightCoefficients_)));
  (*program)->set("glossy", mesh.glossy.x(), mesh.glossy.y(), mesh.glossy.z());
  const Status done =
      runInChunks(**program, mesh.matrices, std::size_t(mesh.matrixChannels) * rows * columns, rows,
                  receivers, largestBlock_);
  if (!done) return done.error();
  return out;
}

}  // namespace lambent::render
