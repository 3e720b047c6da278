// This work is based on:
// - sloan2003biscale: bi-scale radiance transfer, §5, with what hardware has learnt since: the
//   light at the vertices is made by a compute pass, and the texture of 4 + 1 dimensions is a
//   buffer that a fragment reads 16 bytes at a time.
//
// A buffer and not an array texture with the hardware's bilinear views: the 25 RGB coefficients of
// a view lie side by side (80 bytes in 8 bits), where an array's layers would touch 25 places far
// apart.

#include "lambent/render/gl_patches.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "lambent/render/batches.h"
#include "lambent/render/shader_sources.h"
#include "lambent/shade/lit_patch.h"
#include "lambent/transfer/encode.h"
#include "lambent/transfer/half.h"
#include "lambent/work/parallel_for.h"

namespace lambent::render {
namespace {

using transfer::EncodedRtt;
using transfer::Encoding;
using BiScale = transfer::BiScale<transfer::Numbers>;

constexpr int kMostLevels = 16;  // as in rtt_look_up.glsl

struct PatchVertex {
  float position[3], u;
  float normal[3], v;
  float tangent[3], alpha;
};

struct PatchTriangle {
  float normal[3], unused0;
  float alongX[3], unused1;
  float alongY[3], unused2;
};

std::vector<PatchVertex> gatherVertices(const scene::Mesh& mesh, const BiScale& biScale,
                                        const TriangleBatch& batch) {
  std::vector<PatchVertex> vertices;
  for (const std::uint32_t from : batch.vertices) {
    const Vec3 &p = mesh.positions[from], &n = mesh.normals[from], &t = biScale.tangents[from];
    const Vec2& uv = mesh.uvs[from];
    vertices.push_back({{p.x(), p.y(), p.z()},
                        uv.x(),
                        {n.x(), n.y(), n.z()},
                        uv.y(),
                        {t.x(), t.y(), t.z()},
                        mesh.alphas.empty() ? 1.0f : mesh.alphas[from]});
  }
  return vertices;
}

/// [vertex][3], or nothing.
std::vector<Rgb> gatherTints(const scene::Mesh& mesh, const TriangleBatch& batch) {
  std::vector<Rgb> tints;
  if (mesh.colors.empty()) return tints;
  for (const std::uint32_t from : batch.vertices) tints.push_back(mesh.colors[from]);
  return tints;
}

/// Of the triangles first … first + count − 1.
std::vector<PatchTriangle> gatherTriangles(const scene::Mesh& mesh, const BiScale& biScale,
                                           std::size_t first, std::size_t count) {
  std::vector<PatchTriangle> triangles;
  for (std::size_t t = first; t < first + count; ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    const Vec3 n =
        (mesh.positions[j] - mesh.positions[i]).cross(mesh.positions[k] - mesh.positions[i]);
    Vec3 alongX, alongY;
    if (biScale.patch.idMap()) {
      const scene::UvSteps steps = scene::uvSteps(mesh, std::uint32_t(t));
      alongX = steps.u, alongY = steps.v;
    } else {
      const shade::PatchGradient g = shade::patchGradient(biScale.patch, mesh, std::uint32_t(t));
      alongX = g.x, alongY = g.y;
    }
    triangles.push_back({{n.x(), n.y(), n.z()},
                         0.0f,
                         {alongX.x(), alongX.y(), alongX.z()},
                         0.0f,
                         {alongY.x(), alongY.y(), alongY.z()},
                         0.0f});
  }
  return triangles;
}

int groupsOf(int bands) {
  return shade::rttStride(bands) / 4;
}

/// Groups of four numbers in a texel of 16 bytes.
int groupsAFetch(Encoding encoding) {
  return encoding == Encoding::Snorm8 ? 4 : encoding == Encoding::Float16 ? 2 : 1;
}

/// Texels that hold the numbers of one position and view.
int fetchesOf(int bands, Encoding encoding) {
  const int each = groupsAFetch(encoding);
  return (groupsOf(bands) + each - 1) / each;
}

/// The loops of patch.vert.glsl and patch.frag.glsl, written out.
std::string unrolledDefines(int bands, Encoding encoding) {
  std::string each, response;
  for (int i = 0; i < groupsOf(bands); ++i) {
    if (i % groupsAFetch(encoding) == 0)
      response += fmt::format(" READ({})", i / groupsAFetch(encoding));
    response += fmt::format(" ADD({})", i);
    each += fmt::format(" DO({})", i);
  }
  return fmt::format("#define LAMBENT_EACH_GROUP(DO){}\n#define LAMBENT_RESPONSE{}", each,
                     response);
}

/// One position and view as the shader's texels hold it; `scales` are those of bytes.
void pack(const float* numbers, int stride, Encoding encoding, std::span<const float> scales,
          std::uint32_t* words) {
  switch (encoding) {
    case Encoding::Snorm8:
      for (int i = 0; i < stride; ++i) {
        const float scale = std::size_t(i / 3) < scales.size() ? scales[i / 3] : 0.0f;
        const float share = scale > 0.0f ? std::clamp(numbers[i] / scale, -1.0f, 1.0f) : 0.0f;
        words[i / 4] |= std::uint32_t(std::uint8_t(std::lround(127.0f * share))) << (i % 4 * 8);
      }
      break;
    case Encoding::Float16:
      for (int i = 0; i < stride; ++i)
        words[i / 2] |= std::uint32_t(transfer::halfFromFloat(numbers[i])) << (i % 2 * 16);
      break;
    case Encoding::Float32:
      for (int i = 0; i < stride; ++i) words[i] = std::bit_cast<std::uint32_t>(numbers[i]);
      break;
  }
}

}  // namespace

Result<GlPatches::Rtt> GlPatches::makeRtt(int index, bool filter) const {
  const EncodedRtt& from = asset_->transfer.rtts[std::size_t(index)];
  const Encoding encoding = from.values.encoding;
  const shade::RttPyramid pyramid =
      shade::makePyramid(transfer::decode(from), filter ? kMostLevels : 1);

  Rtt rtt;
  std::size_t positions = 0;
  for (const shade::RttLevel& level : pyramid.levels) {
    rtt.levels.push_back({level.width, level.height, int(positions)});
    positions += std::size_t(level.width) * level.height;
  }
  const std::size_t wordsEach = std::size_t(fetchesOf(from.bands, encoding)) * 4;
  const std::size_t texels = positions * pyramid.viewCount() * wordsEach / 4;
  GLint mostTexels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &mostTexels);
  if (texels > std::size_t(mostTexels))
    return report::failed(fmt::format(
        "radiance transfer texture {} '{}' of {}×{} positions, {}×{} views and {} bands needs {} "
        "MiB, but this OpenGL takes buffer textures of {}. Store it in 8 bits, or make the picture "
        "on the CPU",
        index, from.name, from.width, from.height, from.views, from.views, from.bands,
        texels * 16 >> 20, std::size_t(mostTexels) * 16 >> 20));

