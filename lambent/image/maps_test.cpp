#include "lambent/image/maps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numeric>

#include "lambent/image/test_pictures.h"

namespace lambent::image {
namespace {

const MapShape kShapes[] = {
    {MapKind::LatLong, 64, 32},    {MapKind::LatLong, 33, 20}, {MapKind::Cube, 16, 96},
    {MapKind::Cube, 96, 16},       {MapKind::Cube, 64, 48},    {MapKind::Cube, 48, 64},
    {MapKind::Cube, 1, 6},         {MapKind::Angular, 32, 32}, {MapKind::Angular, 31, 31},
    {MapKind::MirrorBall, 32, 32}, {MapKind::MirrorBall, 7, 7}};

std::string nameOf(const MapShape& shape) {
  return "kind " + std::to_string(static_cast<int>(shape.kind)) + ", " +
         std::to_string(shape.width) + "×" + std::to_string(shape.height);
}

Vec3d randomDirection(Sequence& sequence) {
  const double z = 2.0 * sequence.next() - 1.0, a = 2 * kPi * sequence.next();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

TEST(Maps, SolidAnglesSumToTheSphere) {
  for (const MapShape& shape : kShapes) {
    const std::vector<double> angles = solidAngles(shape);
    ASSERT_EQ(angles.size(), size_t(shape.width) * shape.height);
    EXPECT_NEAR(std::accumulate(angles.begin(), angles.end(), 0.0), 4 * kPi, 1e-11)
        << nameOf(shape);
    for (const double angle : angles) EXPECT_GE(angle, 0.0);
  }
}

TEST(Maps, SolidAnglesAreThoseOfTheDirections) {
  // Each pixel's solid angle against the Jacobian of directionOf, by a fine grid of samples.
  for (const MapShape& shape : {MapShape{MapKind::LatLong, 12, 6}, MapShape{MapKind::Cube, 3, 18},
                                MapShape{MapKind::Cube, 9, 12}, MapShape{MapKind::Angular, 6, 6},
                                MapShape{MapKind::MirrorBall, 6, 6}}) {
    const std::vector<double> angles = solidAngles(shape);
    constexpr int kGrid = 64;
    constexpr double kStep = 1.0 / kGrid;
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        double sum = 0;
        for (int k = 0; k < kGrid * kGrid; ++k) {
          const Vec2d at(x + (k % kGrid + 0.5) * kStep, y + (k / kGrid + 0.5) * kStep);
          const double e = 1e-4;
          const auto right = directionOf(shape, at + Vec2d(e, 0));
          const auto left = directionOf(shape, at - Vec2d(e, 0));
          const auto below = directionOf(shape, at + Vec2d(0, e));
          const auto above = directionOf(shape, at - Vec2d(0, e));
          if (!right || !left || !below || !above) continue;
          sum += (*right - *left).cross(*below - *above).norm() / (4 * e * e) * kStep * kStep;
        }
        EXPECT_NEAR(angles[size_t(y) * shape.width + x], sum, 5e-3)
            << nameOf(shape) << " pixel " << x << ", " << y;
      }
    }
  }
}

TEST(Maps, PixelAndDirectionAreInverse) {
  for (const MapShape& shape : kShapes) {
    Sequence sequence(7);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d direction = randomDirection(sequence);
      const Vec2d pixel = pixelOf(shape, direction);
      ASSERT_GE(pixel.minCoeff(), 0.0);
      ASSERT_LE(pixel.x(), shape.width);
      ASSERT_LE(pixel.y(), shape.height);
      const std::optional<Vec3d> back = directionOf(shape, pixel);
      ASSERT_TRUE(back) << nameOf(shape);
      // A mirrored ball packs all that lies behind it into its rim: there, digits are lost.
      EXPECT_LT((*back - direction).norm(), 1e-6) << nameOf(shape);
    }
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const Vec2d centre(x + 0.5, y + 0.5);
        const std::optional<Vec3d> direction = directionOf(shape, centre);
        if (!direction) continue;
        EXPECT_NEAR(direction->norm(), 1.0, 1e-12);
        EXPECT_LT((pixelOf(shape, *direction) - centre).norm(), 1e-6) << nameOf(shape);
      }
    }
  }
}

TEST(Maps, LatLongConvention) {
  const MapShape shape{MapKind::LatLong, 8, 4};
  EXPECT_LT((pixelOf(shape, {1, 0, 0}) - Vec2d(4, 2)).norm(), 1e-12);
  EXPECT_LT((pixelOf(shape, {0, 0, 1}) - Vec2d(6, 2)).norm(), 1e-12);
  EXPECT_LT((pixelOf(shape, {0, 0, -1}) - Vec2d(2, 2)).norm(), 1e-12);
  EXPECT_NEAR(pixelOf(shape, {0, 1, 0}).y(), 0, 1e-12);
  EXPECT_NEAR(pixelOf(shape, {0, -1, 0}).y(), 4, 1e-12);
}

