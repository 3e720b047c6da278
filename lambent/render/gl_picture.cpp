// Run-time rendering of radiance transfer (sloan2002precomputed §6) by OpenGL: a compute pass
// applies transfer vectors and matrices to the light; the surfaces are then drawn once for each
// sub-sample, shifted so that a pixel's centre falls on the place that shade::picture shoots its
// ray through, and added up. So every sub-sample of every pixel has its counterpart on the CPU.

#include "lambent/render/gl_picture.h"

#include <algorithm>

#include <fmt/format.h>
#include <Eigen/LU>

#include "lambent/render/gl_context.h"
#include "lambent/render/gl_picture_in_blocks.h"
#include "lambent/render/gl_scene.h"
#include "lambent/render/shader_sources.h"
#include "lambent/shade/picture_frame.h"

namespace lambent::render {
namespace {

constexpr std::size_t kLargestBlock = std::size_t(128) << 20;

/// clipFromWorld, shifted so that what stands at `place` of each pixel (from its upper left corner)
/// comes to stand at the pixel's centre, which is where GL samples.
Mat4 shifted(const Mat4& clipFromWorld, const Vec2& place, int width, int height) {
  Mat4 result = clipFromWorld;
  result.row(0) += (0.5f - place.x()) * 2.0f / float(width) * clipFromWorld.row(3);
  result.row(1) -= (0.5f - place.y()) * 2.0f / float(height) * clipFromWorld.row(3);
  return result;
}

Eigen::Vector4f eyeOf(const scene::Camera& camera) {
  const Eigen::Vector3f back = camera.worldFromCamera.block<3, 1>(0, 2).normalized();
  const Eigen::Vector3f position = camera.worldFromCamera.block<3, 1>(0, 3);
  if (camera.orthographicHalfHeight) return {back.x(), back.y(), back.z(), 0.0f};
  return {position.x(), position.y(), position.z(), 1.0f};
}

struct Target {
  Texture color, depth, sum;
  Framebuffer framebuffer;
  Program accumulate;
  int width = 0, height = 0;

  static Result<Target> make(int width, int height) {
    Target target;
    target.width = width;
    target.height = height;
    target.color = makeTexture(GL_RGBA32F, width, height);
    target.depth = makeTexture(GL_DEPTH_COMPONENT32F, width, height);
    target.sum = makeTexture(GL_RGBA32F, width, height);
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    target.framebuffer = Framebuffer(name);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, target.color.name(), 0);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, target.depth.name(), 0);
    if (Status s = checkGl("making the picture's targets"); !s) return s.error();
    const GLenum complete = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
    if (complete != GL_FRAMEBUFFER_COMPLETE)
      return report::failed(fmt::format(
          "this OpenGL does not draw into 32-bit float targets (status {:#x})", complete));
    const Program::Stage stage{GL_COMPUTE_SHADER,
                               "accumulate.comp.glsl",
                               {std::string(shaderSource("accumulate.comp.glsl"))}};
    Result<Program> program = Program::make({&stage, 1});
    if (!program) return program.error();
    target.accumulate = std::move(*program);
    const float zero[4] = {};
    glClearTexImage(target.sum.name(), 0, GL_RGBA, GL_FLOAT, zero);
    return target;
  }

  void clear() const {
    const float black[4] = {}, far = 1.0f;
    glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, black);
    glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &far);
  }

  void addToSum() const {
    glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    accumulate.use();
    glBindImageTexture(0, color.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    glBindImageTexture(1, sum.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glDispatchCompute(GLuint(width + 7) / 8, GLuint(height + 7) / 8, 1);
    glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT);
  }

  /// The mean of `samples` pictures; GL's rows begin at the bottom.
  Result<image::Image> mean(int samples) const {
    image::Image image(width, height);
    image.alpha.resize(image.pixels.size());
    const float count = float(samples);
    const int strip =
        std::max(1, std::min(height, (1 << 22) / width));  // GL counts bytes in an int
    std::vector<float> pixels(std::size_t(width) * strip * 4);
    for (int first = 0; first < height; first += strip) {
      const int rows = std::min(strip, height - first);
      glGetTextureSubImage(sum.name(), 0, 0, first, 0, width, rows, 1, GL_RGBA, GL_FLOAT,
                           GLsizei(pixels.size() * sizeof(float)), pixels.data());
      const float* from = pixels.data();
      for (int y = height - 1 - first; y > height - 1 - first - rows; --y) {
        for (int x = 0; x < width; ++x, from += 4) {
          image.at(x, y) = Rgb(from[0], from[1], from[2]) / count;
          image.alpha[std::size_t(y) * width + x] = from[3] / count;
        }
      }
    }
    if (Status s = checkGl("reading the picture back"); !s) return s.error();
    return image;
  }
};

}  // namespace

Result<image::Image> pictureInBlocks(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                     const light::Environment& environment,
                                     const scene::Camera& camera,
                                     const shade::PictureOptions& options, std::size_t largestBlock,
                                     const Progress& progress) {
  if (Status s = shade::checkPicture(asset, light, camera, options); !s) return s.error();
  const Result<GlContext> context = GlContext::create();
  if (!context) return context.error();
  const int width = options.width, height = options.height;
  if (width > context->largestTexture() || height > context->largestTexture())
    return report::failed(fmt::format(
        "a picture of {}×{} pixels: this OpenGL makes {} a side. Ask for fewer, or make the "
        "picture on the CPU",
        width, height, context->largestTexture()));

  GlSceneOptions sceneOptions;
  sceneOptions.largestBlock = std::min(largestBlock, context->largestStorageBlock());
  sceneOptions.largestTexture = context->largestTexture();
  sceneOptions.lobeExponent = options.lobeExponent;
  sceneOptions.biScale = options.biScale;
  const Result<GlScene> scene = GlScene::make(asset, light, environment, sceneOptions);
  if (!scene) return scene.error();
  const Result<Target> target = Target::make(width, height);
  if (!target) return target.error();

  const Mat4 clipFromWorld =
      scene::clipFromWorld(camera, width, height, scene::bounds(asset.scene));
  const Eigen::Vector4f eye = eyeOf(camera);
  const shade::SampleWidth sampleWidth = shade::sampleWidth(camera, height, options.samples);
  const float handedness = camera.worldFromCamera.topLeftCorner<3, 3>().determinant();
  glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer.name());
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glFrontFace(handedness > 0.0f ? GL_CCW : GL_CW);

  const std::vector<Vec2> places = scene::subpixelPositions(options.samples);
  for (std::size_t i = 0; i < places.size(); ++i) {
    target->clear();
    scene->draw({shifted(clipFromWorld, places[i], width, height), eye, sampleWidth});
    target->addToSum();
    if (Status s = checkGl("drawing"); !s) return s.error();
    if (progress) {
      glFinish();
      if (!progress({"picture", i + 1, places.size(), "samples"})) return report::cancelled();
    }
  }
  Result<image::Image> image = target->mean(int(places.size()));
  if (image) shade::finishPicture(*image, environment, camera, options);
  return image;
}

Result<image::Image> picture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                             const light::Environment& environment, const scene::Camera& camera,
                             const shade::PictureOptions& options, const Progress& progress) {
  return pictureInBlocks(asset, light, environment, camera, options, kLargestBlock, progress);
}

}  // namespace lambent::render
