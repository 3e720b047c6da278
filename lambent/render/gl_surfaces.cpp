#include "lambent/render/gl_surfaces.h"

#include <algorithm>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "lambent/render/harmonics_source.h"
#include "lambent/render/shader_sources.h"
#include "lambent/scene/sheets.h"
#include "lambent/shade/rtt_pyramid.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/shade/unshadowed.h"

namespace lambent::render {
namespace {

struct GpuVertex {
  float position[3], u;
  float normal[3], v;
  float color[3], alpha;
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
    to.alpha = mesh.alphas.empty() ? 1.0f : mesh.alphas[from];
  }
  return vertices;
}

std::vector<Vec2> gatherTexelUvs(const scene::Mesh& mesh, const TriangleBatch& batch) {
  const std::vector<Vec2>& uvs = scene::texelUvsOf(mesh);
  std::vector<Vec2> gathered;
  gathered.reserve(batch.vertices.size());
  for (const std::uint32_t from : batch.vertices) gathered.push_back(uvs[from]);
  return gathered;
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

}  // namespace

/// Under a sharp Sun: M · L − D · S. Where D is M, that is M · (L − S).
Result<GlSurfaces::Lit> GlSurfaces::lightOf(std::uint32_t mesh, const shade::Showing& showing,
                                            const Response& response,
                                            const std::vector<std::uint32_t>& receivers,
                                            TransferOnGpu& transfer) const {
  Lit lit;
  lit.mesh = mesh;
  if (response.diffuse) {
    const transfer::EncodedMesh& encoded = asset_->transfer.meshes[mesh];
    const auto direct = sharpSun_ ? shade::kindWithoutBounces(encoded, showing) : std::nullopt;
    const bool apart = direct && *direct != shade::kindShown(encoded, showing);
    Result<Relit> made =
        transfer.diffuse(response.diffuse->vectors, receivers,
                         direct && !apart ? Relit::Light::WithoutSun : Relit::Light::Whole);
    if (!made) return made.error();
    lit.diffuse = std::move(*made);
    if (apart) {
      made = transfer.diffuse(surfaceOf(mesh)->responses.find(*direct)->diffuse->vectors, receivers,
                              Relit::Light::Sun);
      if (!made) return made.error();
      lit.sunShare = std::move(*made);
    }
  }
  if (response.glossy) {
    Result<Relit> made = transfer.lobe(*response.glossy, receivers, showing);
    if (!made) return made.error();
    lit.lobe = std::move(*made);
    setGain(lit, showing);
  }
  return lit;
}

const GlSurfaces::Response* GlSurfaces::partsOf(std::uint32_t mesh) const {
  const auto* surface = surfaceOf(mesh);
  const auto most = surface ? surface->responses.most() : std::nullopt;
  return most && !materialOf(mesh).isMirror() ? surface->responses.find(*most) : nullptr;
}

int GlSurfaces::lobeBandsOf(std::uint32_t mesh) const {
  const Response* parts = partsOf(mesh);
  return parts && parts->glossy ? parts->glossy->matrices.outBands : 0;
}

Status GlSurfaces::addProgram(const Shape& shape) {
  if (programs_.contains(shape)) return Status::ok();
  const auto [kind, lobeBands, gaps] = shape;
  const int groups = lobeBands > 0 ? shade::rttStride(lobeBands) / 4 : 0;
  // Position, normal, colour, texture coordinates and exit radiance are interpolated as well.
  GLint mostVaryings = 0;
  glGetIntegerv(GL_MAX_VARYING_COMPONENTS, &mostVaryings);
  const bool interpolated =
      kind == SurfaceKind::Vertices && groups > 0 && 4 * (groups + 4) <= mostVaryings;
  std::string defines = fmt::format(
      "#define LAMBENT_KIND {}\n#define LAMBENT_GROUPS {}\n#define LAMBENT_INTERPOLATED {:d}\n"
      "#define LAMBENT_LIGHT_PLACE int\n#define LAMBENT_MAP 1\n#define LAMBENT_AIR {:d}\n"
      "#define LAMBENT_ALPHA {:d}\n#define LAMBENT_EACH_GROUP(DO)",
      int(kind), groups, interpolated, kind == SurfaceKind::Mirror && air_ != nullptr, gaps);
  for (int i = 0; i < groups; ++i) defines += fmt::format(" DO({})", i);
  Program::Stage fragment{GL_FRAGMENT_SHADER, "surface.frag.glsl", {defines}};
  const auto include = [&](std::string_view name) {
    fragment.parts.emplace_back(shaderSource(name));
  };
  if (lobeBands > 0) {
    fragment.parts.push_back(harmonicsSource(lobeBands));
    for (const char* name : {"incident.glsl", "lobe.glsl"}) include(name);
  }
  if (kind == SurfaceKind::Mirror) {
    fragment.parts.push_back(environmentSource());
    fragment.parts.push_back(localCaptureSource());
    if (air_) fragment.parts.push_back(airSource(false));
  }
  if (kind == SurfaceKind::Vertices || kind == SurfaceKind::Texels) include("sun_shadow.glsl");
  include("base_color.glsl");
  if (gaps) include("coverage.glsl");
  for (const char* name : {"base_color_map.glsl", "shading_normal.glsl", "texel_receivers.glsl",
                           "corner_weights.glsl", "sample_alpha.glsl", "surface.frag.glsl"})
    include(name);
  const Program::Stage stages[] = {{GL_VERTEX_SHADER,
                                    "surface.vert.glsl",
                                    {defines, std::string(shaderSource("surface.vert.glsl"))}},
                                   std::move(fragment)};
  Result<Program> program = Program::make(stages);
  if (!program) return program.error();
  programs_.emplace(shape, std::move(*program));
  return Status::ok();
}

Status GlSurfaces::setAir(std::shared_ptr<const GlAir> air) {
  const bool same = bool(air_) == bool(air);
  air_.swap(air);
  if (same) return Status::ok();
  // Mirrors alone look through it where they are drawn.
  std::map<Shape, Program> before;
  for (auto& [shape, program] : programs_)
    if (shape.kind == SurfaceKind::Mirror) before.emplace(shape, std::move(program));
  for (const auto& [shape, program] : before) programs_.erase(shape);
  for (const auto& [shape, program] : before)
    if (Status s = addProgram(shape); !s) {
      for (auto& [old, kept] : before) programs_.insert_or_assign(old, std::move(kept));
      air_.swap(air);
      return s;
    }
  return Status::ok();
}

Status GlSurfaces::addTexels(std::uint32_t index, const transfer::AtTexels& grid,
                             const Response& response, std::size_t perReceiver,
                             const shade::Showing& showing, TransferOnGpu& transfer,
                             std::vector<std::pair<RowBand, std::size_t>>& litRows) {
  const std::vector<RowBand> bands =
      splitRows(grid.width, grid.height, largestBlock_ / perReceiver);
  if (bands.empty())
    return report::failed(fmt::format(
        "mesh {} '{}': two rows of its {}×{} texels do not fit into this OpenGL's storage "
        "buffers of {} bytes. Make the picture on the CPU",
        index, asset_->scene.meshes[index].name, grid.width, grid.height, largestBlock_));
  for (const RowBand& band : bands) {
    std::vector<std::uint32_t> receivers(std::size_t(band.last - band.begin + 1) * grid.width);
    std::iota(receivers.begin(), receivers.end(), std::uint32_t(band.begin) * grid.width);
    Result<Lit> lit = lightOf(index, showing, response, receivers, transfer);
    if (!lit) return lit.error();
    litRows.emplace_back(band, lit_.size());
    lit_.push_back(std::move(*lit));
  }
  return Status::ok();
}

Status GlSurfaces::add(std::uint32_t index, const shade::Showing& showing,
                       TransferOnGpu& transfer) {
  const scene::Mesh& mesh = asset_->scene.meshes[index];
  const bool mirror = materialOf(index).isMirror();
  hasMirrors_ = hasMirrors_ || mirror;
  const auto* surface = mirror ? nullptr : surfaceOf(index);
  const transfer::AtTexels* grid = surface ? surface->receivers->texels() : nullptr;
  const bool vertices = surface && !grid;
  const int lobeBands = lobeBandsOf(index);
  const std::size_t perReceiver =
      std::max(Relit::kBlendBytes, lobeBands > 0 ? lobeBytes(lobeBands) : 0);
  const std::size_t perVertex =
      vertices ? std::max(sizeof(GpuVertex), perReceiver) : sizeof(GpuVertex);
  if (largestBlock_ < 4 * perVertex)
    return report::failed(
        fmt::format("this OpenGL's storage buffers of {} bytes are too small", largestBlock_));
  const SurfaceKind kind = mirror     ? SurfaceKind::Mirror
                           : vertices ? SurfaceKind::Vertices
                           : grid     ? SurfaceKind::Texels
                                      : SurfaceKind::Black;
  if (Status s = addProgram(shapeOf(index, kind)); !s) return s;

  std::shared_ptr<const Response> response;
  if (surface)
    response = shade::responseUnder(*asset_, index,
                                    shade::kindShown(asset_->transfer.meshes[index], showing));
  std::vector<std::pair<RowBand, std::size_t>> litRows;
  if (grid)
    if (Status s = addTexels(index, *grid, *response, perReceiver, showing, transfer, litRows); !s)
      return s;

  const bool backs = scene::hasBacks(mesh);
  for (const TriangleBatch& batch :
       splitTriangles(mesh, largestBlock_ / perVertex, largestBlock_ / (4 * sizeof(float)))) {
    Geometry geometry;
    geometry.vertices = makeBuffer(gatherVertices(mesh, batch));
    geometry.corners = makeBuffer(batch.corners);
    geometry.normals = makeBuffer(gatherNormals(mesh, batch));
    if (grid) geometry.texelUvs = makeBuffer(gatherTexelUvs(mesh, batch));
    geometry.cornerCount = int(batch.corners.size());
    geometry.backs = backs;
    geometries_.push_back(std::move(geometry));
    if (Status s = checkGl("uploading a mesh"); !s) return s;

    Draw draw{index, kind, geometries_.size() - 1, {}, {}};
    if (grid) {
      for (const auto& [band, lit] : litRows) {
        draw.rows = band;
        draw.lit = lit;
        draws_.push_back(draw);
      }
      continue;
    }
    if (vertices) {
      Result<Lit> lit = lightOf(index, showing, *response, batch.vertices, transfer);
      if (!lit) return lit.error();
      draw.lit = lit_.size();
      lit_.push_back(std::move(*lit));
    }
    draws_.push_back(draw);
  }
  return Status::ok();
}

Result<std::vector<GlSurfaces::Lit>> GlSurfaces::lightUnder(const shade::Showing& showing,
                                                            TransferOnGpu& transfer) const {
  std::vector<Lit> result;
  std::shared_ptr<const Response> response;  // of the mesh that the last piece was of
  for (const Lit& old : lit_) {
    if (result.empty() || result.back().mesh != old.mesh)
      response = shade::responseUnder(*asset_, old.mesh,
                                      shade::kindShown(asset_->transfer.meshes[old.mesh], showing));
    const Relit& some = old.diffuse.product.name() ? old.diffuse : old.lobe;
    Result<Lit> made = lightOf(old.mesh, showing, *response, some.receivers, transfer);
    if (!made) return made.error();
    result.push_back(std::move(*made));
  }
  return result;
}

void GlSurfaces::setLight(std::vector<Lit> light) {
  for (std::size_t i = 0; i < light.size(); ++i) {
    light[i].diffuse.blend = std::move(lit_[i].diffuse.blend);
    light[i].lobe.blend = std::move(lit_[i].lobe.blend);
    light[i].sunShare.blend = std::move(lit_[i].sunShare.blend);
  }
  lit_ = std::move(light);
}

void GlSurfaces::setLobe(const shade::Showing& showing) {
  for (Lit& lit : lit_)
    if (lit.lobe.product.name()) {
      TransferOnGpu::setLobe(lit.lobe, *partsOf(lit.mesh)->glossy, showing);
      setGain(lit, showing);
    }
}

void GlSurfaces::setGain(Lit& lit, const shade::Showing& showing) const {
  const transfer::Glossy<transfer::Numbers>& glossy = *partsOf(lit.mesh)->glossy;
  lit.gain = shade::lobeGain(glossy.matrices.outBands, glossy.lobe, showing,
                             shade::kindShown(asset_->transfer.meshes[lit.mesh], showing));
}

/// Two sides of a sheet have the same depth: what faces away would be drawn over what is seen.
void GlSurfaces::cullBacks(bool cull) {
  glCullFace(GL_BACK);
  (cull ? glEnable : glDisable)(GL_CULL_FACE);
}

void GlSurfaces::draw(const GlView& view, const Around& around, const GlBaseColors& colors,
                      const shade::Showing& showing, GLuint vertexArray) const {
  for (const Draw& draw : draws_) {
    if (int(draw.mesh) == view.leftOut) continue;
    const scene::Material& material = materialOf(draw.mesh);
    const auto* surface = surfaceOf(draw.mesh);
    const transfer::AtTexels* grid = surface ? surface->receivers->texels() : nullptr;
    const Response* parts = partsOf(draw.mesh);
    const bool diffuse = parts && parts->diffuse;
    const Geometry& geometry = geometries_[draw.geometry];
    const Program& program = programs_.at(shapeOf(draw.mesh, draw.kind));
    program.use();
    program.setMatrix("clipFromWorld", view.clipFromWorld.data());
    program.set("eye", view.eye.x(), view.eye.y(), view.eye.z(), view.eye.w());
    program.set("hasDiffuse", int(draw.lit && diffuse));
    program.set("albedoOutside",
                int(diffuse && parts->diffuse->albedo == transfer::Albedo::BaseColor));
    program.set("mirror", material.mirror.x(), material.mirror.y(), material.mirror.z());
    program.set("grid", grid ? grid->width : 0, grid ? grid->height : 0);
    program.set("rows", draw.rows.begin, draw.rows.end);
    if (draw.lit) {
      const auto& [c0, c1, c2, c3] = lit_[*draw.lit].gain.coefficients;
      program.set("lobeGain", c0, c1, c2, c3);
    }
    const bool lit = draw.kind == SurfaceKind::Vertices || draw.kind == SurfaceKind::Texels;
    const auto direct = lit && view.sun
                            ? shade::kindWithoutBounces(asset_->transfer.meshes[draw.mesh], showing)
                            : std::nullopt;
    const bool sunlit = direct.has_value();
    if (lit) {
      program.set("hasSunShare",
                  int(sunlit && draw.lit && lit_[*draw.lit].sunShare.product.name()));
      program.set("sunlit", int(sunlit));
    }
    if (sunlit) {
      const Rgb sent = material.diffuse * view.sun->irradiance / float(kPi);
      program.set("sentFromSun", sent.x(), sent.y(), sent.z());
      program.set("sunDirection", view.sun->direction.x(), view.sun->direction.y(),
                  view.sun->direction.z());
      const bool hidden = around.sunMap && *direct != transfer::Kind::Unshadowed;
      program.set("sunCanHide", int(hidden));
      if (hidden) around.sunMap->bind(program);
    }
    colors.bind(program, draw.mesh);
    colors.bindCoverage(program, draw.mesh, view.sample);
    if (draw.kind == SurfaceKind::Mirror) {
      around.environment.bind(program, view.environmentFromWorld);
      if (around.mirrors)
        around.mirrors->bind(program, draw.mesh, view.sample);
      else
        GlMirrors::bindNone(program);
      if (air_) air_->bindTable(program);
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, geometry.vertices.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, geometry.corners.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2,
                     draw.lit ? lit_[*draw.lit].diffuse.product.name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3,
                     draw.lit ? lit_[*draw.lit].lobe.product.name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, geometry.normals.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6,
                     draw.lit ? lit_[*draw.lit].sunShare.product.name() : 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, geometry.texelUvs.name());
    glVertexArrayElementBuffer(vertexArray, geometry.corners.name());
    cullBacks(geometry.backs);
    glDrawElements(GL_TRIANGLES, geometry.cornerCount, GL_UNSIGNED_INT, nullptr);
  }
  cullBacks(false);
}

}  // namespace lambent::render
