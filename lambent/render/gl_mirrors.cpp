#include "lambent/render/gl_mirrors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "lambent/capture/cube_map.h"
#include "lambent/render/shader_sources.h"
#include "lambent/scene/coverage.h"

namespace lambent::render {
namespace {

constexpr GLuint kCaptureUnit = 6;  ///< of textures
constexpr int kLeastSide = 16;
/// Of distances in a scene, what 16 bits hold to their full precision.
constexpr float kHalfLeast = 1.0f, kHalfMost = 3e4f;
constexpr float kNearest = 1e-3f;          ///< of the farthest: what is nearer is not drawn
constexpr float kNearestAtMirror = 0.02f;  ///< of the mirror's own size, if that is less

bool isMirror(const scene::Scene& scene, std::uint32_t mesh) {
  return scene::materialOf(scene, scene.meshes[mesh]).isMirror();
}

/// How large a part of all directions a mesh's triangles cover, seen from a place, those that face
/// away less those that face it: 4π inside of a body. (Van Oosterom and Strackee's formula.)
double solidAngleAround(const scene::Mesh& mesh, const Vec3& place) {
  double sum = 0;
  for (const scene::Triangle& t : mesh.triangles) {
    const Vec3d a = (mesh.positions[t[0]] - place).cast<double>();
    const Vec3d b = (mesh.positions[t[1]] - place).cast<double>();
    const Vec3d c = (mesh.positions[t[2]] - place).cast<double>();
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum;
}

/// Whether a place is inside of a body that is not the mirror itself: nothing but its back would be
/// seen.
bool isBuried(const scene::Scene& scene, std::uint32_t mirror, const Vec3& place) {
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    if (m == mirror) continue;
    const scene::Box box = scene::bounds(scene.meshes[m]);
    if ((place.array() < box.lower.array()).any() || (place.array() > box.upper.array()).any())
      continue;
    if (std::abs(solidAngleAround(scene.meshes[m], place)) > 3 * kPi) return true;
  }
  return false;
}

/// The middle of a mirror's box or, where something stands there that the mirror goes around, a
/// place before the mirror.
Vec3 placeAt(const scene::Scene& scene, std::uint32_t mirror) {
  const scene::Mesh& mesh = scene.meshes[mirror];
  const scene::Box box = scene::bounds(mesh);
  if (!isBuried(scene, mirror, box.center())) return box.center();
  constexpr std::size_t kTries = 16;
  const std::size_t count = mesh.positions.size();
  for (std::size_t k = 0; k < std::min(kTries, count); ++k) {
    const std::size_t i = k * count / std::min(kTries, count);
    const Vec3 place = mesh.positions[i] + 0.02f * box.diagonal() * mesh.normals[i];
    if (!isBuried(scene, mirror, place)) return place;
  }
  return box.center();
}

float farthest(const scene::Box& box, const Vec3& from) {
  return (from - box.lower).cwiseAbs().cwiseMax((box.upper - from).cwiseAbs()).norm();
}

}  // namespace

std::string localCaptureSource() {
  // A quarter of what the page takes: borders of things may lie as much too far in. By how much
  // differs from pixel to pixel, and from one sub-sample to the next.
  return "#define LAMBENT_CAPTURE_STEP 0.02\n"
         "float capturePhase();\n"
         "#define LAMBENT_CAPTURE_PHASE capturePhase()\n" +
         std::string(shaderSource("local_capture.glsl"));
}

bool GlMirrors::areIn(const scene::Scene& scene) {
  std::size_t mirrors = 0, all = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    if (scene.meshes[m].triangles.empty()) continue;
    ++all;
    mirrors += isMirror(scene, m);
  }
  return mirrors > 0 && all > 1;
}

Result<GlMirrors> GlMirrors::make(const scene::Scene& scene, int side) {
  GlMirrors made;
  std::vector<std::uint32_t> mirrors;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    if (!scene.meshes[m].triangles.empty() && isMirror(scene, m)) mirrors.push_back(m);
  std::vector<scene::Box> boxes(scene.meshes.size());
  for (const std::uint32_t m : mirrors) boxes[m] = scene::bounds(scene.meshes[m]);
  std::stable_sort(mirrors.begin(), mirrors.end(), [&](std::uint32_t a, std::uint32_t b) {
    return boxes[a].diagonal() > boxes[b].diagonal();
  });
  const scene::Box bounds = scene::bounds(scene);
  for (const std::uint32_t m : mirrors) {
    const Vec3 center = boxes[m].center();
    if (made.captures_.size() < kMost) {
      Capture capture;
      capture.mesh = m;
      capture.from = placeAt(scene, m);
      capture.far = 1.001f * std::max(farthest(bounds, capture.from), 1e-30f);
      capture.near = std::clamp(kNearestAtMirror * boxes[m].diagonal(), 1e-5f * capture.far,
                                kNearest * capture.far);
      made.captureOf_[m] = made.captures_.size();
      made.captures_.push_back(std::move(capture));
      continue;
    }
    const auto nearest = std::min_element(
        made.captures_.begin(), made.captures_.end(), [&](const Capture& a, const Capture& b) {
          return (a.from - center).norm() < (b.from - center).norm();
        });
    made.captureOf_[m] = std::size_t(nearest - made.captures_.begin());
  }
  made.showMirrors_ = mirrors.size() > 1;
  const std::vector<scene::Passing> passings = scene::passingsOf(scene);
  made.veils_ =
      std::find(passings.begin(), passings.end(), scene::Passing::Shares) != passings.end();
  const float size = bounds.diagonal();
  made.format_ = size >= kHalfLeast && size <= kHalfMost ? GL_RGBA16F : GL_RGBA32F;
  Status status = made.makeMaps(side);
  while (!status && side / 2 >= kLeastSide) {
    side /= 2;
    status = made.makeMaps(side);
  }
  if (!status) return status.error();
  if (Status s = made.makeProgram(); !s) return s.error();
  return made;
}

