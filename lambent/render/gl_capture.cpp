// Steps 1 and 2 of run-time rendering (sloan2002precomputed §6), but for the blending: cube maps of
// what is around the object, and their projection to harmonics. The cubes stand in the asset's
// frame, so that the coefficients need no rotation.
//
// Where we deviate:
// - Nothing is read back: the sums that the paper had to do in software are a compute shader.
// - The distant environment is not drawn into the pictures. It comes as harmonics, so its
//   coefficients are known exactly, whereas small texels would alias a sharp sun and, of smooth
//   light, keep an error of projection. Drawn is the difference that bodies make: their radiance
//   less the environment's in their direction, evaluated per texel, which is exact for band-limited
//   light.
// - All faces are tiles of one picture, and a body is drawn into those that see it by one call with
//   an instance for each: no layered target, which would need a geometry shader or an extension.
#include "lambent/render/gl_capture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <Eigen/LU>

#include "lambent/render/gl_bodies.h"
#include "lambent/render/gl_state.h"
#include "lambent/render/shader_sources.h"
#include "lambent/sh/rotation.h"

namespace lambent::render {
namespace {

Mat4 inverseOfRigid(const Mat4& m) {
  Mat4 result = Mat4::Identity();
  const Mat3 back = m.topLeftCorner<3, 3>().transpose();
  result.topLeftCorner<3, 3>() = back;
  result.topRightCorner<3, 1>() = -(back * Vec3(m.topRightCorner<3, 1>()));
  return result;
}

Vec3 moved(const Mat4& rigid, const Vec3& point) {
  return rigid.topLeftCorner<3, 3>() * point + Vec3(rigid.topRightCorner<3, 1>());
}

std::vector<float> interleaved(const sh::RgbCoefficients& light) {
  std::vector<float> values;
  for (int i = 0; i < sh::coefficientCount(light.bands); ++i)
    for (int c = 0; c < 3; ++c) values.push_back(light.channel(c)[std::size_t(i)]);
  return values;
}

Result<Program> computeProgram(const char* name) {
  const Program::Stage stage{GL_COMPUTE_SHADER, name, {std::string(shaderSource(name))}};
  return Program::make({&stage, 1});
}

}  // namespace

struct LightCapture::Impl {
  CaptureOptions options;
  GlBodies bodies;
  std::vector<Vec3> points;
  int tilesAcross = 0, tilesUp = 0;
  Buffer pointBuffer, seen, weights, environment, light;
  Texture color, depth;
  Framebuffer framebuffer;
  Program reduce, view;
  std::map<int, Program> faces;  ///< by bands of the environment

  Status makeTarget();
  Result<const Program*> facesProgram(int environmentBands);
  void appendTilesThatSee(const Vec3& center, float radius, std::vector<std::int32_t>& tiles) const;
  void drawFaces(const Program& program, double time, const Mat4& assetFromWorld) const;
  void project(int environmentBands) const;
};

LightCapture::LightCapture(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LightCapture::LightCapture(LightCapture&&) noexcept = default;
LightCapture& LightCapture::operator=(LightCapture&&) noexcept = default;
LightCapture::~LightCapture() = default;

Result<LightCapture> LightCapture::make(const capture::MovingScene& scene,
                                        std::span<const Vec3> points,
                                        const CaptureOptions& options) {
  assert(!points.empty() && options.bands >= 1 && options.bands <= sh::kMaxBands);
  assert(options.cube.size >= 1 && options.cube.supersampling >= 1);
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->points.assign(points.begin(), points.end());
  if (Status s = impl->makeTarget(); !s) return s.error();

  Result<GlBodies> bodies = GlBodies::make(scene);
  if (!bodies) return bodies.error();
  impl->bodies = std::move(*bodies);
  Result<Program> reduce = computeProgram("capture_reduce.comp.glsl");
  if (!reduce) return reduce.error();
  impl->reduce = std::move(*reduce);
  const Program::Stage view[] = {{GL_VERTEX_SHADER,
                                  "capture_view.vert.glsl",
                                  {std::string(shaderSource("capture_view.vert.glsl"))}},
                                 {GL_FRAGMENT_SHADER,
                                  "capture_view.frag.glsl",
                                  {std::string(shaderSource("capture_view.frag.glsl"))}}};
  Result<Program> viewProgram = Program::make(view);
  if (!viewProgram) return viewProgram.error();
  impl->view = std::move(*viewProgram);

  std::vector<float> padded;
  for (const Vec3& p : points) padded.insert(padded.end(), {p.x(), p.y(), p.z(), 1.0f});
  impl->pointBuffer = makeBuffer(padded);
  const std::vector<double> weights = capture::cubeWeights(options.cube, options.bands);
  impl->weights = makeBuffer(std::vector<float>(weights.begin(), weights.end()));
  impl->seen = makeChangingBuffer(std::max<std::size_t>(impl->bodies.all().size(), 1) * 6 *
                                  points.size() * sizeof(std::int32_t));
  impl->environment =
      makeChangingBuffer(3 * std::size_t(sh::coefficientCount(sh::kMaxBands)) * sizeof(float));
  impl->light = makeBuffer(points.size() * 3 * std::size_t(sh::coefficientCount(options.bands)) *
                           sizeof(float));
  if (Status s = checkGl("making the buffers of captured light"); !s) return s.error();
  return LightCapture(std::move(impl));
}

// A nearly square sheet of cubes, each six tiles in a row.
Status LightCapture::Impl::makeTarget() {
  const int samples = int(points.size()), side = options.cube.drawn();
  const int cubesAcross = std::max(1, int(std::lround(std::sqrt(samples / 6.0))));
  tilesAcross = 6 * cubesAcross;
  tilesUp = (samples + cubesAcross - 1) / cubesAcross;
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(tilesAcross, tilesUp) > largest / side)
    return report::failed(fmt::format(
        "light cannot be captured at {} points in cube maps of 6×{}×{} texels: that takes a "
        "picture of {}×{}, and this OpenGL makes {} a side. Ask for fewer points or smaller maps",
        samples, side, side, std::int64_t(tilesAcross) * side, std::int64_t(tilesUp) * side,
        largest));
  color = makeTexture(GL_RGBA32F, tilesAcross * side, tilesUp * side);
  depth = makeTexture(GL_DEPTH_COMPONENT32F, tilesAcross * side, tilesUp * side);
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  framebuffer = Framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth.name(), 0);
  if (Status s = checkGl("making the cube maps"); !s) return s;
  if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return report::failed("this OpenGL does not draw into 32-bit float targets");
  return Status::ok();
}

