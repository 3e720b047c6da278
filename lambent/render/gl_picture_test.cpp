// The GL picture against the CPU's. Both sample the same places of every pixel, so inside a surface
// they differ by rounding alone; at silhouettes by whether a sample right on an edge is in.

#include "lambent/render/gl_picture.h"

#include <gtest/gtest.h>

#include "lambent/reference/relit_picture.h"
#include "lambent/render/batches.h"
#include "lambent/render/gl_picture_in_blocks.h"
#include "lambent/render/test_agreement.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"
#include "lambent/shade/test_assets.h"

namespace lambent::render {
namespace {

using shade::PictureOptions;
using shade::test::cameraAt;
using test::expectAgreement;
using test::kCamera;
using test::small;
using transfer::Encoding;

TEST(GlPicture, DiffuseAtVertices) {
  for (const Encoding encoding : {Encoding::Float16, Encoding::Float32})
    for (const int channels : {1, 3})
      for (const int bands : {3, 5}) {
        asset::Asset asset;
        shade::test::addDiffuse(asset, shade::test::sphere(Vec3::Zero(), 1.4f, 12),
                                {bands, channels, encoding, false});
        expectAgreement("diffuse-" + std::to_string(channels) + "-" + std::to_string(bands) +
                            (encoding == Encoding::Float16 ? "-half" : "-single"),
                        asset, kCamera, small(2));
      }
}

TEST(GlPicture, TexturedWithTheBaseColourOutside) {
  asset::Asset asset;
  scene::Mesh mesh = shade::test::sphere(Vec3::Zero(), 1.4f, 12);
  for (Vec2& uv : mesh.uvs) uv = 1.7f * uv - Vec2(0.4f, 0.3f);  // across both wrapping rules
  for (const Vec3& p : mesh.positions) mesh.colors.emplace_back(1.0f, 0.7f + 0.2f * p.y(), 0.9f);
  shade::test::addDiffuse(asset, mesh, {4, 3, Encoding::Float16, true});
  expectAgreement("textured", asset, kCamera, small(4));
}

TEST(GlPicture, EachSideOfASheetIsSeenFromWhereItFaces) {
  asset::Asset asset;
  scene::Mesh sheet = shade::test::floor(Vec3::Zero(), 1.6f);
  sheet = scene::withBacks(scene::rotated(std::move(sheet), Vec3(1, 0.3f, 0), 1.1f));
  shade::test::addDiffuse(asset, sheet, {});
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3(0.3f, 0.2f, 0.1f), 0.5f, 12), {});
  for (const Vec3& eye : {Vec3(1.5f, 1.8f, 5.0f), Vec3(-1.5f, -1.8f, -5.0f), Vec3(1, -4, 2)}) {
    const scene::Camera camera = cameraAt(eye, Vec3::Zero());
    expectAgreement("sheet", asset, camera, small(4));
    const auto picture = reference::relitPicture(
        asset, light::Environment::uniform(Rgb::Ones()).project(5), {}, camera, small(1));
    ASSERT_TRUE(picture);
    for (std::size_t i = 0; i < picture->pixels.size(); ++i) {
      if (picture->alpha[i] == 1.0f) {
        EXPECT_GT(picture->pixels[i].minCoeff(), 0.7f) << eye;
      }
    }
  }
}

/// A sphere before a floor whose texture has an alpha that waves, of this mode.
asset::Asset withGaps(scene::AlphaMode mode) {
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::floor(Vec3(0, -0.5f, 0), 1.8f), {});
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3::Zero(), 1.2f, 16), {.texture = true});
  scene::Texture& texture = asset.scene.textures.back();
  for (std::size_t i = 0; i < texture.rgba.size() / 4; ++i)
    texture.rgba[4 * i + 3] = std::uint8_t(128 + 127 * std::sin(0.9 * double(i)));
  scene::Material& material = asset.scene.materials.back();
  material.alphaMode = mode;
  material.alphaCutoff = 0.4f;
  material.opacity = 0.9f;
  scene::Mesh& mesh = asset.scene.meshes.back();
  mesh.colors.assign(mesh.positions.size(), Rgb::Ones());
  for (const Vec3& p : mesh.positions) mesh.alphas.push_back(0.8f + 0.15f * p.x());
  return asset;
}