Status GlMirrors::makeMaps(int side) {
  side_ = side;
  for (Capture& capture : captures_) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &name);
    capture.map = Texture(name);
    glTextureStorage2D(name, 1, format_, side, side);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
  }
  color_ = makeTexture(GL_RGBA32F, side, side);
  depth_ = makeTexture(GL_DEPTH_COMPONENT32F, side, side);
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  framebuffer_ = Framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color_.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  return checkGl("making what mirrors show");
}

Status GlMirrors::makeProgram() {
  std::vector<std::string> parts = {
      fmt::format("#define LAMBENT_FORMAT {}\n#define LAMBENT_BACKGROUND {:d}\n",
                  format_ == GL_RGBA16F ? "rgba16f" : "rgba32f", veils_)};
  if (veils_) parts.push_back(environmentSource());
  parts.emplace_back(shaderSource("mirror_face.comp.glsl"));
  const Program::Stage stage{GL_COMPUTE_SHADER, "mirror_face.comp.glsl", std::move(parts)};
  Result<Program> program = Program::make({&stage, 1});
  if (!program) return program.error();
  keep_ = std::move(*program);
  return Status::ok();
}

void GlMirrors::forget() {
  for (Capture& capture : captures_) capture.drawn = false;
}

GlView GlMirrors::viewOf(const Capture& capture, int face, const GlView& view) const {
  const capture::CubeFace& axes = capture::cubeFaces()[std::size_t(face)];
  GlView seen;
  seen.eye = Eigen::Vector4f(capture.from.x(), capture.from.y(), capture.from.z(), 1.0f);
  seen.leftOut = int(capture.mesh);
  seen.environmentFromWorld = view.environmentFromWorld;
  seen.sun = view.sun;
  seen.sample = view.sample;
  const float texel = 2.0f / float(side_);
  seen.sampleWidth = {texel, 0.0f};
  const Vec3 right = axes.right.cast<float>(), up = axes.up.cast<float>(),
             forward = axes.forward.cast<float>();
  const float near = capture.near, far = capture.far;
  const auto row = [&](const Vec3& axis) {
    return Eigen::RowVector4f(axis.x(), axis.y(), axis.z(), -axis.dot(capture.from));
  };
  seen.clipFromWorld.row(0) = row(right);
  seen.clipFromWorld.row(1) = row(up);
  seen.clipFromWorld.row(2) = (far + near) / (far - near) * row(forward);
  seen.clipFromWorld(2, 3) -= 2 * far * near / (far - near);
  seen.clipFromWorld.row(3) = row(forward);
  seen.right = texel * right;
  seen.up = texel * up;
  seen.corner = forward + (0.5f * texel - 1.0f) * (right + up);
  return seen;
}

void GlMirrors::beginFace() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, side_, side_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  const float black[4] = {}, far = 1.0f;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, black);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &far);
}

void GlMirrors::endFace(const Capture& capture, int face, const GlView& view,
                        const GlEnvironment& environment) const {
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glBindImageTexture(0, color_.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
  glBindImageTexture(1, capture.map.name(), 0, GL_TRUE, 0, GL_READ_WRITE, format_);
  if (veils_) environment.bind(keep_, view.environmentFromWorld);
  keep_.set("face", face);
  keep_.set("number", view.sample);
  keep_.set("corner", view.corner.x(), view.corner.y(), view.corner.z());
  keep_.set("right", view.right.x(), view.right.y(), view.right.z());
  keep_.set("up", view.up.x(), view.up.y(), view.up.z());
  keep_.use();
  glDispatchCompute(GLuint(side_ + 7) / 8, GLuint(side_ + 7) / 8, 1);
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
}

void GlMirrors::bind(const Program& program, std::uint32_t mesh, int sample) const {
  const auto found = captureOf_.find(mesh);
  program.set("captureSample", sample);
  if (found == captureOf_.end() || !captures_[found->second].drawn) {
    bindNone(program);
    return;
  }
  const Capture& capture = captures_[found->second];
  program.set("capture", int(kCaptureUnit));
  program.set("hasCapture", 1);
  program.set("captureFrom", capture.from.x(), capture.from.y(), capture.from.z());
  glBindTextureUnit(kCaptureUnit, capture.map.name());
}

void GlMirrors::bindNone(const Program& program) {
  // Its unit is set all the same: none may be read as two kinds of texture.
  program.set("capture", int(kCaptureUnit));
  program.set("hasCapture", 0);
}

}  // namespace lambent::render
