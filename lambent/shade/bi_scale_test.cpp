// Surfaces with meso-structure on the CPU: against transfer in closed form, and by patches that say
// which of their places, and which of their views, were read.

#include <gtest/gtest.h>

#include "lambent/image/compare.h"
#include "lambent/math/directions.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/rotation.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/shade/picture_frame.h"
#include "lambent/shade/shade.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"

namespace lambent::shade {
namespace {

using reference::relitPicture;
using test::addPatched;
using test::seenFrom;
using test::SpreadOptions;
using transfer::Encoding;
using transfer::Kind;
using transfer::Numbers;
using BiScale = transfer::BiScale<Numbers>;

sh::RgbCoefficients uniformLight(int bands) {
  sh::RgbCoefficients light(bands);
  for (int c = 0; c < 3; ++c) light.channel(c)[0] = float(std::sqrt(4 * kPi));
  return light;
}

sh::RgbCoefficients unevenLight(int bands) {
  sh::RgbCoefficients light(bands);
  for (std::size_t i = 0; i < light.values.size(); ++i)
    light.values[i] = std::sin(1.7f * float(i) + 0.3f) / (1.0f + 0.1f * float(i));
  return light;
}

// A flat patch is no patch: B = ρ/π Â_l y(+z), turned back into the world, is the diffuse transfer
// vector. So neither the tangents nor the place nor the view can matter.
TEST(BiScale, AFlatPatchIsDiffuseTransfer) {
  asset::Asset plain;
  test::addDiffuse(plain, test::sphere(Vec3::Zero(), 1.0f, 10), {});
  for (const int bands : {2, 5, 6}) {
    const sh::RgbCoefficients light = unevenLight(bands);
    const std::vector<Rgb> expected =
        exitRadiance(plain, 0, sh::withBands(light, std::min(5, bands)));
    for (const Vec3& tangent : {Vec3(1, 0, 0), Vec3(-0.2f, 0.5f, 0.7f), Vec3(0.3f, -1, 0.1f)}) {
      asset::Asset patched;
      SpreadOptions options;
      options.tangent = tangent;
      addPatched(patched, test::sphere(Vec3::Zero(), 1.0f, 10),
                 test::flatRtt(4, 3, 3, 5, Rgb::Constant(0.8f)), options);
      const std::vector<Rgb> seen = exitRadiance(patched, 0, light, seenFrom(Vec3(2, 3, 4)));
      ASSERT_EQ(seen.size(), expected.size());
      for (std::size_t p = 0; p < seen.size(); ++p)
        EXPECT_LT((seen[p] - expected[p]).abs().maxCoeff(), 2e-5f) << bands << " bands, " << p;
    }
  }
}

TEST(BiScale, APictureOfAFlatPatchIsOneOfDiffuseTransfer) {
  asset::Asset plain, patched;
  test::addDiffuse(plain, scene::uvSphere(1.0f, 24, 12), {});
  SpreadOptions options;
  options.shadowedBands = 0;
  options.idMap = test::patchworkMap(64, 32, Vec2(4, 2));
  addPatched(patched, scene::uvSphere(1.0f, 24, 12), test::flatRtt(8, 8, 4, 5, Rgb::Constant(0.8f)),
             options);
  PictureOptions picture48;
  picture48.width = picture48.height = 48;
  picture48.samples = 4;
  const scene::Camera camera = test::cameraAt(Vec3(1, 2, 4), Vec3::Zero());
  const sh::RgbCoefficients light = unevenLight(5);
  const auto a = relitPicture(plain, light, {}, camera, picture48);
  const auto b = relitPicture(patched, light, {}, camera, picture48);
  ASSERT_TRUE(a && b);
  // Between vertices the light in their frames is interpolated, and not the radiance.
  EXPECT_LT(image::compare(b->pixels, a->pixels)->rmse, 2e-3);
}

/// Adds a texture of 4×4 colours, and returns its index.
int addTint(asset::Asset& asset) {
  scene::Texture texture;
  texture.width = texture.height = 4;
  for (int i = 0; i < 64; ++i) texture.rgba.push_back(std::uint8_t(i % 4 == 3 ? 255 : 55 + 3 * i));
  asset.scene.textures.push_back(std::move(texture));
  return int(asset.scene.textures.size()) - 1;
}

PictureOptions smallPicture() {
  PictureOptions options;
  options.width = options.height = 48;
  options.samples = 2;
  return options;
}

// A tint that is the same everywhere multiplies the picture.
TEST(BiScale, AnEvenTintMultipliesThePicture) {
  const Rgb tint(0.9f, 0.5f, 0.2f);
  asset::Asset plain;
  addPatched(plain, scene::uvSphere(1.0f, 24, 12), test::bumpyRtt(8, 8, 4, 3), {});
  asset::Asset tinted = plain;
  tinted.scene.meshes[0].colors.assign(tinted.scene.meshes[0].positions.size(), tint);
  const scene::Camera camera = test::cameraAt(Vec3(1, 2, 4), Vec3::Zero());
  const sh::RgbCoefficients light = unevenLight(3);
  const auto a = relitPicture(plain, light, {}, camera, smallPicture());
  const auto b = relitPicture(tinted, light, {}, camera, smallPicture());
  ASSERT_TRUE(a && b);
  for (std::size_t i = 0; i < a->pixels.size(); ++i)
    EXPECT_LT((a->pixels[i] * tint - b->pixels[i]).abs().maxCoeff(), 1e-6f) << i;
  const std::vector<Rgb> at = exitRadiance(plain, 0, light, seenFrom(Vec3(2, 3, 4)));
  const std::vector<Rgb> tintedAt = exitRadiance(tinted, 0, light, seenFrom(Vec3(2, 3, 4)));
  for (std::size_t p = 0; p < at.size(); ++p)
    EXPECT_LT((at[p] * tint - tintedAt[p]).abs().maxCoeff(), 1e-6f) << p;
}

// A flat patch under a tint is diffuse transfer under the same texture.
TEST(BiScale, ATintedFlatPatchIsTexturedDiffuseTransfer) {
  asset::Asset plain, patched;
  test::DiffuseOptions textured;
  textured.texture = true;
  test::addDiffuse(plain, scene::uvSphere(1.0f, 24, 12), textured);
  addPatched(patched, scene::uvSphere(1.0f, 24, 12), test::flatRtt(8, 8, 4, 5, Rgb::Constant(0.8f)),
             {});
  plain.scene.textures.clear();
  for (asset::Asset* asset : {&plain, &patched}) {
    asset->scene.materials[0].baseColorTexture = addTint(*asset);
    std::vector<Rgb>& colors = asset->scene.meshes[0].colors;
    for (const Vec3& p : asset->scene.meshes[0].positions)
      colors.emplace_back(0.5f + 0.4f * p.x(), 0.7f, 0.6f - 0.3f * p.y());
  }
  const scene::Camera camera = test::cameraAt(Vec3(1, 2, 4), Vec3::Zero());
  const sh::RgbCoefficients light = unevenLight(5);
  const auto a = relitPicture(plain, light, {}, camera, smallPicture());
  const auto b = relitPicture(patched, light, {}, camera, smallPicture());
  ASSERT_TRUE(a && b);
  EXPECT_LT(image::compare(b->pixels, a->pixels)->rmse, 2e-3);
  const std::vector<Rgb> at = exitRadiance(plain, 0, light);
  const std::vector<Rgb> patchedAt = exitRadiance(patched, 0, light);
  for (std::size_t p = 0; p < at.size(); ++p)
    EXPECT_LT((at[p] - patchedAt[p]).abs().maxCoeff(), 2e-5f) << p;
}

/// A floor at the origin (normal +y) whose patch lies along `tangent`.
asset::Asset floorOf(const transfer::SimulatedRtt& rtt, SpreadOptions options) {
  asset::Asset asset;
  addPatched(asset, test::floor(Vec3::Zero(), 1.0f), rtt, options);
  return asset;
}

// Each of the 8×8 views has its own colour; the viewer stands where each looks from, in the frame
// (tangent, normal × tangent, normal) written out by hand.
TEST(BiScale, ReadsTheViewThatItIsSeenFrom) {
  const int views = 8;
  const auto rtt = test::paintedRtt(
      1, 1, views, [](int, int, int vx, int vy) { return Rgb(float(vx), float(vy), 1.0f); });
  SpreadOptions options;
  options.tangent = Vec3::UnitZ();
  const asset::Asset asset = floorOf(rtt, options);
  const Vec3 tangent = Vec3::UnitZ(), bitangent = Vec3::UnitX(), normal = Vec3::UnitY();
  const sh::RgbCoefficients light = uniformLight(1);
  const Vec3 at = transfer::receiversOf(asset.transfer.meshes[0])->positions[0];
  for (int vy = 0; vy < views; ++vy)
    for (int vx = 0; vx < views; ++vx) {
      const Vec3 d = math::hemisphereFromSquare(Vec2((vx + 0.5f) / views, (vy + 0.5f) / views));
      const Vec3 eye = at + 7.0f * (d.x() * tangent + d.y() * bitangent + d.z() * normal);
      const Rgb seen = exitRadiance(asset, 0, light, seenFrom(eye))[0];
      EXPECT_NEAR(seen[0], float(vx), 1e-3f) << vx << ", " << vy;
      EXPECT_NEAR(seen[1], float(vy), 1e-3f) << vx << ", " << vy;
      EXPECT_NEAR(seen[2], 1.0f, 1e-5f);
      ReceiverView pasted = seenFrom(eye);
      pasted.showing.viewDependent = false;
      const Rgb centre = exitRadiance(asset, 0, light, pasted)[0];
      EXPECT_NEAR(centre[0], 3.5f, 1e-4f);
      EXPECT_NEAR(centre[1], 3.5f, 1e-4f);
    }
}

TEST(BiScale, StaysAtTheHorizonBelowIt) {
  const auto rtt = test::paintedRtt(
      1, 1, 6, [](int, int, int vx, int vy) { return Rgb(float(vx), float(vy), 1.0f); });
  const asset::Asset asset = floorOf(rtt, {});
  const Vec3 at = transfer::receiversOf(asset.transfer.meshes[0])->positions[0];
  const auto seenAlong = [&](const Vec3& direction) {
    return exitRadiance(asset, 0, uniformLight(1), seenFrom(at + direction))[0];
  };
  EXPECT_TRUE(seenAlong(Vec3(1, -0.2f, 0.4f)).isApprox(seenAlong(Vec3(1, 0, 0.4f)), 1e-4f));
}

/// From above, +x to the right and −z upwards, one pixel for each of side×side squares of the
/// floor.
scene::Camera fromAbove() {
  scene::Camera camera;
  camera.worldFromCamera.block<3, 1>(0, 1) = Vec3(0, 0, -1);
  camera.worldFromCamera.block<3, 1>(0, 2) = Vec3(0, 1, 0);
  camera.worldFromCamera.block<3, 1>(0, 3) = Vec3(0, 3, 0);
  camera.orthographicHalfHeight = 1.0f;
  return camera;
}

Result<image::Image> pictureFromAbove(const asset::Asset& asset, int side) {
  PictureOptions options;
  options.width = options.height = side;
  options.samples = 1;
  options.showing.filter = false;
  return relitPicture(asset, uniformLight(1), {}, fromAbove(), options);
}

transfer::SimulatedRtt numbered(int width, int height) {
  return test::paintedRtt(width, height, 1,
                          [](int x, int y, int, int) { return Rgb(float(x), float(y), 1.0f); });
}

// Without a map q = tiles (u, −v): row 0 of the patch is the lowest, and comes first above each
// whole v from below.
TEST(BiScale, RepeatsThePatchTheRightWayUp) {
  SpreadOptions options;
  options.tiles = Vec2(3, 2);
  options.tangent = Vec3::UnitX();
  const auto image = pictureFromAbove(floorOf(numbered(4, 6), options), 12);
  ASSERT_TRUE(image) << image.error().message;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) {
      EXPECT_NEAR(image->at(x, y)[0], float(x % 4), 1e-3f) << x << ", " << y;
      EXPECT_NEAR(image->at(x, y)[1], float((11 - y) % 6), 1e-3f) << x << ", " << y;
    }
}

TEST(BiScale, ReadsThePlacesThatTheMapNames) {
  SpreadOptions options;
  transfer::IdMap map;
  map.width = 4;
  map.height = 3;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) {
      // Position ((3x + 1) mod 5, (2y + x) mod 7), near the end of its cell.
      map.ids.push_back(std::uint16_t(65536 * ((3 * x + 1) % 5 + 0.97) / 5));
      map.ids.push_back(std::uint16_t(65536 * ((2 * y + x) % 7 + 0.03) / 7));
    }
  options.idMap = map;
  const auto image = pictureFromAbove(floorOf(numbered(5, 7), options), 12);
  ASSERT_TRUE(image) << image.error().message;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) {
      const int column = x / 3, row = y / 4;
      EXPECT_NEAR(image->at(x, y)[0], float((3 * column + 1) % 5), 1e-3f) << x << ", " << y;
      EXPECT_NEAR(image->at(x, y)[1], float((2 * row + column) % 7), 1e-3f) << x << ", " << y;
    }
}