TEST(GlPicture, Holes) {
  const asset::Asset asset = withGaps(scene::AlphaMode::Mask);
  // Where a hole ends to the bit is a matter of rounding.
  expectAgreement("holes", asset, kCamera, small(4), {.mean = 0.1, .interior = 0.2});
  PictureOptions whole = small(1);
  const light::Environment sky = shade::test::sky();
  const auto holed = reference::relitPicture(asset, sky.project(5), sky, kCamera, whole);
  asset::Asset opaque = asset;
  opaque.scene.materials.back().alphaMode = scene::AlphaMode::Opaque;
  const auto unholed = reference::relitPicture(opaque, sky.project(5), sky, kCamera, whole);
  ASSERT_TRUE(holed && unholed);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < holed->pixels.size(); ++i)
    changed += (holed->pixels[i] - unholed->pixels[i]).abs().maxCoeff() > 1e-3f;
  EXPECT_GT(changed, holed->pixels.size() / 20);
}

// OpenGL draws a veil in a share of the sub-samples: in the mean it is what rays make of it, and
// with many sub-samples in each pixel nearly so. Layers count by themselves: a ball has two.
TEST(GlPicture, VeilsAreRightOnTheMean) {
  asset::Asset pane;
  shade::test::addDiffuse(pane, shade::test::floor(Vec3(0, -0.5f, 0), 1.8f), {});
  shade::test::addDiffuse(pane, shade::test::sphere(Vec3::Zero(), 1.2f, 16), {});
  pane.scene.materials.back().transmitted = Rgb::Constant(0.5f);
  const light::Environment sky = shade::test::sky();
  for (const asset::Asset& asset : {withGaps(scene::AlphaMode::Blend), pane}) {
    const auto light = sky.project(5);
    const auto rays = reference::relitPicture(asset, light, sky, kCamera, small(64));
    const auto drawn = pictureInBlocks(asset, light, sky, kCamera, small(64), std::size_t(1) << 40);
    ASSERT_TRUE(rays && drawn);
    Rgb sum = Rgb::Zero(), whole = Rgb::Zero();
    double squares = 0, coverage = 0, covered = 0;
    for (std::size_t i = 0; i < rays->pixels.size(); ++i) {
      sum += drawn->pixels[i] - rays->pixels[i];
      whole += rays->pixels[i];
      squares += double((drawn->pixels[i] - rays->pixels[i]).square().mean());
      coverage += double(drawn->alpha[i]) - double(rays->alpha[i]);
      covered += double(rays->alpha[i]);
    }
    EXPECT_LT((sum / whole).abs().maxCoeff(), 0.01f) << (sum / whole).transpose();
    EXPECT_LT(std::abs(coverage / covered), 0.01) << coverage / covered;
    EXPECT_LT(std::sqrt(squares / double(rays->pixels.size())), 0.05);
  }
}

TEST(GlPicture, TexelGrid) {
  asset::Asset asset;
  shade::test::addTexels(asset, shade::test::floor(Vec3::Zero(), 1.6f), Vec3::UnitY(), 16, 11, 0,
                         Encoding::Float16);
  expectAgreement("texels", asset, kCamera, small(4));
}

TEST(GlPicture, TexelsOnCoordinatesOfTheirOwn) {
  asset::Asset asset;
  scene::Mesh mesh = shade::test::floor(Vec3::Zero(), 1.6f);
  for (const Vec2& uv : mesh.uvs) mesh.texelUvs.emplace_back(1.0f - uv.y(), uv.x());
  shade::test::addTexels(asset, mesh, Vec3::UnitY(), 16, 11, 4, Encoding::Float16);
  for (Vec2& uv : asset.scene.meshes[0].uvs) uv = 3.0f * uv - Vec2(0.7f, 0.1f);
  expectAgreement("texel-uvs", asset, kCamera, small(4));
}

TEST(GlPicture, GlossyAtVerticesAndTexels) {
  asset::Asset asset;
  shade::test::addGlossy(asset, shade::test::sphere(Vec3(-1, 0.7f, 0), 0.7f, 12), 5, 4, 1,
                         Encoding::Float16);
  shade::test::addGlossy(asset, shade::test::sphere(Vec3(1, 0.7f, 0), 0.7f, 8), 7, 5, 3,
                         Encoding::Float32);
  shade::test::addTexels(asset, shade::test::floor(Vec3::Zero(), 2.0f), Vec3::UnitY(), 16, 12, 4,
                         Encoding::Float32);
  expectAgreement("glossy", asset, kCamera, small(4));

  PictureOptions sharper = small(1);
  sharper.showing.lobeExponent = 50.0f;
  expectAgreement("glossy-50", asset, kCamera, sharper);
}

