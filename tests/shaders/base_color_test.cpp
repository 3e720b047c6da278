// shaders/base_color.glsl against scene::baseColorAt.

#include <array>

#include <gtest/gtest.h>

#include "lambent/radiometry/srgb.h"
#include "lambent/shade/lit_mesh.h"
#include "tests/shaders/test_glsl.h"

#include "tests/shaders/glsl_begin.h"

#define LAMBENT_MAP 1
namespace lambent::glsl::mapped {
#include "shaders/base_color.glsl"
#include "shaders/coverage.glsl"

const scene::Texture* texture = nullptr;

float baseColorAlpha(ivec2 texel) {
  return float(texture->rgba[std::size_t(4 * (texel.y * texture->width + texel.x) + 3)]) / 255.0f;
}

bool hasBaseColorMap() {
  return texture != nullptr;
}
ivec2 baseColorSize() {
  return {texture->width, texture->height};
}
vec3 baseColorTexel(ivec2 texel) {
  EXPECT_TRUE(texel.x >= 0 && texel.x < texture->width && texel.y >= 0 &&
              texel.y < texture->height);
  const std::uint8_t* code = texture->rgba.data() + 4 * (texel.y * texture->width + texel.x);
  const auto linear = [&](int c) { return radiometry::srgbDecode(float(code[c]) / 255.0f); };
  return {linear(0), linear(1), linear(2)};
}
}  // namespace lambent::glsl::mapped

#undef LAMBENT_MAP
#define LAMBENT_MAP 0
namespace lambent::glsl::plain {
#include "shaders/base_color.glsl"
}

#include "tests/shaders/glsl_end.h"