// What is seen is m·b + (1 − m)·a, and with a second layer that of the first of both.
TEST(BiScale, LayersShowWhatTheirMasksSay) {
  const Rgb below(0.2f, 0.4f, 0.6f), middle(0.9f, 0.1f, 0.3f), above(0.05f, 0.7f, 0.5f);
  asset::Asset asset = floorOf(test::flatRtt(2, 2, 2, 3, below), {});
  test::addLayer(asset, 0, test::flatRtt(3, 2, 1, 3, middle), {}, {0, 64, 128, 255});
  test::addLayer(asset, 0, test::flatRtt(1, 1, 2, 3, above), {}, {0, 255, 0, 128});
  scene::Mesh& upper = asset.scene.meshes[2];
  for (scene::Triangle& t : upper.triangles) t = {t[1], t[2], t[0]};
  std::swap(upper.triangles[0], upper.triangles[1]);
  PictureOptions options;
  options.width = options.height = 16;
  options.samples = 1;
  const auto image = relitPicture(asset, uniformLight(3), {}, fromAbove(), options);
  ASSERT_TRUE(image) << image.error().message;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const Vec2 uv((float(x) + 0.5f) / 16, 0.5f);
      const float first = scene::sampleAlpha(asset.scene.textures[0], uv);
      const float second = scene::sampleAlpha(asset.scene.textures[1], uv);
      const Rgb expected = second * above + (1 - second) * (first * middle + (1 - first) * below);
      EXPECT_LT((image->at(x, y) - expected).abs().maxCoeff(), 1e-4f) << x << ", " << y;
      EXPECT_EQ(image->alpha[std::size_t(y) * 16 + x], 1.0f);
    }
}

