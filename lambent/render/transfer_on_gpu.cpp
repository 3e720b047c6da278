#include "lambent/render/transfer_on_gpu.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "lambent/render/shader_sources.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/lit_patch.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/shade/unshadowed.h"
#include "lambent/work/parallel_for.h"

namespace lambent::render {

using transfer::Encoding;
using transfer::Numbers;

std::string numbersDefine(Encoding encoding) {
  const char* kind = encoding == Encoding::Snorm8 ? "2" : encoding == Encoding::Float16 ? "1" : "0";
  return std::string("#define LAMBENT_NUMBERS ") + kind;
}

namespace {

constexpr std::size_t kStreamedBytes = std::size_t(32) << 20;  // of transfer on its way to the GPU
constexpr std::size_t kBlendedBytes = std::size_t(16) << 20;   // of a field's light at receivers
constexpr std::size_t kMostInvocations = 65535 * 64;           // every GL takes as many work groups

/// Words of one row of `columns` numbers.
std::size_t rowWords(Encoding encoding, int columns) {
  return (std::size_t(columns) * transfer::bytesPerNumber(encoding) + 3) / 4;
}

/// The rows of the named receivers, each filled up to a whole word.
template <class Number>
Buffer gatherRows(const std::vector<Number>& numbers, std::size_t rows, std::size_t columns,
                  std::span<const std::uint32_t> receivers) {
  const std::size_t perWord = 4 / sizeof(Number);
  const std::size_t filled = (columns + perWord - 1) / perWord * perWord;
  std::vector<Number> chunk(receivers.size() * rows * filled);
  work::parallelRanges(receivers.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      for (std::size_t row = 0; row < rows; ++row)
        std::copy_n(numbers.data() + (receivers[p] * rows + row) * columns, columns,
                    chunk.data() + (p * rows + row) * filled);
  });
  return makeBuffer(chunk);
}

/// rows: of one receiver, all channels.
Relit::Chunk upload(const Numbers& numbers, std::size_t rows, std::size_t columns,
                    std::span<const std::uint32_t> receivers) {
  Relit::Chunk chunk;
  chunk.count = receivers.size();
  switch (numbers.encoding) {
    case Encoding::Float16:
      chunk.numbers = gatherRows(numbers.half, rows, columns, receivers);
      break;
    case Encoding::Float32:
      chunk.numbers = gatherRows(numbers.single, rows, columns, receivers);
      break;
    case Encoding::Snorm8: {
      chunk.numbers = gatherRows(numbers.byte, rows, columns, receivers);
      std::vector<float> scales;
      scales.reserve(receivers.size() * rows);
      for (const std::uint32_t receiver : receivers)
        for (std::size_t row = 0; row < rows; ++row)
          scales.push_back(numbers.scales[(receiver * rows + row) * columns / numbers.block]);
      chunk.scales = makeBuffer(scales);
      break;
    }
  }
  return chunk;
}

/// On the GPU a row of bytes has one scale. Where a stored row has several: the numbers as floats;
/// empty otherwise.
Numbers asFloatsIfScalesDiffer(const Numbers& numbers, std::size_t columns) {
  if (numbers.encoding != Encoding::Snorm8 || numbers.block % columns == 0) return {};
  return transfer::encode(transfer::decode(numbers), Encoding::Float32);
}

/// Coefficients of a light as opengl/numbers.glsl reads them: filled up to four.
int filledUp(int coefficients) {
  return (coefficients + 3) / 4 * 4;
}

std::vector<float> interleaved(const sh::RgbCoefficients& light) {
  std::vector<float> result;
  for (int k = 0; k < sh::coefficientCount(light.bands); ++k)
    for (int c = 0; c < 3; ++c) result.push_back(light.channel(c)[k]);
  result.resize(3 * std::size_t(filledUp(sh::coefficientCount(light.bands))));
  return result;
}

}  // namespace

void TransferOnGpu::LightBuffer::write(const sh::RgbCoefficients& light) {
  const std::vector<float> numbers = interleaved(light);
  if (!buffer.name() || light.bands != bands)
    buffer = makeChangingBuffer(numbers.size() * sizeof(float));
  glNamedBufferSubData(buffer.name(), 0, GLsizeiptr(numbers.size() * sizeof(float)),
                       numbers.data());
  bands = light.bands;
}