namespace lambent::glsl {
namespace {

int ruleOf(scene::Wrap wrap) {
  return wrap == scene::Wrap::ClampToEdge ? 1 : wrap == scene::Wrap::MirroredRepeat ? 2 : 0;
}

TEST(BaseColor, IsTheLibrarys) {
  using scene::Wrap;
  math::Random random(1, 0);
  for (const auto& [width, height] : {std::pair{16, 9}, {5, 64}, {1, 1}})
    for (const Wrap wrapU : {Wrap::Repeat, Wrap::ClampToEdge, Wrap::MirroredRepeat})
      for (const Wrap wrapV : {Wrap::Repeat, Wrap::ClampToEdge, Wrap::MirroredRepeat}) {
        scene::Scene scene;
        scene::Texture& texture = scene.textures.emplace_back();
        texture.width = width;
        texture.height = height;
        texture.wrapU = wrapU;
        texture.wrapV = wrapV;
        for (int i = 0; i < 4 * width * height; ++i)
          texture.rgba.push_back(std::uint8_t(random.below(256)));
        scene.materials.emplace_back().baseColorTexture = 0;
        scene::Mesh& mesh = scene.meshes.emplace_back();
        mesh.material = 0;
        mesh.triangles.push_back({0, 1, 2});
        mesh.positions.resize(3, Vec3::Zero());
        mapped::baseColorWrap = ivec2(ruleOf(wrapU), ruleOf(wrapV));
        for (int i = 0; i < 2000; ++i) {
          mesh.uvs.clear();
          mesh.colors.clear();
          for (int k = 0; k < 3; ++k) {
            mesh.uvs.emplace_back(between(random, -3, 3), between(random, -3, 3));
            mesh.colors.push_back(anyColor(random));
          }
          const float u = 0.5f * random.uniform(), v = 0.5f * random.uniform(), w = 1 - u - v;
          const Rgb color = w * mesh.colors[0] + u * mesh.colors[1] + v * mesh.colors[2];
          const Vec2 uv = w * mesh.uvs[0] + u * mesh.uvs[1] + v * mesh.uvs[2];
          mapped::texture = &texture;
          // The library's weights are of double precision: a texel's place has 1e-6 of it here.
          ASSERT_LT(apart(mapped::baseColor(from(color), from(uv)),
                          scene::baseColorAt(scene, 0, 0, u, v)),
                    1e-5f)
              << uv.transpose();
          ASSERT_NEAR(mapped::sampleAlpha(from(uv)), scene::sampleAlpha(texture, uv), 1e-5f)
              << uv.transpose();
          mapped::texture = nullptr;
          ASSERT_LT(apart(mapped::baseColor(from(color), from(uv)), color), 1e-9f);
          ASSERT_LT(apart(plain::baseColor(from(color), from(uv)), color), 1e-9f);
        }
      }
}

TEST(Coverage, AMaskHasAThresholdAndABlendAShareOfSubSamples) {
  scene::Texture texture;
  texture.width = texture.height = 1;
  texture.rgba = {255, 255, 255, 102};
  mapped::texture = &texture;
  mapped::kept = 1.0f;
  mapped::alphaRule = vec2(0.5f, 0.3f);
  mapped::alphaMode = 0;
  EXPECT_TRUE(mapped::isThere(0.1f, vec2(0.5f), vec3(3.5f, 4.5f, 0.2f)));
  mapped::alphaMode = 1;
  EXPECT_FALSE(mapped::isThere(1.0f, vec2(0.5f), vec3(3.5f, 4.5f, 0.2f)));
  mapped::alphaRule = vec2(1.0f, 0.3f);
  EXPECT_TRUE(mapped::isThere(1.0f, vec2(0.5f), vec3(3.5f, 4.5f, 0.2f)));
  EXPECT_FALSE(mapped::isThere(0.7f, vec2(0.5f), vec3(3.5f, 4.5f, 0.2f)));
  const auto share = [] {
    int there = 0;
    for (int pixel = 0; pixel < 1000; ++pixel)
      for (int sample = 0; sample < 16; ++sample) {
        mapped::veil = ivec2(7, sample);
        there +=
            mapped::isThere(0.75f, vec2(0.5f), vec3(pixel % 40 + 0.5f, pixel / 40 + 0.5f, 0.3f));
      }
    return there / 16000.0;
  };
  mapped::alphaMode = 2;
  EXPECT_NEAR(share(), 0.3, 5e-3);
  mapped::kept = 0.5f;
  EXPECT_NEAR(share(), 0.15, 5e-3);
  mapped::alphaMode = 0;
  EXPECT_NEAR(share(), 0.5, 5e-3);
  mapped::kept = 0.0f;
  EXPECT_EQ(share(), 0.0);
}

// Layers are neighbours by number: what one leaves of a pixel's sub-samples the next takes its share of.
TEST(Coverage, OfBlendsOnEachOtherIsTheirProductInEveryPixel) {
  scene::Texture texture;
  texture.width = texture.height = 1;
  texture.rgba = {255, 255, 255, 255};
  mapped::texture = &texture;
  mapped::kept = 1.0f;
  mapped::alphaRule = vec2(1.0f, 0.5f);
  mapped::alphaMode = 2;
  for (int pixel = 0; pixel < 200; ++pixel) {
    const vec3 fragment(pixel % 40 + 0.5f, pixel / 40 + 0.5f, 0.3f);
    std::array<int, 3> pairs = {};
    for (int sample = 0; sample < 256; ++sample) {
      std::array<bool, 3> there;
      for (int layer = 0; layer < 3; ++layer) {
        mapped::veil = ivec2(4 + layer, sample);
        there[std::size_t(layer)] = mapped::isThere(0.5f, vec2(0.5f), fragment);
      }
      for (std::size_t k = 0; k < 3; ++k) pairs[k] += there[k] && there[(k + 1) % 3];
    }
    for (const int both : pairs) EXPECT_NEAR(both / 256.0, 0.25, 0.05) << pixel;
  }
}

// Nonsense in a file must not lead out of the texture.
TEST(BaseColor, StaysInsideForHugeCoordinates) {
  scene::Texture texture;
  texture.width = texture.height = 3;
  texture.rgba.assign(36, 255);
  mapped::texture = &texture;
  for (int rule = 0; rule < 3; ++rule) {
    mapped::baseColorWrap = ivec2(rule, rule);
    for (const float far : {-1e30f, 1e30f, 1e6f, -1e6f})
      EXPECT_LT(apart(mapped::baseColor(vec3(1.0f), vec2(far, -far)), Rgb(1, 1, 1)), 1e-6f);
  }
}

}  // namespace
}  // namespace lambent::glsl