Result<const Program*> LightCapture::Impl::facesProgram(int environmentBands) {
  auto found = faces.find(environmentBands);
  if (found == faces.end()) {
    const std::string define = fmt::format("#define LAMBENT_BANDS {}", environmentBands);
    const std::string harmonics(environmentBands > 0 ? shaderSource("sh.glsl") : "");
    const Program::Stage stages[] = {
        {GL_VERTEX_SHADER,
         "capture_faces.vert.glsl",
         {std::string(shaderSource("capture_faces.vert.glsl"))}},
        {GL_FRAGMENT_SHADER,
         "capture_faces.frag.glsl",
         {define, harmonics, std::string(shaderSource("capture_faces.frag.glsl"))}}};
    Result<Program> made = Program::make(stages);
    if (!made) return made.error();
    found = faces.emplace(environmentBands, std::move(*made)).first;
  }
  return &found->second;
}

/// The faces, as tiles, whose pyramid a ball reaches into.
void LightCapture::Impl::appendTilesThatSee(const Vec3& center, float radius,
                                            std::vector<std::int32_t>& tiles) const {
  const float margin = std::sqrt(2.0f) * radius;  // planes at 45°: d ± x = −√2 r touches the ball
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec3d way = (center - points[p]).cast<double>();
    for (std::size_t f = 0; f < 6; ++f) {
      const capture::CubeFace& face = capture::cubeFaces()[f];
      const double outside = std::max(std::abs(face.right.dot(way)), std::abs(face.up.dot(way))) -
                             face.forward.dot(way);
      if (outside <= double(margin)) tiles.push_back(std::int32_t(6 * p + f));
    }
  }
}

void LightCapture::Impl::drawFaces(const Program& program, double time,
                                   const Mat4& assetFromWorld) const {
  struct Placed {
    const GlBodies::Body* body;
    Mat4 assetFromBody;
    int firstSeen, endSeen;
  };
  std::vector<Placed> placed;
  std::vector<std::int32_t> tiles;
  float reach = 0;
  for (const GlBodies::Body& body : bodies.all()) {
    const Mat4 assetFromBody = assetFromWorld * capture::worldFromBody(body.motion, time);
    const Vec3 center = moved(assetFromBody, body.center);
    const int first = int(tiles.size());
    appendTilesThatSee(center, body.radius, tiles);
    placed.push_back({&body, assetFromBody, first, int(tiles.size())});
    for (const Vec3& point : points) reach = std::max(reach, (center - point).norm() + body.radius);
  }
  if (tiles.empty()) return;
  glNamedBufferSubData(seen.name(), 0, GLsizeiptr(tiles.size() * sizeof(tiles[0])), tiles.data());
  for (int i = 0; i < 4; ++i) glEnable(GLenum(GL_CLIP_DISTANCE0 + i));
  glDepthFunc(GL_LESS);
  glFrontFace(GL_CCW);
  program.use();
  program.set("tiles", tilesAcross, tilesUp);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, pointBuffer.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, environment.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, seen.name());
  bodies.bind();
  for (const Placed& each : placed) {
    const Rgb& radiance = each.body->radiance;
    program.setMatrix("assetFromBody", each.assetFromBody.data());
    program.set("radianceReach", radiance.x(), radiance.y(), radiance.z(), 1.01f * reach);
    const int atOnce = options.facesAtOnce > 0 ? options.facesAtOnce : int(tiles.size());
    for (int first = each.firstSeen; first < each.endSeen; first += atOnce) {
      program.set("firstSeen", first);
      bodies.draw(*each.body, std::min(atOnce, each.endSeen - first));
    }
  }
}