  rtt.scales.assign(std::size_t(from.bands) * from.bands, 1.0f);
  if (encoding == Encoding::Snorm8)
    for (std::size_t i = 0; i < rtt.scales.size(); ++i) {
      // The largest of the runs that make up the coefficient: one, as encode() writes them.
      const std::size_t plane = from.values.size() / rtt.scales.size();
      const std::size_t begin = i * plane / from.values.block;
      const std::size_t end = ((i + 1) * plane - 1) / from.values.block;
      rtt.scales[i] = *std::max_element(from.values.scales.begin() + std::ptrdiff_t(begin),
                                        from.values.scales.begin() + std::ptrdiff_t(end) + 1);
    }
  std::vector<std::uint32_t> words(texels * 4);
  const std::size_t perPosition = pyramid.viewCount() * std::size_t(pyramid.stride());
  for (std::size_t k = 0; k < pyramid.levels.size(); ++k) {
    const shade::RttLevel& level = pyramid.levels[k];
    work::parallelFor(level.width * level.height, [&](int place) {
      for (std::size_t view = 0; view < pyramid.viewCount(); ++view)
        pack(level.values.data() + place * perPosition + view * pyramid.stride(), pyramid.stride(),
             encoding, rtt.scales,
             words.data() +
                 ((std::size_t(rtt.levels[k].first) + place) * pyramid.viewCount() + view) *
                     wordsEach);
    });
  }
  if (encoding == Encoding::Snorm8)
    for (float& scale : rtt.scales) scale /= 127.0f;  // the shader takes bytes as integers
  rtt.numbers = makeBuffer(words);
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
  rtt.texture = Texture(name);
  glTextureBuffer(name, GL_RGBA32UI, rtt.numbers.name());
  if (filter && pyramid.relief != Vec2::Zero()) {
    std::vector<std::uint8_t> heights;
    for (const shade::RttLevel& level : pyramid.levels)
      heights.insert(heights.end(), level.heights.begin(), level.heights.end());
    rtt.relief = pyramid.relief;
    rtt.heightBytes = makeBuffer(heights);
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    rtt.heights = Texture(name);
    glTextureBuffer(name, GL_R8, rtt.heightBytes.name());
  }
  if (Status s = checkGl("uploading a radiance transfer texture"); !s) return s.error();
  return rtt;
}

