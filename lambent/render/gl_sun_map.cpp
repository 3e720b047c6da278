// The map covers what is seen alone: the box, seen from the Sun, of the view's frustum, where that
// is smaller than that of the scene. So a picture from nearby has finer shadows. Towards the Sun it
// reaches as far as the scene does: whatever stands there throws its shadow in.
#include "lambent/render/gl_sun_map.h"

#include <algorithm>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/math/directions.h"
#include "lambent/render/shader_sources.h"

namespace lambent::render {
namespace {

constexpr int kMapUnit = 4;      ///< of textures
constexpr float kBorder = 2.0f;  ///< texels around what is seen

Vec3 corner(const scene::Box& box, int k) {
  return Vec3((k & 1 ? box.upper : box.lower).x(), (k & 2 ? box.upper : box.lower).y(),
              (k & 4 ? box.upper : box.lower).z());
}

/// The corners of what is seen, turned into the Sun's frame. Empty: they are not finite.
scene::Box frustumBox(const Mat4& clipFromWorld, const Mat3& frameFromWorld) {
  const Eigen::Matrix4d worldFromClip = clipFromWorld.cast<double>().inverse();
  scene::Box box;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector4d p =
        worldFromClip * Eigen::Vector4d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1, 1);
    const Vec3 at = (p.head<3>() / p.w()).cast<float>();
    if (!at.allFinite()) return {};
    box.extend(frameFromWorld * at);
  }
  return box;
}

}  // namespace

Result<GlSunMap> GlSunMap::make(int largestTexture) {
  GlSunMap map;
  map.side_ = std::min(kSide, largestTexture);
  map.depth_ = makeTexture(GL_DEPTH_COMPONENT32F, map.side_, map.side_);
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  map.framebuffer_ = Framebuffer(name);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, map.depth_.name(), 0);
  glNamedFramebufferDrawBuffer(name, GL_NONE);
  if (Status s = checkGl("making a map of the Sun's shadows"); !s) return s.error();
  const GLenum complete = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
  if (complete != GL_FRAMEBUFFER_COMPLETE)
    return report::failed(fmt::format(
        "this OpenGL does not draw depths alone (status {:#x}): sharp shadows of the Sun need that",
        complete));
  const Program::Stage stages[] = {
      {GL_VERTEX_SHADER, "sun_map.vert.glsl", {std::string(shaderSource("sun_map.vert.glsl"))}},
      {GL_FRAGMENT_SHADER, "sun_map.frag.glsl", {std::string(shaderSource("sun_map.frag.glsl"))}}};
  Result<Program> program = Program::make(stages);
  if (!program) return program.error();
  map.program_ = std::move(*program);
  const Program::Stage gaps[] = {
      {GL_VERTEX_SHADER, "unlit.vert.glsl", {std::string(shaderSource("unlit.vert.glsl"))}},
      {GL_FRAGMENT_SHADER,
       "sun_map_cut.frag.glsl",
       {"#define LAMBENT_MAP 1", std::string(shaderSource("base_color.glsl")),
        std::string(shaderSource("coverage.glsl")),
        std::string(shaderSource("base_color_map.glsl")),
        std::string(shaderSource("sun_map_cut.frag.glsl"))}}};
  program = Program::make(gaps);
  if (!program) return program.error();
  map.gapsProgram_ = std::move(*program);
  return map;
}

void GlSunMap::begin(const light::SunPoint& sun, const Mat4* clipFromSeen,
                     const scene::Box& bounds) {
  frameFromWorld_ = math::worldFromTangent(sun.direction).transpose();
  scene::Box all;
  for (int k = 0; k < 8; ++k) all.extend(frameFromWorld_ * corner(bounds, k));
  scene::Box box = all;
  const scene::Box seen = clipFromSeen ? frustumBox(*clipFromSeen, frameFromWorld_) : scene::Box();
  if (!seen.empty()) {
    box.lower.head<2>() = box.lower.head<2>().cwiseMax(seen.lower.head<2>());
    box.upper.head<2>() = box.upper.head<2>().cwiseMin(seen.upper.head<2>());
    if (box.empty() || !(box.lower.y() <= box.upper.y())) box = all;  // nothing is seen
  }
  // Square texels: both sides are as long as the longer.
  const float least = 1e-6f * std::max(all.diagonal(), 1e-30f);
  const float side = std::max((box.upper - box.lower).head<2>().maxCoeff(), least);
  texel_ = side / (float(side_) - 2 * kBorder);
  const Vec2 first =
      box.center().head<2>() - Vec2::Constant(0.5f * texel_ * float(side_));  // of the map
  const float margin = 0.001f * all.diagonal() + least;
  const float nearest = all.upper.z() + margin;
  range_ = nearest - (all.lower.z() - margin);

  mapFromWorld_ = Mat4::Identity();
  mapFromWorld_.topLeftCorner<3, 3>() = frameFromWorld_;
  mapFromWorld_.topLeftCorner<2, 3>() /= texel_;
  mapFromWorld_.block<1, 3>(2, 0) /= -range_;
  mapFromWorld_.topRightCorner<3, 1>() =
      Vec3(-first.x() / texel_, -first.y() / texel_, nearest / range_);
  Mat4 clipFromMap = Mat4::Identity();
  clipFromMap(0, 0) = clipFromMap(1, 1) = 2.0f / float(side_);
  clipFromMap(2, 2) = 2.0f;
  clipFromMap.topRightCorner<3, 1>().setConstant(-1.0f);
  const Mat4 clipFromWorld = clipFromMap * mapFromWorld_;

  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, side_, side_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  const float far = 1.0f;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &far);
  program_.setMatrix("clipFromWorld", clipFromWorld.data());
  gapsProgram_.setMatrix("clipFromWorld", clipFromWorld.data());
  program_.use();
}

void GlSunMap::end() const {
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void GlSunMap::bind(const Program& program) const {
  program.setMatrix("sunMapFromWorld", mapFromWorld_.data());
  program.setMatrix("sunFrameFromWorld", frameFromWorld_);
  program.set("sunMapScales", float(side_), float(side_), texel_, range_);
  glBindTextureUnit(kMapUnit, depth_.name());
}

void GlSunMap::bindForShafts(const Program& program) const {
  program.setMatrix("shaftMapFromWorld", mapFromWorld_.data());
  glBindTextureUnit(kMapUnit, depth_.name());
}

}  // namespace lambent::render