void TransferOnGpu::uploadSun() {
  const sh::RgbCoefficients none(1);
  sh::RgbCoefficients rest = lightOnCpu_;
  if (sunShare_ && rest.bands > 0) {
    const sh::RgbCoefficients share = sh::withBands(*sunShare_, rest.bands);
    for (std::size_t i = 0; i < rest.values.size(); ++i) rest.values[i] -= share.values[i];
  }
  sun_.write(sunShare_ ? *sunShare_ : none);
  withoutSun_.write(rest.bands > 0 ? rest : none);
}

void TransferOnGpu::setLight(const sh::RgbCoefficients& light) {
  light_.write(light);
  lightOnCpu_ = light;
  field_ = 0;
  softLobesStale_ = true;
  uploadSun();
}

void TransferOnGpu::setSunShare(const std::optional<sh::RgbCoefficients>& share) {
  sunShare_ = share;
  uploadSun();
}

Status TransferOnGpu::setField(GLuint lights, int bands) {
  if (!blend_) {
    const Program::Stage stage{GL_COMPUTE_SHADER,
                               "blend_light.comp.glsl",
                               {std::string(shaderSource("blend_light.comp.glsl"))}};
    Result<Program> made = Program::make({&stage, 1});
    if (!made) return made.error();
    blend_ = std::move(*made);
  }
  if (!blended_.name()) {
    blendedBytes_ = std::min(kBlendedBytes, largestBlock_);
    blended_ = makeBuffer(blendedBytes_);
    if (Status s = checkGl("making room for a light field"); !s) return s;
  }
  field_ = lights;
  fieldBands_ = bands;
  return Status::ok();
}

Status TransferOnGpu::setBlend(Relit& relit, std::span<const capture::BlendWeights> weights) {
  std::vector<std::uint32_t> words;
  words.reserve(relit.receivers.size() * Relit::kBlendBytes / sizeof(std::uint32_t));
  for (const std::uint32_t receiver : relit.receivers) {
    const capture::BlendWeights& w = weights[receiver];
    words.push_back(w.sample[0] | std::uint32_t(w.sample[1]) << 16);
    words.push_back(w.sample[2] | std::uint32_t(w.sample[3]) << 16);
    for (const float weight : w.weight) words.push_back(std::bit_cast<std::uint32_t>(weight));
  }
  relit.blend = makeBuffer(words);
  return checkGl("uploading how light blends");
}

Result<const Program*> TransferOnGpu::program(const Relit& relit, Encoding encoding) {
  const ProductShape::Kind kind = relit.shape.kind;
  const bool field = takesField(relit);
  const std::tuple key(kind, encoding, field);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    const char* name = kind == ProductShape::Kind::Vectors ? "transfer_vectors.comp.glsl"
                                                           : "transfer_matrices.comp.glsl";
    const Program::Stage stage{
        GL_COMPUTE_SHADER,
        name,
        {numbersDefine(encoding), std::string("#define LAMBENT_FIELD ") + (field ? "1" : "0"),
         std::string(shaderSource("numbers.glsl")), std::string(shaderSource(name))}};
    Result<Program> made = Program::make({&stage, 1});
    if (!made) return made.error();
    found = programs_.emplace(key, std::move(*made)).first;
  }
  return &found->second;
}

const TransferOnGpu::LightBuffer& TransferOnGpu::lightOf(const Relit& relit) {
  switch (relit.light) {
    case Relit::Light::Whole:
      return light_;
    case Relit::Light::Sun:
      return sun_;
    case Relit::Light::WithoutSun:
      return withoutSun_;
    case Relit::Light::SoftLobes:
      break;
  }
  if (lightOnCpu_.bands > 0 && std::exchange(softLobesStale_, false))
    ofSoftLobes_.write(shade::softened(lightOnCpu_));
  return ofSoftLobes_;
}