TEST(BiScale, ALayerOfTheSamePatchChangesNothing) {
  const transfer::SimulatedRtt rtt = test::bumpyRtt(16, 12, 4, 3);
  const asset::Asset plain = floorOf(rtt, {});
  asset::Asset layered = plain;
  test::addLayer(layered, 0, rtt, {}, {0, 64, 128, 255});
  PictureOptions options;
  options.width = options.height = 32;
  const sh::RgbCoefficients light = unevenLight(3);
  const auto a = relitPicture(plain, light, {}, fromAbove(), options);
  const auto b = relitPicture(layered, light, {}, fromAbove(), options);
  ASSERT_TRUE(a && b);
  for (std::size_t i = 0; i < a->pixels.size(); ++i)
    EXPECT_LT((a->pixels[i] - b->pixels[i]).abs().maxCoeff(), 1e-5f);
}

TEST(MacroTransport, IsTheStoredMatrices) {
  for (const Encoding encoding : {Encoding::Float32, Encoding::Float16, Encoding::Snorm8})
    for (const int channels : {1, 3}) {
      SpreadOptions options;
      options.shadowedBands = 4;
      options.channels = channels;
      options.matrices = encoding;
      asset::Asset asset;
      addPatched(asset, test::sphere(Vec3::Zero(), 1.0f, 6), test::emptyRtt(1, 1, 1, 5), options);
      const BiScale& mesh = std::get<BiScale>(asset.transfer.meshes[0]);
      const sh::RgbCoefficients light = unevenLight(4);
      const auto off = incidentLight(mesh, light, 5, Kind::Unshadowed);
      const auto shadowed = incidentLight(mesh, light, 5, Kind::Shadowed);
      ASSERT_EQ(kindShown(asset.transfer.meshes[0], {}), Kind::Interreflected);
      const auto best = incidentLight(mesh, light, 5, Kind::Interreflected);
      const float tolerance = encoding == Encoding::Snorm8 ? 0.03f : 2e-3f;
      ASSERT_EQ(off.size(), mesh.receivers->size() * 3 * 25);
      for (std::size_t i = 0; i < off.size(); ++i) {
        ASSERT_NEAR(shadowed[i], 0.75f * off[i], tolerance) << i;
        if (i % 25 >= 16) {  // four bands of light
          ASSERT_EQ(off[i], 0.0f);
        }
        const float tint = 0.5f + (channels == 3 ? 0.1f * float(i / 25 % 3) : 0.0f);
        ASSERT_LE(std::abs(best[i]), (tint + 0.1f) * std::abs(off[i]) + tolerance);
        ASSERT_GE(std::abs(best[i]), tint * std::abs(off[i]) - tolerance);
      }
    }
}

