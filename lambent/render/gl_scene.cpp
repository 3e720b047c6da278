#include "lambent/render/gl_scene.h"

#include <algorithm>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "lambent/radiometry/srgb.h"
#include "lambent/render/harmonics_source.h"
#include "lambent/render/shader_sources.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/shade/rtt_pyramid.h"

namespace lambent::render {
namespace {

using transport::Layout;

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

/// Of the batch's triangles by their windings, not unit: four floats each.
std::vector<float> gatherNormals(const scene::Mesh& mesh, const TriangleBatch& batch) {
  std::vector<float> normals;
  normals.reserve(batch.corners.size() / 3 * 4);
  for (std::size_t i = 0; i < batch.corners.size(); i += 3) {
    const auto corner = [&](std::size_t k) -> const Vec3& {
      return mesh.positions[batch.vertices[batch.corners[i + k]]];
    };
    const Vec3 n = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    normals.insert(normals.end(), {n.x(), n.y(), n.z(), 0.0f});
  }
  return normals;
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
  if (materialOf(mesh).isMirror()) return 0;
  return transfer.layout != Layout::None && !transfer.matrices.empty() ? transfer.outBands : 0;
}

Status GlScene::addTexture(int index) {
  if (index < 0 || textures_.contains(index)) return Status::ok();
  const scene::Texture& from = asset_->scene.textures[index];
  if (from.width > options_.largestTexture || from.height > options_.largestTexture)
    return report::failed(fmt::format(
        "texture {} '{}' has {}×{} texels, but this OpenGL takes {} a side. Make it smaller, or "
        "make the picture on the CPU",
        index, from.name, from.width, from.height, options_.largestTexture));
  Texture texture = makeTexture(GL_RGBA8UI, from.width, from.height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, from.width, from.height, GL_RGBA_INTEGER,
                      GL_UNSIGNED_BYTE, from.rgba.data());
  textures_.emplace(index, std::move(texture));
  return checkGl("uploading a base-colour texture");
}

Status GlScene::addProgram(SurfaceKind kind, int lobeBands) {
  if (programs_.contains({kind, lobeBands})) return Status::ok();
  const int groups = lobeBands > 0 ? shade::rttStride(lobeBands) / 4 : 0;
  // Position, normal, colour, texture coordinates and exit radiance are interpolated as well.
  GLint mostVaryings = 0;
  glGetIntegerv(GL_MAX_VARYING_COMPONENTS, &mostVaryings);
  const bool interpolated =
      kind == SurfaceKind::Vertices && groups > 0 && 4 * (groups + 4) <= mostVaryings;
  std::string defines = fmt::format(
      "#define LAMBENT_KIND {}\n#define LAMBENT_GROUPS {}\n#define LAMBENT_INTERPOLATED {:d}\n"
      "#define LAMBENT_LIGHT_PLACE int\n#define LAMBENT_MAP 1\n#define LAMBENT_EACH_GROUP(DO)",
      int(kind), groups, interpolated);
  for (int i = 0; i < groups; ++i) defines += fmt::format(" DO({})", i);
  Program::Stage fragment{GL_FRAGMENT_SHADER, "surface.frag.glsl", {defines}};
  const auto include = [&](std::string_view name) {
    fragment.parts.emplace_back(shaderSource(name));
  };
  if (lobeBands > 0) {
    fragment.parts.push_back(harmonicsSource(lobeBands));
    for (const char* name : {"incident.glsl", "lobe.glsl"}) include(name);
  }
  if (kind == SurfaceKind::Mirror) fragment.parts.push_back(environmentSource());
  for (const char* name : {"base_color.glsl", "base_color_map.glsl", "shading_normal.glsl",
                           "texel_receivers.glsl", "corner_weights.glsl", "surface.frag.glsl"})
    include(name);
  const Program::Stage stages[] = {{GL_VERTEX_SHADER,
                                    "surface.vert.glsl",
                                    {defines, std::string(shaderSource("surface.vert.glsl"))}},
                                   std::move(fragment)};
  Result<Program> program = Program::make(stages);
  if (!program) return program.error();
  programs_.emplace(std::pair(kind, lobeBands), std::move(*program));
  return Status::ok();
}

Result<GlScene::Lit> GlScene::makeLit(std::uint32_t index, const encode::EncodedMesh& shown,
                                      const std::vector<std::uint32_t>& receivers,
                                      std::optional<float> lobeExponent) {
  Lit lit;
  lit.mesh = index;
  if (!shown.vectors.empty()) {
    Result<Relit> made = transfer_.diffuse(shown, receivers);
    if (!made) return made.error();
    lit.diffuse = std::move(*made);
  }
  if (!shown.matrices.empty()) {
    Result<Relit> made = transfer_.lobe(shown, receivers, lobeExponent);
    if (!made) return made.error();
    lit.lobe = std::move(*made);
  }
  return lit;
}

Status GlScene::addMesh(std::uint32_t index, const encode::EncodedMesh& shown,
                        std::optional<shade::MacroTransport> macro) {
  const scene::Mesh& mesh = asset_->scene.meshes[index];
  if (Status s = addTexture(textureOf(index)); !s) return s;
  if (isPatched(index)) return patches_.add(index, shown, macro, transfer_);
  const bool mirror = materialOf(index).isMirror();
  const bool texels = shown.layout == Layout::Texels && !mirror;
  const bool vertices = shown.layout == Layout::Vertices && !mirror;
  const std::size_t perReceiver =
      std::max(Relit::kBlendBytes, shown.matrices.empty() ? 0 : lobeBytes(shown.outBands));
  const std::size_t perVertex =
      vertices ? std::max(sizeof(GpuVertex), perReceiver) : sizeof(GpuVertex);
  const std::size_t largestBlock = options_.largestBlock;
  if (largestBlock < 4 * perVertex)
    return report::failed(
        fmt::format("this OpenGL's storage buffers of {} bytes are too small", largestBlock));
  const SurfaceKind kind = mirror     ? SurfaceKind::Mirror
                           : vertices ? SurfaceKind::Vertices
                           : texels   ? SurfaceKind::Texels
                                      : SurfaceKind::Black;
  if (Status s = addProgram(kind, lobeBandsOf(index)); !s) return s;

  std::vector<std::pair<RowBand, std::size_t>> litRows;
  if (texels) {
    const std::vector<RowBand> bands =
        splitRows(shown.width, shown.height, largestBlock / perReceiver);
    if (bands.empty())
      return report::failed(fmt::format(
          "mesh {} '{}': two rows of its {}×{} texels do not fit into this OpenGL's storage "
          "buffers of {} bytes. Make the picture on the CPU",
          index, mesh.name, shown.width, shown.height, largestBlock));
    for (const RowBand& band : bands) {
      std::vector<std::uint32_t> receivers(std::size_t(band.last - band.begin + 1) * shown.width);
      std::iota(receivers.begin(), receivers.end(), std::uint32_t(band.begin) * shown.width);
      Result<Lit> lit = makeLit(index, shown, receivers, options_.lobeExponent);
      if (!lit) return lit.error();
      litRows.emplace_back(band, lit_.size());
      lit_.push_back(std::move(*lit));
    }
  }

  for (const TriangleBatch& batch :
       splitTriangles(mesh, largestBlock / perVertex, largestBlock / (4 * sizeof(float)))) {
    Geometry geometry;
    geometry.vertices = makeBuffer(gatherVertices(mesh, batch));
    geometry.corners = makeBuffer(batch.corners);
    geometry.normals = makeBuffer(gatherNormals(mesh, batch));
    geometry.cornerCount = int(batch.corners.size());
    geometries_.push_back(std::move(geometry));
    if (Status s = checkGl("uploading a mesh"); !s) return s;

    Draw draw{index, kind, geometries_.size() - 1, {}, {}};
    if (texels) {
      for (const auto& [band, lit] : litRows) {
        draw.rows = band;
        draw.lit = lit;
        draws_.push_back(draw);
      }
    } else {
      if (vertices) {
        Result<Lit> lit = makeLit(index, shown, batch.vertices, options_.lobeExponent);
        if (!lit) return lit.error();
        draw.lit = lit_.size();
        lit_.push_back(std::move(*lit));
      }
      draws_.push_back(draw);
    }
  }
  return Status::ok();
}

/// Where nothing is between the light and meso-structure that is relit again and again, rotations
/// into the tangent frames stand for macro transport: once made, a new light costs no CPU time.
shade::ShownTransfer GlScene::shownTransfer(std::uint32_t mesh, shade::TransferChoice transfer,
                                            std::optional<shade::MacroTransport>& macro) const {
  using shade::MacroTransport, shade::TransferChoice;
  if (keeps_ && isPatched(mesh)) {
    const encode::EncodedBiScale& biScale = *asset_->transfer.meshes[mesh].biScale;
    const bool holdsNone = shade::bestOf(biScale) == MacroTransport::Off;
    if (macro == MacroTransport::Off || (!macro && holdsNone)) {
      macro.reset();
      transfer = TransferChoice::Unshadowed;
    }
  }
  return shade::ShownTransfer(*asset_, mesh, transfer, macro);
}

Status GlScene::addAll() {
  GLuint vertexArray = 0;
  glCreateVertexArrays(1, &vertexArray);
  noAttributes_ = VertexArray(vertexArray);
  std::vector<float> table(256);
  for (int i = 0; i < 256; ++i) table[i] = radiometry::srgbDecode(float(i) / 255.0f);
  srgbTable_ = makeBuffer(table);
  for (std::uint32_t mesh = 0; mesh < asset_->scene.meshes.size(); ++mesh) {
    std::optional<shade::MacroTransport> macro = options_.biScale.macro;
    const shade::ShownTransfer shown = shownTransfer(mesh, options_.transfer, macro);
    if (Status s = addMesh(mesh, shown.get(), macro); !s) return s;
    hasMirrors_ = hasMirrors_ || materialOf(mesh).isMirror();
  }
  return Status::ok();
}

Result<GlScene> GlScene::make(const asset::Asset& asset, const GlSceneOptions& options) {
  GlScene scene(asset, options, TransferOnGpu::Residence::Keep);
  const Program::Stage stages[] = {
      {GL_VERTEX_SHADER, "unlit.vert.glsl", {std::string(shaderSource("unlit.vert.glsl"))}},
      {GL_FRAGMENT_SHADER,
       "unlit.frag.glsl",
       {"#define LAMBENT_MAP 1", std::string(shaderSource("base_color.glsl")),
        std::string(shaderSource("base_color_map.glsl")),
        std::string(shaderSource("unlit.frag.glsl"))}}};
  Result<Program> unlit = Program::make(stages);
  if (!unlit) return unlit.error();
  scene.unlit_ = std::move(*unlit);
  if (Status s = scene.addAll(); !s) return s.error();
  return scene;
}

Result<GlScene> GlScene::makeLit(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                 const GlSceneOptions& options) {
  GlScene scene(asset, options, TransferOnGpu::Residence::Stream);
  scene.transfer_.setLight(light);
  if (Status s = scene.addAll(); !s) return s.error();
  return scene;
}

template <class Each>
void GlScene::forEachRelit(Each each) {
  for (Lit& lit : lit_)
    for (Relit* relit : {&lit.diffuse, &lit.lobe})
      if (relit->product.name()) each(lit.mesh, *relit);
  patches_.forEach(each);
}

Status GlScene::retransfer(shade::TransferChoice transfer, std::optional<float> lobeExponent,
                           std::optional<shade::MacroTransport> macro) {
  std::vector<Lit> lit;
  std::map<std::uint32_t, std::vector<Relit>> patched;
  for (std::uint32_t mesh = 0; mesh < asset_->scene.meshes.size(); ++mesh) {
    std::optional<shade::MacroTransport> meshMacro = macro;
    const shade::ShownTransfer shown = shownTransfer(mesh, transfer, meshMacro);
    if (isPatched(mesh)) {
      auto light = patches_.lightUnder(mesh, shown.get(), meshMacro, transfer_);
      if (!light) return light.error();
      patched.emplace(mesh, std::move(*light));
    }
    // As addMesh put them: mesh after mesh.
    while (lit.size() < lit_.size() && lit_[lit.size()].mesh == mesh) {
      const Lit& old = lit_[lit.size()];
      const Relit& some = old.diffuse.product.name() ? old.diffuse : old.lobe;
      Result<Lit> made = makeLit(mesh, shown.get(), some.receivers, lobeExponent);
      if (!made) return made.error();
      lit.push_back(std::move(*made));
    }
  }
  for (std::size_t i = 0; i < lit.size(); ++i) {
    lit[i].diffuse.blend = std::move(lit_[i].diffuse.blend);
    lit[i].lobe.blend = std::move(lit_[i].lobe.blend);
  }
  lit_ = std::move(lit);
  for (auto& [mesh, light] : patched) patches_.setLight(mesh, std::move(light));
  return Status::ok();
}

Status GlScene::choose(shade::TransferChoice transfer, std::optional<float> lobeExponent,
                       const shade::BiScaleOptions& biScale) {
  if (Status s = patches_.choose(biScale); !s) return s;
  if (transfer != options_.transfer || biScale.macro != options_.biScale.macro) {
    if (Status s = retransfer(transfer, lobeExponent, biScale.macro); !s) {
      // The filter and what it needs were there before.
      (void)patches_.choose(options_.biScale);
      return s;
    }
  } else if (lobeExponent != options_.lobeExponent) {
    for (Lit& lit : lit_)
      if (lit.lobe.product.name())
        TransferOnGpu::setLobe(lit.lobe, asset_->transfer.meshes[lit.mesh], lobeExponent);
  }
  options_.transfer = transfer;
  options_.lobeExponent = lobeExponent;
  options_.biScale = biScale;
  return Status::ok();
}

Status GlScene::setLightField(const capture::Blending& blending, GLuint lights, int bands) {
  Status status = Status::ok();
  forEachRelit([&](std::uint32_t mesh, Relit& relit) {
    if (status) status = TransferOnGpu::setBlend(relit, blending.meshes[mesh]);
  });
  if (!status) return status;
  return transfer_.setField(lights, bands);
}

Status GlScene::relight() {
  Status status = Status::ok();
  // What draws still read, or what a pass of the caller's has just written.
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  forEachRelit([&](std::uint32_t, Relit& relit) {
    if (status) status = transfer_.relight(relit);
  });
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  if (!status) return status;
  return checkGl("applying transfer to the light");
}

void GlScene::bindTexture(const Program& program, std::uint32_t mesh) const {
  const int texture = textureOf(mesh);
  program.set("hasTexture", int(texture >= 0));
  if (texture >= 0) {
    const scene::Texture& from = asset_->scene.textures[texture];
    program.set("baseColorWrap", wrapRule(from.wrapU), wrapRule(from.wrapV));
  }
  glBindTextureUnit(0, texture >= 0 ? textures_.at(texture).name() : 0);
}

void GlScene::draw(const GlView& view, const GlEnvironment& environment) const {
  glFrontFace(view.mirrored ? GL_CW : GL_CCW);
  glBindVertexArray(noAttributes_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, srgbTable_.name());
  if (view.unlit) {
    drawUnlit(view);
    return;
  }
  for (const Draw& draw : draws_) {
    const scene::Material& material = materialOf(draw.mesh);
    const encode::EncodedMesh& transfer = asset_->transfer.meshes[draw.mesh];
    const Geometry& geometry = geometries_[draw.geometry];
    const Program& program = programs_.at({draw.kind, lobeBandsOf(draw.mesh)});
    program.use();
    program.setMatrix("clipFromWorld", view.clipFromWorld.data());
    program.set("eye", view.eye.x(), view.eye.y(), view.eye.z(), view.eye.w());
    program.set("hasDiffuse", int(draw.lit && !transfer.vectors.empty()));
    program.set("albedoOutside", int(transfer.albedo == transport::Albedo::BaseColor));
    program.set("mirror", material.mirror.x(), material.mirror.y(), material.mirror.z());
    program.set("grid", transfer.width, transfer.height);
    program.set("rows", draw.rows.begin, draw.rows.end);
    bindTexture(program, draw.mesh);
    if (draw.kind == SurfaceKind::Mirror) environment.bind(program, view.environmentFromWorld);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, geometry.vertices.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, geometry.corners.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2,
                     draw.lit ? lit_[*draw.lit].diffuse.product.name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3,
                     draw.lit ? lit_[*draw.lit].lobe.product.name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, geometry.normals.name());
    glVertexArrayElementBuffer(noAttributes_.name(), geometry.corners.name());
    glDrawElements(GL_TRIANGLES, geometry.cornerCount, GL_UNSIGNED_INT, nullptr);
  }
  patches_.draw(view, noAttributes_.name());
}

void GlScene::drawUnlit(const GlView& view) const {
  unlit_.use();
  unlit_.setMatrix("clipFromWorld", view.clipFromWorld.data());
  const auto drawPiece = [&](std::uint32_t mesh, GLuint vertices, GLuint corners, int count) {
    const scene::Material& material = materialOf(mesh);
    const Rgb reflectance =
        material.isMirror() ? material.mirror : Rgb(material.diffuse + material.glossy);
    unlit_.set("reflectance", reflectance.x(), reflectance.y(), reflectance.z());
    unlit_.set("hasColor", int(!asset_->scene.meshes[mesh].colors.empty() && !isPatched(mesh)));
    bindTexture(unlit_, mesh);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, vertices);
    glVertexArrayElementBuffer(noAttributes_.name(), corners);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
  };
  for (const Draw& draw : draws_) {
    if (draw.rows.begin > 0) continue;  // the first band of texels draws the whole of the piece
    const Geometry& geometry = geometries_[draw.geometry];
    drawPiece(draw.mesh, geometry.vertices.name(), geometry.corners.name(), geometry.cornerCount);
  }
  patches_.drawUnlit(drawPiece);
}

}  // namespace lambent::render