TEST(GlPicture, MirrorAndBackground) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3(-0.8f, 0, 0), 0.8f, 24),
                         Rgb(0.9f, 0.8f, 0.7f));
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3(1, 0, 0), 0.7f, 12), {});
  expectAgreement("mirror", asset, kCamera, small(4));
  PictureOptions options = small(4);
  options.background = true;
  expectAgreement("mirror-background", asset, kCamera, options);
}

TEST(GlPicture, OrthographicAndTurnedCameras) {
  asset::Asset asset;
  shade::test::addGlossy(asset, shade::test::sphere(Vec3::Zero(), 1.0f, 12), 4, 4, 1,
                         Encoding::Float32);
  shade::test::addTexels(asset, shade::test::floor(Vec3(0, -1, 0), 1.6f), Vec3::UnitY(), 16, 16, 0,
                         Encoding::Float16);
  scene::Camera orthographic = kCamera;
  orthographic.orthographicHalfHeight = 2.2f;
  expectAgreement("orthographic", asset, orthographic, small(4));
  // From below: the floor shows its back.
  expectAgreement("below", asset, cameraAt(Vec3(3, -2.5f, 3), Vec3::Zero()), small(4));
}

TEST(GlPicture, FallsIntoBlocksWithoutSeams) {
  asset::Asset asset;
  shade::test::addGlossy(asset, shade::test::sphere(Vec3(-1, 0.7f, 0), 0.7f, 12), 5, 4, 1,
                         Encoding::Float16);
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3(1, 0.7f, 0), 0.7f, 12),
                          {5, 3, Encoding::Float32, true});
  shade::test::addTexels(asset, shade::test::floor(Vec3::Zero(), 2.0f), Vec3::UnitY(), 16, 12, 4,
                         Encoding::Float32);
  expectAgreement("blocks", asset, kCamera, small(2), {12'000});
}

TEST(GlPicture, SaysWhatDoesNotFit) {
  asset::Asset asset;
  shade::test::addTexels(asset, shade::test::floor(Vec3::Zero(), 2.0f), Vec3::UnitY(), 16, 12, 4,
                         Encoding::Float32);
  const light::Environment sky = shade::test::sky();
  const auto result =
      pictureInBlocks(asset, sky.project(4), sky, kCamera, small(1), 16 * 4 * 4 * 12);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::Failed);
  EXPECT_NE(result.error().message.find("16×12 texels"), std::string::npos);

  PictureOptions none = small(1);
  none.width = 0;
  const auto bad = render::picture(asset, sky.project(4), sky, kCamera, none);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().kind, ErrorKind::BadUsage);
}

TEST(GlPicture, StopsWhenAsked) {
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3::Zero(), 1.0f, 6), {});
  const light::Environment sky = shade::test::sky();
  int calls = 0;
  const auto result = render::picture(asset, sky.project(5), sky, kCamera, small(16),
                                      [&](const ProgressUpdate&) { return ++calls < 3; });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(calls, 3);
}

TEST(Batches, HoldEveryTriangleOnceWithinTheirLimits) {
  const scene::Mesh mesh = shade::test::sphere(Vec3::Zero(), 1.0f, 12);
  const std::vector<TriangleBatch> batches = splitTriangles(mesh, 40, 30);
  EXPECT_GT(batches.size(), 10u);
  std::vector<scene::Triangle> seen;
  for (const TriangleBatch& batch : batches) {
    EXPECT_LE(batch.vertices.size(), 40u);
    EXPECT_LE(batch.corners.size(), 90u);
    for (std::size_t i = 0; i < batch.corners.size(); i += 3)
      seen.push_back({batch.vertices[batch.corners[i]], batch.vertices[batch.corners[i + 1]],
                      batch.vertices[batch.corners[i + 2]]});
  }
  EXPECT_EQ(seen, mesh.triangles);
}

TEST(Batches, RowBandsCoverTheGrid) {
  for (const std::size_t most : {20u, 35u, 70u, 1000u}) {
    const std::vector<RowBand> bands = splitRows(10, 13, most);
    ASSERT_FALSE(bands.empty());
    int next = 0;
    for (const RowBand& band : bands) {
      EXPECT_EQ(band.begin, next);
      EXPECT_LT(band.begin, band.end);
      EXPECT_EQ(band.last, std::min(band.end, 12));
      EXPECT_LE(std::size_t(band.last - band.begin + 1) * 10, most);
      next = band.end;
    }
    EXPECT_EQ(next, 13);
  }
  EXPECT_TRUE(splitRows(10, 13, 19).empty());
}

}  // namespace
}  // namespace lambent::render