Status TransferOnGpu::dispatch(const Relit& relit, const Relit::Chunk& chunk) {
  const Result<const Program*> found = program(relit, relit.shape.encoding);
  if (!found) return found.error();
  const Program& product = **found;
  const ProductShape& shape = relit.shape;
  const bool field = takesField(relit);
  const LightBuffer& light = lightOf(relit);
  const int bands = field ? fieldBands_ : light.bands;
  const int used = std::min(shape.columns, sh::coefficientCount(bands));
  const int made = filledUp(used);
  product.set("channels", unsigned(shape.channels));
  product.set("rows", unsigned(shape.rows));
  product.set("rowsUsed", unsigned(shape.rowsUsed));
  product.set("stride", unsigned(shape.stride));
  product.set("rowWords", unsigned(rowWords(shape.encoding, shape.columns)));
  product.set("usedWords", unsigned(rowWords(shape.encoding, used)));
  product.set("reflectance", shape.reflectance.x(), shape.reflectance.y(), shape.reflectance.z());
  product.set("lightStride", unsigned(3 * made));
  // A field is first blended for as many receivers as there is room for.
  const std::size_t most =
      field ? std::clamp<std::size_t>(blendedBytes_ / (3 * sizeof(float) * std::size_t(made)), 1,
                                      kMostInvocations / std::size_t(made))
            : chunk.count;
  for (std::size_t begin = 0; begin < chunk.count; begin += most) {
    const std::size_t count = std::min(most, chunk.count - begin);
    if (field) {
      blend_->set("receivers", unsigned(count));
      blend_->set("first", unsigned(chunk.first + begin));
      blend_->set("coefficients", unsigned(sh::coefficientCount(bands)));
      blend_->set("used", unsigned(used));
      blend_->set("made", unsigned(made));
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, field_);
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, relit.blend.name());
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, blended_.name());
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
      blend_->use();
      glDispatchCompute(GLuint((count * std::size_t(made) + 63) / 64), 1, 1);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    product.set("begin", unsigned(begin));
    product.set("receivers", unsigned(count));
    product.set("first", unsigned(chunk.first));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, chunk.numbers.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, field ? blended_.name() : light.buffer.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, relit.product.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, relit.factors.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, chunk.scales.name());
    product.use();
    glDispatchCompute(GLuint((count * std::size_t(shape.rowsUsed) + 63) / 64), 1, 1);
  }
  return Status::ok();
}

Status TransferOnGpu::relight(const Relit& relit) {
  for (const Relit::Chunk& chunk : relit.chunks)
    if (Status s = dispatch(relit, chunk); !s) return s;
  return Status::ok();
}

Status TransferOnGpu::multiply(Relit& relit, const Numbers& transfer) {
  const bool keep = residence_ == Residence::Keep;
  const auto columns = std::size_t(relit.shape.columns);
  const std::size_t rows = std::size_t(relit.shape.channels) * std::size_t(relit.shape.rows);
  const Numbers decoded = asFloatsIfScalesDiffer(transfer, columns);
  const Numbers& numbers = decoded.empty() ? transfer : decoded;
  relit.shape.encoding = numbers.encoding;
  if (const Result<const Program*> made = program(relit, numbers.encoding); !made)
    return made.error();
  relit.product =
      makeBuffer(relit.receivers.size() * std::size_t(relit.shape.stride) * sizeof(float));
  const float zero = 0.0f;  // what fills a stride up
  glClearNamedBufferData(relit.product.name(), GL_R32F, GL_RED, GL_FLOAT, &zero);

  const std::size_t room = keep ? largestBlock_ : std::min(kStreamedBytes, largestBlock_);
  const std::size_t most =
      std::clamp<std::size_t>(room / (rows * rowWords(numbers.encoding, relit.shape.columns) * 4),
                              1, kMostInvocations / std::size_t(relit.shape.rowsUsed));
  const std::span<const std::uint32_t> receivers = relit.receivers;
  for (std::size_t first = 0; first < receivers.size(); first += most) {
    const auto named = receivers.subspan(first, std::min(most, receivers.size() - first));
    Relit::Chunk chunk = upload(numbers, rows, columns, named);
    if (Status s = checkGl("uploading transfer"); !s) return s;
    chunk.first = first;
    if (keep)
      relit.chunks.push_back(std::move(chunk));
    else if (Status s = dispatch(relit, chunk); !s)
      return s;
  }
  if (!keep) {
    relit.receivers = {};
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return checkGl("applying transfer to the light");
  }
  return Status::ok();
}