TEST(Maps, AngularConvention) {
  for (const MapKind kind : {MapKind::Angular, MapKind::MirrorBall}) {
    const MapShape shape{kind, 10, 10};
    EXPECT_LT((pixelOf(shape, {0, 0, 1}) - Vec2d(5, 5)).norm(), 1e-12);
    const double r = kind == MapKind::Angular ? 0.5 : std::sqrt(0.5);
    EXPECT_LT((pixelOf(shape, {1, 0, 0}) - Vec2d(5 + 5 * r, 5)).norm(), 1e-12);
    EXPECT_LT((pixelOf(shape, {0, 1, 0}) - Vec2d(5, 5 - 5 * r)).norm(), 1e-12);
    EXPECT_NEAR((pixelOf(shape, {0, 0, -1}) - Vec2d(5, 5)).norm(), 5, 1e-12);
    EXPECT_FALSE(directionOf(shape, {0.2, 0.2}));
  }
}

TEST(Maps, CubeFacesAndCrosses) {
  const MapShape column{MapKind::Cube, 2, 12};
  const Vec3d axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int f = 0; f < 6; ++f) {
    EXPECT_LT((*directionOf(column, {1, 2 * f + 1}) - axes[f]).norm(), 1e-12) << f;
  }
  // OpenGL: the top left corner of +x looks to (1, 1, 1), that of +y to (−1, 1, −1).
  EXPECT_LT((*directionOf(column, {0, 0}) - Vec3d(1, 1, 1).normalized()).norm(), 1e-12);
  EXPECT_LT((*directionOf(column, {1e-9, 4 + 1e-9}) - Vec3d(-1, 1, -1).normalized()).norm(), 1e-8);
  // In a cross, directions run on from cell to cell.
  for (const MapShape& cross : {MapShape{MapKind::Cube, 40, 30}, MapShape{MapKind::Cube, 30, 40}}) {
    for (int y = 0; y < cross.height; ++y) {
      for (int x = 0; x < cross.width; ++x) {
        const auto here = directionOf(cross, {x + 0.5, y + 0.5});
        const auto right = directionOf(cross, {x + 1.5, y + 0.5});
        const auto below = directionOf(cross, {x + 0.5, y + 1.5});
        if (here && right) {
          EXPECT_LT((*here - *right).norm(), 0.21) << x << " " << y;
        }
        if (here && below) {
          EXPECT_LT((*here - *below).norm(), 0.21) << x << " " << y;
        }
      }
    }
  }
}

TEST(Maps, ShapesAreCheckedAndGuessed) {
  EXPECT_FALSE(checkShape({MapKind::Cube, 16, 16}));
  EXPECT_FALSE(checkShape({MapKind::Angular, 16, 15}));
  EXPECT_FALSE(checkShape({MapKind::LatLong, 0, 15}));
  EXPECT_NE(checkShape({MapKind::Angular, 16, 15}).error().message.find("square"),
            std::string::npos);
  EXPECT_EQ(guessKind(512, 256), MapKind::LatLong);
  EXPECT_EQ(guessKind(256, 256), MapKind::Angular);
  EXPECT_EQ(guessKind(64, 384), MapKind::Cube);
  EXPECT_EQ(guessKind(96, 128), MapKind::Cube);
  EXPECT_EQ(guessKind(123, 45), std::nullopt);
}

Rgb smoothRadiance(const Vec3d& d) {
  return Rgb(1 + static_cast<float>(d.x()), 1 + static_cast<float>(d.y() * d.z()),
             2 - static_cast<float>(d.z()));
}

TEST(Maps, SamplesInterpolateEverywhere) {
  for (const MapShape& shape :
       {MapShape{MapKind::LatLong, 128, 64}, MapShape{MapKind::Cube, 48, 288},
        MapShape{MapKind::Cube, 144, 192}, MapShape{MapKind::Angular, 128, 128}}) {
    const Image image = paint(shape, smoothRadiance);
    Sequence sequence(9);
    float worst = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3d d =
          i < 2000 ? randomDirection(sequence)
                   : Vec3d(Vec3d(0, i % 2 ? 1 : -1, i % 3 - 1.0) * 20 + randomDirection(sequence))
                         .normalized();  // poles, edges, rim
      worst = std::max(worst, (sample(image, shape.kind, d) - smoothRadiance(d)).abs().maxCoeff());
    }
    EXPECT_LT(worst, shape.kind == MapKind::LatLong ? 0.02f : 0.04f) << nameOf(shape);
  }
}

TEST(Maps, SamplesAtCentresAreThePixels) {
  for (const MapShape& shape : kShapes) {
    const Image image = paint(shape, smoothRadiance);
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const auto d = directionOf(shape, {x + 0.5, y + 0.5});
        if (d) {
          EXPECT_LT((sample(image, shape.kind, *d) - image.at(x, y)).abs().maxCoeff(), 1e-5f);
        }
      }
    }
  }
}

TEST(Maps, ResampleThereAndBack) {
  const MapShape latLong{MapKind::LatLong, 128, 64};
  const Image image = paint(latLong, smoothRadiance);
  for (const MapShape& other : {MapShape{MapKind::Cube, 48, 288}, MapShape{MapKind::Cube, 160, 120},
                                MapShape{MapKind::Angular, 160, 160}}) {
    const Image there = resample(image, MapKind::LatLong, other);
    const Image back = resample(there, other.kind, latLong);
    float worst = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      worst = std::max(worst, (back.pixels[i] - image.pixels[i]).abs().maxCoeff());
    }
    EXPECT_LT(worst, 0.05f) << nameOf(other);
  }
}

}  // namespace
}  // namespace lambent::image