void LightCapture::Impl::project(int environmentBands) const {
  reduce.use();
  reduce.set("size", options.cube.size);
  reduce.set("supersampling", options.cube.supersampling);
  reduce.set("coefficients", sh::coefficientCount(options.bands));
  reduce.set("environmentCoefficients", sh::coefficientCount(environmentBands));
  reduce.set("tilesAcross", tilesAcross);
  glBindTextureUnit(0, color.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, weights.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, environment.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, light.name());
  glDispatchCompute(GLuint(points.size()), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

Status LightCapture::capture(double time, const Mat4& worldFromAsset,
                             const sh::RgbCoefficients& worldLight) {
  assert(worldLight.bands <= sh::kMaxBands);
  Result<const Program*> program = impl_->facesProgram(worldLight.bands);
  if (!program) return program.error();
  if (worldLight.bands > 0) {
    const Mat3 assetFromWorld = worldFromAsset.topLeftCorner<3, 3>().transpose();
    const std::vector<float> values = interleaved(sh::rotate(assetFromWorld, worldLight));
    glNamedBufferSubData(impl_->environment.name(), 0, GLsizeiptr(values.size() * sizeof(float)),
                         values.data());
  }
  const GlStateGuard guard;
  const float zero[4] = {}, far = 1.0f;
  const GLuint target = impl_->framebuffer.name();
  glClearNamedFramebufferfv(target, GL_COLOR, 0, zero);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, &far);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  const int side = impl_->options.cube.drawn();
  glViewport(0, 0, impl_->tilesAcross * side, impl_->tilesUp * side);
  impl_->drawFaces(**program, time, inverseOfRigid(worldFromAsset));
  impl_->project(worldLight.bands);
  return checkGl("capturing light");
}

unsigned LightCapture::lightBuffer() const {
  return impl_->light.name();
}
int LightCapture::bands() const {
  return impl_->options.bands;
}
int LightCapture::samples() const {
  return int(impl_->points.size());
}

scene::Box LightCapture::bounds(double time) const {
  scene::Box result;
  for (const GlBodies::Body& body : impl_->bodies.all()) {
    const Vec3 center = moved(capture::worldFromBody(body.motion, time), body.center);
    result.extend(center - Vec3::Constant(body.radius));
    result.extend(center + Vec3::Constant(body.radius));
  }
  return result;
}

Result<std::vector<sh::RgbCoefficients>> LightCapture::read() const {
  const int count = sh::coefficientCount(bands());
  std::vector<float> values(std::size_t(samples()) * 3 * std::size_t(count));
  glGetNamedBufferSubData(lightBuffer(), 0, GLsizeiptr(values.size() * sizeof(float)),
                          values.data());
  if (Status s = checkGl("reading captured light back"); !s) return s.error();
  const sh::RgbCoefficients none(bands());
  std::vector<sh::RgbCoefficients> result(impl_->points.size(), none);
  const float* from = values.data();
  for (sh::RgbCoefficients& light : result)
    for (int i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) light.channel(c)[std::size_t(i)] = *from++;
  return result;
}

void LightCapture::draw(unsigned framebuffer, int width, int height, const Mat4& clipFromWorld,
                        double time) const {
  const GlStateGuard guard;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_CULL_FACE);
  // A projection that mirrors nothing turns the depth over: its determinant is negative.
  glFrontFace(clipFromWorld.determinant() < 0 ? GL_CCW : GL_CW);
  impl_->view.use();
  impl_->bodies.bind();
  // Farthest first, and backs before fronts: far beyond the asset's planes depths are too coarse to
  // tell, and then what is drawn last is seen.
  struct Placed {
    const GlBodies::Body* body;
    Mat4 clipFromBody;
    float depth;
  };
  std::vector<Placed> placed;
  for (const GlBodies::Body& body : impl_->bodies.all()) {
    const Mat4 clipFromBody = clipFromWorld * capture::worldFromBody(body.motion, time);
    const float depth = clipFromBody.row(2).head<3>().dot(body.center) + clipFromBody(2, 3);
    placed.push_back({&body, clipFromBody, depth});
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.depth > b.depth; });
  for (const Placed& each : placed) {
    const Rgb& radiance = each.body->radiance;
    impl_->view.setMatrix("clipFromBody", each.clipFromBody.data());
    impl_->view.set("radiance", radiance.x(), radiance.y(), radiance.z());
    for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
      glCullFace(hidden);
      impl_->bodies.draw(*each.body, 1);
    }
  }
}

}  // namespace lambent::render