Result<Relit> TransferOnGpu::diffuse(const transfer::Vectors<Numbers>& vectors,
                                     std::vector<std::uint32_t> receivers, Relit::Light light) {
  Relit relit;
  relit.light = light;
  relit.receivers = std::move(receivers);
  relit.shape.kind = ProductShape::Kind::Vectors;
  relit.shape.channels = vectors.channels;
  relit.shape.columns = sh::coefficientCount(vectors.bands);
  if (Status s = multiply(relit, vectors.numbers); !s) return s.error();
  return relit;
}

Result<Relit> TransferOnGpu::lobe(const transfer::Glossy<Numbers>& glossy,
                                  std::vector<std::uint32_t> receivers,
                                  const shade::Showing& showing) {
  const transfer::Matrices<Numbers>& matrices = glossy.matrices;
  Relit relit;
  relit.receivers = std::move(receivers);
  relit.shape.kind = ProductShape::Kind::Matrices;
  relit.shape.channels = matrices.channels;
  relit.shape.rows = relit.shape.rowsUsed = sh::coefficientCount(matrices.outBands);
  relit.shape.columns = sh::coefficientCount(matrices.inBands);
  relit.shape.stride = shade::rttStride(matrices.outBands);
  relit.shape.reflectance = glossy.lobe.reflectance;
  setLobe(relit, glossy, showing);
  if (Status s = multiply(relit, matrices.numbers); !s) return s.error();
  return relit;
}

void TransferOnGpu::setLobe(Relit& relit, const transfer::Glossy<Numbers>& glossy,
                            const shade::Showing& showing) {
  relit.factors = makeBuffer(shade::lobeFactors(glossy.matrices.outBands, glossy.lobe, showing));
  relit.light = showing.softLobes ? Relit::Light::SoftLobes : Relit::Light::Whole;
}

/// Lit once: turning the light costs less than making the matrices that would.
Relit TransferOnGpu::turned(const transfer::BiScale<Numbers>& biScale,
                            const std::vector<std::uint32_t>& receivers, int bands,
                            std::span<const float> factors) const {
  const int count = sh::coefficientCount(bands), stride = shade::rttStride(bands);
  const std::vector<float> light = shade::inRttLayout(
      shade::incidentLight(biScale, lightOnCpu_, bands, transfer::Kind::Unshadowed), bands);
  std::vector<float> product(receivers.size() * std::size_t(stride));
  for (std::size_t p = 0; p < receivers.size(); ++p)
    for (int i = 0; i < 3 * count; ++i)
      product[p * stride + i] = factors[i / 3] * light[receivers[p] * std::size_t(stride) + i];
  Relit relit;
  relit.shape.kind = ProductShape::Kind::Matrices;
  relit.shape.stride = stride;
  relit.product = makeBuffer(product);
  return relit;
}

Result<Relit> TransferOnGpu::incident(const transfer::BiScale<Numbers>& biScale,
                                      std::vector<std::uint32_t> receivers, int bands,
                                      std::span<const float> factors, transfer::Kind kind) {
  const transfer::Matrices<Numbers>* matrices = biScale.matrices.find(kind);
  if (!matrices && residence_ == Residence::Stream)
    return turned(biScale, receivers, bands, factors);
  // Relit again and again, rotations into the tangent frames stand for what nothing hides: once
  // made, a new light costs no CPU time.
  transfer::Matrices<Numbers> rotations;
  if (!matrices) {
    rotations = shade::rotationsIntoFrames(biScale, bands);
    matrices = &rotations;
  }
  Relit relit;
  relit.receivers = std::move(receivers);
  relit.shape.kind = ProductShape::Kind::Matrices;
  relit.shape.stride = shade::rttStride(bands);
  relit.shape.channels = matrices->channels;
  relit.shape.rows = relit.shape.columns = sh::coefficientCount(matrices->inBands);
  relit.shape.rowsUsed = std::min(relit.shape.rows, sh::coefficientCount(bands));
  relit.factors = makeBuffer(factors.size_bytes(), factors.data());
  if (Status s = multiply(relit, matrices->numbers); !s) return s.error();
  return relit;
}

}  // namespace lambent::render