Status GlPatches::addIdMap(std::uint32_t mesh) {
  const transfer::IdMap* map = biScaleOf(mesh).patch.idMap();
  if (!map) return Status::ok();
  if (map->width > options_.largestTexture || map->height > options_.largestTexture)
    return report::failed(fmt::format(
        "mesh {} '{}': an id map of {}×{} texels, but this OpenGL takes {} a side. Make it "
        "smaller, or make the picture on the CPU",
        mesh, asset_->scene.meshes[mesh].name, map->width, map->height, options_.largestTexture));
  Texture texture = makeTexture(GL_RG16UI, map->width, map->height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, map->width, map->height, GL_RG_INTEGER,
                      GL_UNSIGNED_SHORT, map->ids.data());
  idMaps_.emplace(mesh, std::move(texture));
  return checkGl("uploading an id map");
}

Status GlPatches::addProgram(const Shape& shape) {
  if (programs_.contains(shape)) return Status::ok();
  const auto [bands, encoding, filter, relief, gaps] = shape;
  // Place, normal, tangent, texture coordinates, tint and alpha are interpolated as well.
  GLint mostVaryings = 0;
  glGetIntegerv(GL_MAX_VARYING_COMPONENTS, &mostVaryings);
  const bool interpolated = 4 * (groupsOf(bands) + 4 + int(gaps)) <= mostVaryings;
  const std::string defines = fmt::format(
      "#define LAMBENT_GROUPS {}\n#define LAMBENT_INTERPOLATED {:d}\n#define LAMBENT_FILTER {:d}\n"
      "#define LAMBENT_RELIEF {:d}\n#define LAMBENT_ALPHA {:d}\n"
      "#define LAMBENT_LIGHT_PLACE int\n#define LAMBENT_RTT_PLACE int\n#define LAMBENT_ID_MAP 1\n"
      "{}\n{}\n",
      groupsOf(bands), interpolated, filter, relief, gaps, numbersDefine(encoding),
      unrolledDefines(bands, encoding));
  std::vector<std::string> fragment = {defines, "#define LAMBENT_MAP 1"};
  const auto include = [&](const char* name) { fragment.emplace_back(shaderSource(name)); };
  for (const char* name :
       {"incident.glsl", "corner_weights.glsl", "rtt_response.glsl", "view_square.glsl",
        "rtt_footprint.glsl", "rtt_look_up.glsl", "tangent_frame.glsl", "shading_normal.glsl",
        "patch_place.glsl", "sample_alpha.glsl", "base_color.glsl"})
    include(name);
  if (gaps) include("coverage.glsl");
  include("base_color_map.glsl");
  include("patch.frag.glsl");
  const Program::Stage stages[] = {{GL_VERTEX_SHADER,
                                    "patch.vert.glsl",
                                    {defines, std::string(shaderSource("patch.vert.glsl"))}},
                                   {GL_FRAGMENT_SHADER, "patch.frag.glsl", std::move(fragment)}};
  Result<Program> program = Program::make(stages);
  if (!program) return program.error();
  programs_.emplace(shape, std::move(*program));
  return Status::ok();
}

Status GlPatches::add(std::uint32_t index, TransferOnGpu& transfer) {
  const scene::Mesh& mesh = asset_->scene.meshes[index];
  const BiScale& biScale = biScaleOf(index);
  const EncodedRtt& rtt = rttOf(index);
  const bool filter = showing_.filter;
  const transfer::Kind kind = shade::kindShown(asset_->transfer.meshes[index], showing_);
  if (!rtts_.contains(biScale.patch.rtt)) {
    Result<Rtt> made = makeRtt(biScale.patch.rtt, filter);
    if (!made) return made.error();
    rtts_.emplace(biScale.patch.rtt, std::move(*made));
  }
  if (Status s = addIdMap(index); !s) return s;
  const bool relief = rtts_.at(biScale.patch.rtt).relief != Vec2::Zero();
  if (Status s = addProgram(shapeOf(index, relief, filter)); !s) return s;

  const std::size_t perVertex =
      std::max(sizeof(PatchVertex), shade::rttStride(rtt.bands) * sizeof(float));
  const std::size_t perTriangle = sizeof(PatchTriangle);
  if (options_.largestBlock < 4 * std::max(perVertex, perTriangle))
    return report::failed(fmt::format("this OpenGL's storage buffers of {} bytes are too small",
                                      options_.largestBlock));
  std::size_t first = 0;
  for (const TriangleBatch& batch : splitTriangles(mesh, options_.largestBlock / perVertex,
                                                   options_.largestBlock / perTriangle)) {
    const std::size_t count = batch.corners.size() / 3;
    Draw draw;
    draw.mesh = index;
    draw.vertices = makeBuffer(gatherVertices(mesh, biScale, batch));
    draw.triangles = makeBuffer(gatherTriangles(mesh, biScale, first, count));
    draw.corners = makeBuffer(batch.corners);
    if (!mesh.colors.empty()) draw.tints = makeBuffer(gatherTints(mesh, batch));
    draw.cornerCount = int(batch.corners.size());
    if (Status s = checkGl("uploading a mesh"); !s) return s;
    Result<Relit> light = transfer.incident(biScale, batch.vertices, rtt.bands,
                                            rtts_.at(biScale.patch.rtt).scales, kind);
    if (!light) return light.error();
    draw.light = std::move(*light);
    draws_.insert(mesh.layer ? draws_.begin() : draws_.end(), std::move(draw));
    first += count;
  }
  return Status::ok();
}

