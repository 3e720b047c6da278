#include "lambent/render/gl_air.h"

#include <algorithm>
#include <cassert>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "lambent/render/shader_sources.h"
#include "lambent/sky/aerial_table.h"

namespace lambent::render {
namespace {

constexpr GLuint kAirUnit = 5;  ///< of textures, as in air_table.glsl
constexpr int kAirSources = 3;

int widthOf(const sky::AirTableSize& size) {
  return kAirSources * size.azimuths + 1;
}
int heightOf(const sky::AirTableSize& size) {
  return size.distances * size.elevations;
}

/// As phase_function.glsl takes them.
struct PhaseUniform {
  Eigen::Vector4d operator()(const media::Isotropic&) const { return {0, 0, 0, 0}; }
  Eigen::Vector4d operator()(const media::RayleighPhase&) const { return {1, 0, 0, 0}; }
  Eigen::Vector4d operator()(const media::HenyeyGreenstein& p) const { return {2, p.g, 0, 0}; }
  Eigen::Vector4d operator()(const media::CornetteShanks& p) const { return {3, p.g, 0, 0}; }
  Eigen::Vector4d operator()(const media::DoubleHenyeyGreenstein& p) const {
    return {4, p.f, p.g1, p.g2};
  }
  Eigen::Vector4d operator()(const media::Schlick& p) const { return {5, p.k, 0, 0}; }
};

}  // namespace

std::string airSource(bool shafts) {
  std::string text = fmt::format("#define LAMBENT_SHAFTS {:d}\n", shafts);
  for (const char* name : {"phase_function.glsl", "aerial_perspective.glsl"})
    text += shaderSource(name);
  if (shafts) text += shaderSource("shafts.glsl");
  return text.append(shaderSource("air_table.glsl"))
      .append(shaderSource("air_texels.glsl"))
      .append(shaderSource("air_behind.glsl"));
}

Result<GlAir> GlAir::make(const shade::Air& air, int largestTexture) {
  const sky::AirTable& table = *air.table;
  const int width = widthOf(table.size()), height = heightOf(table.size());
  if (width > largestTexture || height > largestTexture)
    return report::failed(fmt::format(
        "a table of the air of {}×{} texels, but this OpenGL takes {} a side. Make it smaller, or "
        "make the picture on the CPU",
        width, height, largestTexture));
  GlAir made(air);
  // Of four numbers: a texel is then fetched as one.
  made.table_ = makeTexture(GL_RGBA32F, width, height);
  made.upload();
  if (Status s = checkGl("uploading the air"); !s) return s.error();
  return made;
}

void GlAir::upload() const {
  const sky::AirTable& table = *air_.table;
  const int width = widthOf(table.size()), height = heightOf(table.size());
  const std::size_t along = std::size_t(table.size().azimuths), row = std::size_t(width) * 4;
  std::vector<float> texels(row * std::size_t(height));
  for (std::size_t y = 0; y < std::size_t(height); ++y) {
    float* to = texels.data() + y * row;
    for (const auto source : {sky::AirTable::Air, sky::AirTable::Aerosol, sky::AirTable::Multiple})
      for (std::size_t i = 0; i < along; ++i, to += 4)
        std::copy_n(table.source(source).data() + (y * along + i) * 3, 3, to);
    std::copy_n(table.extinction().data() + y * 3, 3, to);
  }
  glTextureSubImage2D(table_.name(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, texels.data());
}

bool GlAir::takes(const shade::Air& air) const {
  const sky::AirTableSize &mine = air_.table->size(), &other = air.table->size();
  return widthOf(mine) == widthOf(other) && heightOf(mine) == heightOf(other) &&
         air_.shafts.has_value() == air.shafts.has_value();
}

Status GlAir::set(const shade::Air& air) {
  const bool same = air_.table == air.table;
  air_ = air;
  if (same) return Status::ok();
  upload();
  return checkGl("uploading the air");
}

void GlAir::bind(const Program& program, const GlView& view, const GlSunMap* sunMap) const {
  bindTable(program);
  if (!air_.shafts) return;
  assert(view.shafts && sunMap);
  const sky::SamplingPlanes& planes = *view.shafts;
  program.set("shaftOrigin", 0.0f, 0.0f, 0.0f);  // places are counted from the eye
  program.set("shaftEye", view.eye.x(), view.eye.y(), view.eye.z());
  program.set("shaftAxis", float(planes.axis.x()), float(planes.axis.y()), float(planes.axis.z()));
  program.set("shaftDepths", float(planes.first), float(planes.last));
  program.set("shaftRate", float(planes.rate));
  program.set("shaftPlanes", planes.count, planes.samples);
  sunMap->bindForShafts(program);
}

void GlAir::bindTable(const Program& program) const {
  const sky::AirTable& table = *air_.table;
  const sky::AirTableAxes& axes = table.axes();
  program.set("airNodes", table.size().azimuths, table.size().elevations, table.size().distances);
  program.set("airShell", float(axes.radius), float(axes.height), float(axes.altitude),
              float(axes.horizon));
  program.set("airScale", table.scale());
  const Vec3 sun = table.sun().cast<float>();
  program.set("towardsSun", sun.x(), sun.y(), sun.z());
  const Eigen::Vector4f phase = std::visit(PhaseUniform{}, table.aerosolPhase()).cast<float>();
  program.set("aerosolPhase", phase[0], phase[1], phase[2], phase[3]);
  program.setMatrix("sunFromWorld", Mat3(air_.sunFromAsset.cast<float>()));
  program.set("metresPerUnit", float(air_.metresPerUnit));
  program.set("airGround", air_.ground.x(), air_.ground.y(), air_.ground.z());
  glBindTextureUnit(kAirUnit, table_.name());
}

}  // namespace lambent::render