TEST(MacroTransport, OfFewerBandsThanTheTextureIsCutThere) {
  SpreadOptions options;
  options.shadowedBands = 2;
  asset::Asset asset;
  addPatched(asset, test::sphere(Vec3::Zero(), 1.0f, 4), test::emptyRtt(1, 1, 1, 3), options);
  const BiScale& mesh = std::get<BiScale>(asset.transfer.meshes[0]);
  const auto wide = incidentLight(mesh, unevenLight(5), 3, Kind::Shadowed);
  const auto off = incidentLight(mesh, unevenLight(5), 3, Kind::Unshadowed);
  const auto narrow = incidentLight(mesh, unevenLight(5), 1, Kind::Shadowed);
  for (std::size_t v = 0; v < wide.size() / 9; ++v) {
    for (std::size_t i = 0; i < 9; ++i)
      ASSERT_NEAR(wide[v * 9 + i], i < 4 ? 0.75f * off[v * 9 + i] : 0.0f, 1e-4f);
    ASSERT_EQ(narrow[v], wide[v * 9]);
  }
}

// What filtering is for: one sample a pixel comes nearer to what many would see, and moves less
// than the nearest look-up when the picture is shifted by half a pixel.
TEST(BiScale, FilteringComesNearerToManySamples) {
  SpreadOptions options;
  options.tiles = Vec2(24, 24);
  asset::Asset asset;
  addPatched(asset, scene::gridPlane(24, 24, 2, 2), test::bumpyRtt(32, 32, 4, 3), options);
  const scene::Camera camera = test::cameraAt(Vec3(0.7f, 1.5f, 13), Vec3(0, -0.6f, 5));
  const sh::RgbCoefficients light = test::sky().project(3);
  const auto rmse = [&](int samples, bool filter, const image::Image* reference) {
    PictureOptions options64;
    options64.width = 64;
    options64.height = 40;
    options64.samples = samples;
    options64.showing.filter = filter;
    auto image = relitPicture(asset, light, {}, camera, options64);
    EXPECT_TRUE(image);
    return std::pair(*image,
                     reference ? image::compare(image->pixels, reference->pixels)->rmse : 0.0);
  };
  const image::Image truth = rmse(256, false, nullptr).first;
  const double nearest = rmse(1, false, &truth).second, filtered = rmse(1, true, &truth).second;
  EXPECT_LT(filtered, 0.5 * nearest);
  EXPECT_LT(rmse(4, true, &truth).second, 0.7 * rmse(4, false, &truth).second);
  const auto mean = [](const image::Image& image) {
    Rgb sum = Rgb::Zero();
    for (const Rgb& pixel : image.pixels) sum += pixel;
    return Rgb(sum / float(image.pixels.size()));
  };
  EXPECT_TRUE(mean(rmse(1, true, &truth).first).isApprox(mean(truth), 0.01f));
}

