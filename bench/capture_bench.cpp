// What captured light costs for each sample point: rendering six faces and reducing them to
// harmonics. usage: lambent_capture_bench [CSV]. Milliseconds are those of this machine's OpenGL,
// whose name is printed first; ratios are against other work of the same OpenGL in the same run.

#include <epoxy/gl.h>

#include "bench/figures_file.h"
#include "lambent/capture/sample_points.h"
#include "lambent/capture/surroundings.h"
#include "lambent/light/environment.h"
#include "lambent/reference/capture_by_rays.h"
#include "lambent/render/gl_capture.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_target.h"
#include "lambent/scene/camera.h"
#include "lambent/scene/shapes.h"

namespace lambent::bench {
namespace {

template <class T>
T orDie(Result<T> result) {
  if (result) return std::move(*result);
  fmt::print(stderr, "capture_bench: {}\n", result.error().message);
  std::exit(1);
}

void orDie(const Status& status) {
  if (status) return;
  fmt::print(stderr, "capture_bench: {}\n", status.error().message);
  std::exit(1);
}

/// The pictures of all faces read back, as the paper did, in as many texels.
void readBack(const render::Texture& texture, std::vector<float>& into) {
  glGetTextureImage(texture.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(into.size() * sizeof(float)),
                    into.data());
}

void run() {
  const render::GlContext context = orDie(render::GlContext::create());
  fmt::print("{}\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  const scene::Scene object = scene::sceneOf(scene::torus(1, 0.4f, 64, 32));
  const capture::MovingScene scene = capture::demoSurroundings(scene::bounds(object));
  const auto sky = light::Environment::uniform(Rgb(1, 1, 1)).project(5);
  const Mat4 identity = Mat4::Identity();

  const auto make = [&](int samples, const render::CaptureOptions& options,
                        const capture::MovingScene& bodies) {
    const std::vector<Vec3> points = capture::samplePoints(object, samples).points;
    return orDie(render::LightCapture::make(bodies, points, options));
  };
  const auto once = [&](render::LightCapture& capture) {
    return [&] {
      orDie(capture.capture(1.0, identity, sky));
      glFinish();
    };
  };
  render::LightCapture one = make(1, {}, scene), eight = make(8, {}, scene);
  render::LightCapture many = make(32, {}, scene), empty = make(8, {}, {});
  render::LightCapture small = make(8, {{8, 2}, 5, 0}, scene);
  render::LightCapture oneByOne = make(8, {{}, 5, 1}, scene);
  render::LightCapture cubeByCube = make(8, {{}, 5, 6}, scene);

  const int side = 1024;
  const render::GlTarget target = orDie(render::GlTarget::make(side, side));
  const Mat4 clip = scene::clipFromWorld(scene::frameAutomatically(capture::frozen(scene, 1.0), 1),
                                         side, side, scene::bounds(object));
  const render::Texture faces = render::makeTexture(GL_RGBA32F, 6 * 32, 8 * 32);
  std::vector<float> pixels(std::size_t(6 * 32) * 8 * 32 * 4);
  capture::CubePicture picture{{}, std::vector<Rgb>(6 * 32 * 32, Rgb::Ones())};
  const std::vector<double> weights = capture::cubeWeights(picture.shape, 5);

  const std::vector<double> seconds =
      bestOf(15, {once(one), once(eight), once(many), once(empty), once(small), once(oneByOne),
                  once(cubeByCube),
                  [&] {
                    target.beginFrame();
                    eight.draw(target.framebuffer(), side, side, clip, 1.0);
                    glFinish();
                  },
                  [&] { readBack(faces, pixels); }, [&] { capture::project(picture, weights); }});
  const double perSample = seconds[1] / 8;
  note("capture, 1 sample, 6x16x16 of 2x2", 1e3 * seconds[0], "ms", "paper 1.16");
  note("capture, 8 samples, for each", 1e3 * perSample, "ms", "paper 1.16");
  note("capture, 32 samples, for each", 1e3 * seconds[2] / 32, "ms", "paper 1.16");
  note("capture, 8 samples of 6x8x8, for each", 1e3 * seconds[4] / 8, "ms");
  note("reduction and clearing alone, for each of 8 samples", 1e3 * seconds[3] / 8, "ms");
  note("share of reduction and clearing", seconds[3] / seconds[1], "ratio");
  note("a sample over a 1024x1024 view of the same bodies", perSample / seconds[7], "ratio");
  note("one draw for each face, over one for all", seconds[5] / seconds[1], "ratio");
  note("one draw for each cube, over one for all", seconds[6] / seconds[1], "ratio");
  note("reading back and projecting on the CPU, over reducing on the GPU",
       (seconds[8] + 8 * seconds[9]) / seconds[3], "ratio");
}

}  // namespace
}  // namespace lambent::bench

int main(int argc, char** argv) {
  lambent::bench::run();
  lambent::bench::writeFigures(argc > 1 ? argv[1] : "");
  return 0;
}