Status GlPatches::choose(const shade::Showing& showing) {
  if (showing.filter != showing_.filter) {
    std::map<int, Rtt> made;
    for (const auto& [index, rtt] : rtts_) {
      Result<Rtt> one = makeRtt(index, showing.filter);
      if (!one) return one.error();
      made.emplace(index, std::move(*one));
    }
    for (const Draw& draw : draws_) {
      const bool relief = made.at(biScaleOf(draw.mesh).patch.rtt).relief != Vec2::Zero();
      if (Status s = addProgram(shapeOf(draw.mesh, relief, showing.filter)); !s) return s;
    }
    rtts_ = std::move(made);
  }
  showing_ = showing;
  return Status::ok();
}

Result<std::vector<Relit>> GlPatches::lightUnder(const shade::Showing& showing,
                                                 TransferOnGpu& transfer) const {
  std::vector<Relit> result;
  for (const Draw& draw : draws_) {
    const BiScale& biScale = biScaleOf(draw.mesh);
    Result<Relit> light = transfer.incident(
        biScale, draw.light.receivers, rttOf(draw.mesh).bands, rtts_.at(biScale.patch.rtt).scales,
        shade::kindShown(asset_->transfer.meshes[draw.mesh], showing));
    if (!light) return light.error();
    result.push_back(std::move(*light));
  }
  return result;
}

void GlPatches::setLight(std::vector<Relit> light) {
  for (std::size_t i = 0; i < draws_.size(); ++i) {
    light[i].blend = std::move(draws_[i].light.blend);
    draws_[i].light = std::move(light[i]);
  }
}

void GlPatches::draw(const GlView& view, const GlBaseColors& colors, GLuint vertexArray) const {
  for (const Draw& draw : draws_) {
    const BiScale& biScale = biScaleOf(draw.mesh);
    const EncodedRtt& encoded = rttOf(draw.mesh);
    const Rtt& rtt = rtts_.at(biScale.patch.rtt);
    const bool relief = rtt.relief != Vec2::Zero();
    const Program& program = programs_.at(shapeOf(draw.mesh, relief, showing_.filter));
    program.use();
    program.setMatrix("clipFromWorld", view.clipFromWorld.data());
    program.set("eye", view.eye.x(), view.eye.y(), view.eye.z(), view.eye.w());
    program.set("pixelWidth", view.sampleWidth.perMetre, view.sampleWidth.constant);
    program.set("views", encoded.views);
    program.set("viewDependent", int(showing_.viewDependent));
    program.set("hasIdMap", int(biScale.patch.idMap() != nullptr));
    program.set("tiles", biScale.patch.tiles().x(), biScale.patch.tiles().y());
    program.set("periodsPerMetre", 1.0f / (encoded.size.x() * biScale.patch.scale),
                1.0f / (encoded.size.y() * biScale.patch.scale));
    const Rgb seams = view.seams.value_or(Rgb::Zero());
    program.set("seams", seams[0], seams[1], seams[2], view.seams ? 1.0f : 0.0f);
    program.set("levelCount", int(rtt.levels.size()));
    for (std::size_t k = 0; k < rtt.levels.size(); ++k)
      program.set(fmt::format("levels[{}]", k).c_str(), rtt.levels[k].width, rtt.levels[k].height,
                  rtt.levels[k].first, 0);
    if (relief) {
      program.set("relief", rtt.relief.x(), rtt.relief.y());
      glBindTextureUnit(2, rtt.heights.name());
    }
    colors.bind(program, draw.mesh);
    if (colors.hasGaps(draw.mesh)) colors.bindCoverage(program, draw.mesh, view.sample);
    program.set("hasTints", int(draw.tints.name() != 0));
    glBindTextureUnit(3, rtt.texture.name());
    glBindTextureUnit(1, biScale.patch.idMap() ? idMaps_.at(draw.mesh).name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, draw.vertices.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, draw.light.product.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, draw.triangles.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, draw.corners.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, draw.tints.name());
    glVertexArrayElementBuffer(vertexArray, draw.corners.name());
    glDrawElements(GL_TRIANGLES, draw.cornerCount, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace lambent::render