// The patch's size on the surface: by the texture coordinates' slope, or by the map's stated scale.
TEST(BiScale, FiltersAMapAsItFiltersTextureCoordinates) {
  SpreadOptions options;
  options.tangent = Vec3::UnitX();
  options.tiles = Vec2(4, 4);  // over 2 m: the patch of 1 m at half its size
  const transfer::SimulatedRtt rtt = test::bumpyRtt(32, 32, 4, 3);
  const asset::Asset plain = floorOf(rtt, options);
  options.scale = 0.5f;
  transfer::IdMap map;
  map.width = map.height = 1024;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      map.ids.push_back(std::uint16_t((64 * 4 * x + 128) & 0xffff));
      map.ids.push_back(std::uint16_t(-(64 * 4 * y + 128) & 0xffff));
    }
  options.idMap = map;
  const asset::Asset mapped = floorOf(rtt, options);
  options.scale = 0.125f;
  const asset::Asset misstated = floorOf(rtt, options);

  PictureOptions picture48;
  picture48.width = picture48.height = 48;
  picture48.samples = 1;
  const scene::Camera camera = test::cameraAt(Vec3(0.4f, 1.2f, 5.0f), Vec3::Zero());
  const auto shown = [&](const asset::Asset& asset) {
    return relitPicture(asset, unevenLight(3), {}, camera, picture48);
  };
  const auto a = shown(plain), b = shown(mapped), c = shown(misstated);
  ASSERT_TRUE(a && b && c);
  const double same = image::compare(b->pixels, a->pixels)->rmse,
               other = image::compare(c->pixels, a->pixels)->rmse;
  EXPECT_LT(same, 0.1 * other);
}

