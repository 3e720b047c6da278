#include "lambent/render/gl_scene.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "lambent/radiometry/tone.h"
#include "lambent/render/shader_sources.h"

namespace lambent::render {
namespace {

using transport::Layout;

// Mirrors look the environment up in a picture of it. Twice the usual size of such pictures, so
// that resampling one costs no sharpness that a curved mirror could show.
constexpr int kEnvironmentWidth = 2048, kEnvironmentHeight = 1024;

// As in surface.frag.glsl.
enum class SurfaceKind { Vertices = 0, Texels = 1, Mirror = 2, Black = 3 };

struct GpuVertex {
  float position[3], u;
  float normal[3], v;
  float color[3], unused;
};

std::vector<GpuVertex> gatherVertices(const scene::Mesh& mesh, const TriangleBatch& batch) {
  std::vector<GpuVertex> vertices(batch.vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t from = batch.vertices[i];
    GpuVertex& to = vertices[i];
    const Vec2 uv = mesh.uvs.empty() ? Vec2(Vec2::Zero()) : mesh.uvs[from];
    for (int k = 0; k < 3; ++k) {
      to.position[k] = mesh.positions[from][k];
      to.normal[k] = mesh.normals[from][k];
      to.color[k] = mesh.colors.empty() ? 1.0f : mesh.colors[from][k];
    }
    to.u = uv.x();
    to.v = uv.y();
    to.unused = 0.0f;
  }
  return vertices;
}

int wrapRule(scene::Wrap wrap) {
  switch (wrap) {
    case scene::Wrap::ClampToEdge:
      return 1;
    case scene::Wrap::MirroredRepeat:
      return 2;
    case scene::Wrap::Repeat:
      break;
  }
  return 0;
}

}  // namespace

int GlScene::textureOf(std::uint32_t mesh) const {
  const int texture = materialOf(mesh).baseColorTexture;
  if (asset_->scene.meshes[mesh].uvs.empty() || texture < 0 ||
      std::size_t(texture) >= asset_->scene.textures.size())
    return -1;
  const scene::Texture& t = asset_->scene.textures[texture];
  const bool whole = t.width > 0 && t.height > 0 &&
                     t.rgba.size() >= 4 * std::size_t(t.width) * std::size_t(t.height);
  return whole ? texture : -1;
}

int GlScene::lobeBandsOf(std::uint32_t mesh) const {
  const encode::EncodedMesh& transfer = asset_->transfer.meshes[mesh];
  return transfer.layout != Layout::None && !transfer.matrices.empty() ? transfer.outBands : 0;
}

Status GlScene::addTexture(int index, const GlSceneOptions& options) {
  if (index < 0 || textures_.contains(index)) return Status::ok();
  const scene::Texture& from = asset_->scene.textures[index];
  if (from.width > options.largestTexture || from.height > options.largestTexture)
    return report::failed(fmt::format(
        "texture {} '{}' has {}×{} texels, but this OpenGL takes {} a side. Make it smaller, or "
        "make the picture on the CPU",
        index, from.name, from.width, from.height, options.largestTexture));
  Texture texture = makeTexture(GL_RGBA8UI, from.width, from.height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, from.width, from.height, GL_RGBA_INTEGER,
                      GL_UNSIGNED_BYTE, from.rgba.data());
  textures_.emplace(index, std::move(texture));
  return checkGl("uploading a base-colour texture");
}

Status GlScene::addProgram(int lobeBands) {
  if (programs_.contains(lobeBands)) return Status::ok();
  Program::Stage fragment{GL_FRAGMENT_SHADER, "surface.frag.glsl", {}};
  if (lobeBands > 0)
    fragment.parts = {fmt::format("#define LAMBENT_GLOSSY 1\n#define LAMBENT_BANDS {}", lobeBands),
                      std::string(shaderSource("sh.glsl"))};
  else
    fragment.parts = {"#define LAMBENT_GLOSSY 0"};
  fragment.parts.emplace_back(shaderSource("surface.frag.glsl"));
  const Program::Stage stages[] = {
      {GL_VERTEX_SHADER, "surface.vert.glsl", {std::string(shaderSource("surface.vert.glsl"))}},
      std::move(fragment)};
  Result<Program> program = Program::make(stages);
  if (!program) return program.error();
  programs_.emplace(lobeBands, std::move(*program));
  return Status::ok();
}

Status GlScene::addEnvironment(const light::Environment& environment,
                               const GlSceneOptions& options) {
  const int width = std::min(kEnvironmentWidth, options.largestTexture);
  const int height = std::min(kEnvironmentHeight, options.largestTexture);
  std::vector<float> texels(std::size_t(width) * height * 4, 1.0f);
  tbb::parallel_for(0, height, [&](int y) {
    const double elevation = kPi * (0.5 - (y + 0.5) / height);
    for (int x = 0; x < width; ++x) {
      const double azimuth = 2.0 * kPi * ((x + 0.5) / width - 0.5);
      const Vec3d direction(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                            std::cos(elevation) * std::sin(azimuth));
      const Rgb radiance = environment.radiance(direction.cast<float>());
      for (int c = 0; c < 3; ++c) texels[(std::size_t(y) * width + x) * 4 + c] = radiance[c];
    }
  });
  environment_ = makeTexture(GL_RGBA32F, width, height);
  glTextureSubImage2D(environment_.name(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT,
                      texels.data());
  return checkGl("uploading the environment");
}

Result<std::size_t> GlScene::addLit(const encode::EncodedMesh& mesh,
                                    const std::vector<std::uint32_t>& receivers,
                                    TransferOnGpu& transfer, const GlSceneOptions& options) {
  Lit lit;
  if (!mesh.vectors.empty()) {
    Result<Buffer> made = transfer.diffuse(mesh, receivers);
    if (!made) return made.error();
    lit.diffuse = std::move(*made);
  }
  if (!mesh.matrices.empty()) {
    Result<Buffer> made = transfer.lobe(mesh, receivers, options.lobeExponent);
    if (!made) return made.error();
    lit.lobe = std::move(*made);
  }
  lit_.push_back(std::move(lit));
  return lit_.size() - 1;
}

Status GlScene::addMesh(std::uint32_t index, TransferOnGpu& transfer,
                        const GlSceneOptions& options) {
  const scene::Mesh& mesh = asset_->scene.meshes[index];
  const encode::EncodedMesh& encoded = asset_->transfer.meshes[index];
  if (encoded.biScale && !materialOf(index).isMirror()) return patches_.add(index, transfer);
  const bool texels = encoded.layout == Layout::Texels && !materialOf(index).isMirror();
  const bool vertices = encoded.layout == Layout::Vertices && !materialOf(index).isMirror();
  const std::size_t perReceiver =
      std::max(3 * sizeof(float), encoded.matrices.empty() ? 0 : lobeBytes(encoded.outBands));
  const std::size_t perVertex =
      vertices ? std::max(sizeof(GpuVertex), perReceiver) : sizeof(GpuVertex);
  if (options.largestBlock < 4 * perVertex)
    return report::failed(fmt::format("this OpenGL's storage buffers of {} bytes are too small",
                                      options.largestBlock));
  if (Status s = addTexture(textureOf(index), options); !s) return s;
  if (Status s = addProgram(texels || vertices ? lobeBandsOf(index) : 0); !s) return s;

  std::vector<std::pair<RowBand, std::size_t>> litRows;
  if (texels) {
    const std::vector<RowBand> bands =
        splitRows(encoded.width, encoded.height, options.largestBlock / perReceiver);
    if (bands.empty())
      return report::failed(fmt::format(
          "mesh {} '{}': two rows of its {}×{} texels do not fit into this OpenGL's storage "
          "buffers of {} bytes. Make the picture on the CPU",
          index, mesh.name, encoded.width, encoded.height, options.largestBlock));
    for (const RowBand& band : bands) {
      std::vector<std::uint32_t> receivers(std::size_t(band.last - band.begin + 1) * encoded.width);
      std::iota(receivers.begin(), receivers.end(), std::uint32_t(band.begin) * encoded.width);
      const Result<std::size_t> lit = addLit(encoded, receivers, transfer, options);
      if (!lit) return lit.error();
      litRows.emplace_back(band, *lit);
    }
  }

  for (const TriangleBatch& batch :
       splitTriangles(mesh, options.largestBlock / perVertex,
                      options.largestBlock / (3 * sizeof(std::uint32_t)))) {
    Geometry geometry;
    geometry.vertices = makeBuffer(gatherVertices(mesh, batch));
    geometry.corners = makeBuffer(batch.corners);
    geometry.cornerCount = int(batch.corners.size());
    geometries_.push_back(std::move(geometry));
    if (Status s = checkGl("uploading a mesh"); !s) return s;

    Draw draw{index, geometries_.size() - 1, {}, {}};
    if (texels) {
      for (const auto& [band, lit] : litRows) {
        draw.rows = band;
        draw.lit = lit;
        draws_.push_back(draw);
      }
    } else {
      if (vertices) {
        const Result<std::size_t> lit = addLit(encoded, batch.vertices, transfer, options);
        if (!lit) return lit.error();
        draw.lit = *lit;
      }
      draws_.push_back(draw);
    }
  }
  return Status::ok();
}

Result<GlScene> GlScene::make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                              const light::Environment& environment,
                              const GlSceneOptions& options) {
  GlScene scene(asset, options);
  GLuint vertexArray = 0;
  glCreateVertexArrays(1, &vertexArray);
  scene.noAttributes_ = VertexArray(vertexArray);
  std::vector<float> table(256);
  for (int i = 0; i < 256; ++i) table[i] = radiometry::srgbDecode(float(i) / 255.0f);
  scene.srgbTable_ = makeBuffer(table);

  TransferOnGpu transfer(light, options.largestBlock);
  bool mirrors = false;
  for (std::uint32_t mesh = 0; mesh < asset.scene.meshes.size(); ++mesh) {
    if (Status s = scene.addMesh(mesh, transfer, options); !s) return s.error();
    mirrors = mirrors || scene.materialOf(mesh).isMirror();
  }
  if (mirrors)
    if (Status s = scene.addEnvironment(environment, options); !s) return s.error();
  return scene;
}

void GlScene::draw(const GlView& view) const {
  glBindVertexArray(noAttributes_.name());
  glBindTextureUnit(1, environment_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, srgbTable_.name());
  for (const Draw& draw : draws_) {
    const scene::Material& material = materialOf(draw.mesh);
    const encode::EncodedMesh& transfer = asset_->transfer.meshes[draw.mesh];
    const Geometry& geometry = geometries_[draw.geometry];
    const int texture = textureOf(draw.mesh);
    const SurfaceKind kind = material.isMirror()                   ? SurfaceKind::Mirror
                             : !draw.lit                           ? SurfaceKind::Black
                             : transfer.layout == Layout::Vertices ? SurfaceKind::Vertices
                                                                   : SurfaceKind::Texels;
    const Program& program = programs_.at(draw.lit ? lobeBandsOf(draw.mesh) : 0);
    program.use();
    program.setMatrix("clipFromWorld", view.clipFromWorld.data());
    program.set("eye", view.eye.x(), view.eye.y(), view.eye.z(), view.eye.w());
    program.set("kind", int(kind));
    program.set("hasDiffuse", int(draw.lit && !transfer.vectors.empty()));
    program.set("albedoOutside", int(transfer.albedo == transport::Albedo::BaseColor));
    program.set("hasTexture", int(texture >= 0));
    program.set("mirror", material.mirror.x(), material.mirror.y(), material.mirror.z());
    program.set("grid", transfer.width, transfer.height);
    program.set("rows", draw.rows.begin, draw.rows.end);
    if (texture >= 0) {
      const scene::Texture& from = asset_->scene.textures[texture];
      program.set("wrap", wrapRule(from.wrapU), wrapRule(from.wrapV));
    }
    glBindTextureUnit(0, texture >= 0 ? textures_.at(texture).name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, geometry.vertices.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, geometry.corners.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, draw.lit ? lit_[*draw.lit].diffuse.name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, draw.lit ? lit_[*draw.lit].lobe.name() : 0);
    glDrawArrays(GL_TRIANGLES, 0, geometry.cornerCount);
  }
  patches_.draw(view, noAttributes_.name());
}

}  // namespace lambent::render