// Positions of four pixels each: read at the nearest they are tiles.
TEST(BiScale, ASurfaceNearByHasNoTiles) {
  SpreadOptions options;
  options.tiles = Vec2(1, 1);
  const asset::Asset asset = floorOf(test::bumpyRtt(8, 8, 4, 2), options);
  PictureOptions picture32;
  picture32.width = picture32.height = 32;
  picture32.samples = 1;
  const auto filtered = relitPicture(asset, unevenLight(2), {}, fromAbove(), picture32);
  picture32.showing.filter = false;
  const auto nearest = relitPicture(asset, unevenLight(2), {}, fromAbove(), picture32);
  ASSERT_TRUE(filtered && nearest);
  const auto largestStep = [](const image::Image& picture) {
    float most = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 1; x < 32; ++x)
        most = std::max(most, (picture.at(x, y) - picture.at(x - 1, y)).abs().maxCoeff());
    return most;
  };
  EXPECT_LT(largestStep(*filtered), 0.4f * largestStep(*nearest));
  EXPECT_LT(std::abs(image::compare(filtered->pixels, nearest->pixels)->relativeBias), 0.02);
}

TEST(CheckPicture, SaysWhatDoesNotFit) {
  SpreadOptions options;
  options.idMap = test::patchworkMap(8, 8, Vec2(1, 1));
  options.shadowedBands = 2;
  options.encoding = Encoding::Snorm8;
  const asset::Asset good = floorOf(test::bumpyRtt(4, 4, 2, 2), options);
  const auto check = [](const asset::Asset& asset, const Showing& showing) {
    PictureOptions picture;
    picture.showing = showing;
    return checkPicture(asset, uniformLight(2), {}, picture);
  };
  ASSERT_TRUE(check(good, {}));
  using Change = void (*)(asset::Asset&, BiScale&);
  const std::pair<const char*, Change> ofMeshes[] = {
      {"biScale.rtt: is 3", [](auto&, auto& m) { m.patch.rtt = 3; }},
      {"biScale.rtt: is -1", [](auto&, auto& m) { m.patch.rtt = -1; }},
      {"biScale.tangents: 3 for 4", [](auto&, auto& m) { m.tangents.pop_back(); }},
      {"that of vertex 1", [](auto&, auto& m) { m.tangents[1] = m.receivers->normals[1]; }},
      {"that of vertex 2", [](auto&, auto& m) { m.tangents[2] *= NAN; }},
      {"idMap", [](auto&, auto& m) { std::get<transfer::IdMap>(m.patch.place).ids.pop_back(); }},
      {"biScale.tiles: must be finite and not 0",
       [](auto&, auto& m) { m.patch.place = transfer::Tiles{Vec2(1, 0)}; }},
      {"scale", [](auto&, auto& m) { m.patch.scale = 0; }},
      {"no TEXCOORD_0", [](auto& a, auto&) { a.scene.meshes[0].uvs.clear(); }},
      {"biScale.shadowed: 63 numbers",
       [](auto&, auto& m) { m.matrices.find(Kind::Shadowed)->numbers.single.pop_back(); }},
      {"biScale.bands: is 0", [](auto&, auto& m) { m.bands = 0; }},
      {"and its RTT's 2", [](auto&, auto& m) { m.bands = 1; }},
      {"must have the bands", [](auto&, auto& m) { m.matrices.find(Kind::Shadowed)->inBands = 1; }},
      {"channels is 2",
       [](auto&, auto& m) {
         m.matrices.set(Kind::Interreflected, *m.matrices.find(Kind::Shadowed)).channels = 2;
       }},
      {"needs no matrices",
       [](auto&, auto& m) { m.matrices.set(Kind::Unshadowed, *m.matrices.find(Kind::Shadowed)); }},
      {"receivers must be vertices",
       [](auto&, auto& m) {
         transfer::Receivers receivers = *m.receivers;
         receivers.where = transfer::AtTexels{2, 2, {1, 1, 1, 1}};
         m.receivers = std::make_shared<const transfer::Receivers>(receivers);
       }},
      {"without receivers", [](auto&, auto& m) { m.receivers.reset(); }},
  };
  for (const auto& [words, change] : ofMeshes) {
    asset::Asset bad = good;
    change(bad, std::get<BiScale>(bad.transfer.meshes[0]));
    const Status status = check(bad, {});
    ASSERT_FALSE(status) << words;
    EXPECT_EQ(status.error().kind, ErrorKind::BadInput) << words;
    EXPECT_NE(status.error().message.find(words), std::string::npos) << status.error().message;
    EXPECT_NE(status.error().message.find("mesh 0 (\"floor\")"), std::string::npos);
  }
  using RttChange = void (*)(transfer::EncodedRtt&);
  const std::pair<const char*, RttChange> ofRtts[] = {
      {"numbers where", [](auto& rtt) { rtt.values.byte.pop_back(); }},
      {"one scale for each", [](auto& rtt) { rtt.values.scales.pop_back(); }},
      {"views", [](auto& rtt) { rtt.views = 0; }},
      {"bands", [](auto& rtt) { rtt.bands = 11; }},
      {"size", [](auto& rtt) { rtt.size.x() = 0; }},
  };
  for (const auto& [words, change] : ofRtts) {
    asset::Asset bad = good;
    change(bad.transfer.rtts[0]);
    const Status status = check(bad, {});
    ASSERT_FALSE(status) << words;
    EXPECT_EQ(status.error().kind, ErrorKind::BadInput) << words;
    EXPECT_NE(status.error().message.find(words), std::string::npos) << status.error().message;
    EXPECT_NE(status.error().message.find("rtt 0"), std::string::npos);
  }
  Showing bounced;
  bounced.mesoStructure = Kind::Interreflected;
  const Status status = check(good, bounced);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadUsage);
  EXPECT_NE(status.error().message.find("it holds: unshadowed, shadowed"), std::string::npos);
  EXPECT_NE(status.error().message.find("--transfer interreflected"), std::string::npos);
}

}  // namespace
}  // namespace lambent::shade
