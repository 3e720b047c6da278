#include "lambent/sky/sky_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "lambent/sky/sun_coverage.h"

namespace lambent::sky {
namespace {

/// Each direction has a colour and a spectrum of its own.
class Rainbow : public Dome {
 public:
  radiometry::Xyzv color(const Vec3d& d) const override {
    return {1000 * (2 + d.x()), 1000 * (2 + d.y()), 1000 * (2 + d.z()), 500 + 100 * d.y()};
  }
  void spectrum(const Vec3d& d, std::span<const double> wavelengths,
                std::span<double> radiance) const override {
    for (size_t i = 0; i < radiance.size(); ++i) radiance[i] = wavelengths[i] * (2 + d.x());
  }
};
class Night : public Dome {
 public:
  radiometry::Xyzv color(const Vec3d&) const override { return radiometry::Xyzv::Zero(); }
  void spectrum(const Vec3d&, std::span<const double>, std::span<double> radiance) const override {
    std::fill(radiance.begin(), radiance.end(), 0.0);
  }
};

Sky skyWith(std::shared_ptr<const Dome> dome, double sunElevation) {
  Sky sky;
  sky.dome = std::move(dome);
  sky.sun.elevation = sunElevation;
  sky.sun.angularRadius = 0.00465;
  sky.sun.irradiance = {90000, 100000, 80000, 200000};
  sky.wavelengths = {400, 500, 700};
  sky.sun.spectralIrradiance = {1, 2, 1.5};
  sky.groundRadiance = {0.1, 0.2, 0.1};
  sky.ground = {10, 20, 30, 40};
  return sky;
}

/// The Sun at a compass bearing.
Mat3d worldFromSun(double bearing) {
  // +x of the Sun's frame to (sin b, 0, −cos b).
  return Eigen::AngleAxisd(kPi / 2 - bearing, Vec3d::UnitY()).toRotationMatrix();
}

const std::vector<float>& channel(const image::ChannelImage& picture, const std::string& name) {
  for (const auto& each : picture.channels)
    if (each.name == name) return each.values;
  static const std::vector<float> none;
  ADD_FAILURE() << "no channel " << name;
  return none;
}

image::ChannelImage drawn(const Sky& sky, const SkyPictureOptions& options) {
  const auto picture = drawSky(sky, options);
  EXPECT_TRUE(picture) << picture.error().message;
  return *picture;
}

const PictureShape kShapes[] = {{PictureMap::LatLong, 64, 32},
                                {PictureMap::LatLong, 16, 8},
                                {PictureMap::LatLong, 1000, 500},
                                {PictureMap::Fisheye, 64, 64},
                                {PictureMap::Fisheye, 401, 401},
                                {PictureMap::Cube, 96, 16},
                                {PictureMap::Cube, 16, 96},
                                {PictureMap::Cube, 256, 192},
                                {PictureMap::Cube, 192, 256},
                                {PictureMap::Camera, 120, 80, 1.0, 0.4, 1.2},
                                {PictureMap::Camera, 300, 200, 1.0, 0.8, 0.02}};

TEST(PictureShape, NorthEastAndUp) {
  const auto looks = [](const PictureShape& shape, double u, double v, const Vec3d& direction) {
    const auto d = directionOf(shape, {u * shape.width, v * shape.height});
    ASSERT_TRUE(d);
    EXPECT_LT((*d - direction).norm(), 1e-9) << u << " " << v << ": " << d->transpose();
  };
  const Vec3d north(0, 0, -1), east(1, 0, 0), south(0, 0, 1), west(-1, 0, 0), up(0, 1, 0);
  const PictureShape map{PictureMap::LatLong, 64, 32};
  looks(map, 0.25, 0.5, north);
  looks(map, 0.5, 0.5, east);
  looks(map, 0.75, 0.5, south);
  const PictureShape fisheye{PictureMap::Fisheye, 64, 64};
  looks(fisheye, 0.5, 0.5, up);
  looks(fisheye, 0.5, 0, north);
  looks(fisheye, 0, 0.5, east);
  looks(fisheye, 1, 0.5, west);
  looks(fisheye, 0.25, 0.5, (east + up).normalized());  // equidistant: 45° at half the radius
  EXPECT_FALSE(directionOf(fisheye, {1, 1}));
  PictureShape camera{PictureMap::Camera, 60, 40, kPi / 2, 0, kPi / 2};
  looks(camera, 0.5, 0.5, east);
  looks(camera, 0.5, 0, (east + up).normalized());
  looks(camera, 5.0 / 6, 0.5, (east + south).normalized());
  camera.lookElevation = kPi / 2;  // lying down, its top to the west
  looks(camera, 0.5, 0.5, up);
  looks(camera, 0.5, 0, (up + west).normalized());
  const PictureShape cube{PictureMap::Cube, 96, 16};
  looks(cube, 0.5 / 6, 0.5, east);
  looks(cube, 2.5 / 6, 0.5, up);
  looks(cube, 5.5 / 6, 0.5, north);
}

TEST(PictureShape, SolidAnglesSum) {
  for (const PictureShape& shape : kShapes) {
    double sum = 0;
    for (int y = 0; y < shape.height; ++y)
      for (int x = 0; x < shape.width; ++x)
        if (directionOf(shape, {x + 0.5, y + 0.5})) sum += solidAngleOf(shape, x, y);
    switch (shape.map) {
      case PictureMap::Fisheye:  // its rim is jagged
        EXPECT_NEAR(sum, 2 * kPi, 2 * kPi * 1.0 / shape.width);
        break;
      case PictureMap::Camera: {
        const double b = std::tan(shape.verticalFov / 2), a = b * shape.width / shape.height;
        EXPECT_NEAR(sum / (4 * std::atan2(a * b, std::sqrt(a * a + b * b + 1))), 1, 1e-7);
        break;
      }
      default:
        EXPECT_NEAR(sum, 4 * kPi, 1e-6);
    }
  }
}

TEST(PictureShape, NoPointOfAPixelIsFartherThanItsRadius) {
  for (const PictureShape& shape : kShapes) {
    for (int y = 0; y < shape.height; y += 1 + shape.height / 9) {
      for (int x = 0; x < shape.width; x += 1 + shape.width / 9) {
        const auto centre = directionOf(shape, {x + 0.5, y + 0.5});
        if (!centre) continue;
        for (const Vec3d& d : outlineOf(shape, x, y, 3))
          EXPECT_LE(std::acos(std::min(d.dot(*centre), 1.0)), pixelRadius(shape) * 1.0001);
      }
    }
  }
}

TEST(SkyPicture, PixelsAreWhatStandsInTheirDirection) {
  const Sky sky = skyWith(std::make_shared<Rainbow>(), 0.5);
  for (const PictureShape& shape : kShapes) {
    SkyPictureOptions options;
    options.shape = shape;
    options.worldFromSun = worldFromSun(2.0);
    options.quantity = Quantity::Xyzv;
    const image::ChannelImage picture = drawn(sky, options);
    ASSERT_EQ(picture.width, shape.width);
    const bool voids = picture.channels.back().name == "A";
    EXPECT_EQ(voids, shape.map == PictureMap::Fisheye ||
                         (shape.map == PictureMap::Cube && shape.width * 6 != shape.height &&
                          shape.height * 6 != shape.width));
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const auto world = directionOf(shape, {x + 0.5, y + 0.5});
        const size_t at = size_t(y) * size_t(shape.width) + size_t(x);
        if (!world) continue;
        const Vec3d d = options.worldFromSun.transpose() * *world;
        if (std::abs(std::asin(d.y())) < pixelRadius(shape)) continue;  // means
        const radiometry::Xyzv expected = sky.dome->color(d);
        for (size_t c = 0; c < 4; ++c)
          ASSERT_NEAR(picture.channels[c].values[at], expected[Eigen::Index(c)], 1e-3);
        if (voids) {
          ASSERT_EQ(picture.channels.back().values[at], 1.0f);
        }
      }
    }
  }
}

TEST(SkyPicture, TheSunIsWhereItIs) {
  // In the south-east, in the fisheye left of the middle and below it.
  const double elevation = 0.6, bearing = 0.763 * kPi;
  const Sky sky = skyWith(std::make_shared<Night>(), elevation);
  SkyPictureOptions options;
  options.worldFromSun = worldFromSun(bearing);
  options.quantity = Quantity::Luminance;
  options.sun = true;
  const auto brightest = [&] {
    const image::ChannelImage picture = drawn(sky, options);
    const std::vector<float>& y = channel(picture, "Y");
    const auto at = std::max_element(y.begin(), y.end()) - y.begin();
    return Eigen::Vector2i(int(at % picture.width), int(at / picture.width));
  };
  options.shape = {PictureMap::Fisheye, 200, 200};
  const double r = (kPi / 2 - elevation) / (kPi / 2);
  EXPECT_EQ(brightest(), Eigen::Vector2i(int(100 - 100 * r * std::sin(bearing)),
                                         int(100 - 100 * r * std::cos(bearing))));
  options.shape = {PictureMap::LatLong, 200, 100};
  EXPECT_EQ(brightest(),
            Eigen::Vector2i(int(200 * (0.25 + 0.763 / 2)), int(100 * (0.5 - elevation / kPi))));
}

TEST(SkyPicture, TheSunsEnergyIsRightAtAnyResolution) {
  for (const double elevation : {0.8, 0.8041, 1.5, kPi / 2, 0.002, 0.0}) {
    const Sky sky = skyWith(std::make_shared<Night>(), elevation);
    for (const PictureShape& shape : kShapes) {
      if (shape.map == PictureMap::Camera && std::abs(elevation - 0.8) > 0.01) continue;
      SkyPictureOptions options;
      options.shape = shape;
      options.worldFromSun = worldFromSun(1.0);
      options.quantity = Quantity::Spectral;
      options.wavelengths = {450, 600};
      options.sun = true;
      const image::ChannelImage picture = drawn(sky, options);
      double blue = 0, red = 0, luminance = 0;
      const std::vector<float>&r = channel(picture, "R"), &g = channel(picture, "G"),
            &b = channel(picture, "B"), &s450 = channel(picture, "S0.450,000000nm"),
            &s600 = channel(picture, "S0.600,000000nm");
      for (int y = 0; y < shape.height; ++y) {
        for (int x = 0; x < shape.width; ++x) {
          const size_t at = size_t(y) * size_t(shape.width) + size_t(x);
          const double angle = solidAngleOf(shape, x, y);
          blue += angle * double(s450[at]);
          red += angle * double(s600[at]);
          luminance +=
              angle * (0.2126 * double(r[at]) + 0.7152 * double(g[at]) + 0.0722 * double(b[at]));
        }
      }
      EXPECT_NEAR(blue / 1.5, 1, 2e-6) << int(shape.map) << " " << shape.width << " " << elevation;
      EXPECT_NEAR(red / 1.75, 1, 2e-6) << int(shape.map) << " " << shape.width << " " << elevation;
      EXPECT_NEAR(luminance * 683.002 / 100000, 1, 2e-6) << int(shape.map) << " " << elevation;
    }
  }
}

TEST(SkyPicture, TheSunDarkensTowardsItsLimbAndReddens) {
  const Sky sky = skyWith(std::make_shared<Night>(), 0.8);
  SkyPictureOptions options;
  options.shape = {PictureMap::Camera, 101, 101, 1.0, 0.8, 2 * 0.00465 * 1.1};
  options.worldFromSun = worldFromSun(1.0);
  options.quantity = Quantity::Spectral;
  options.wavelengths = {450, 600};
  options.sun = true;
  const image::ChannelImage picture = drawn(sky, options);
  const auto at = [&](const char* name, int x, int y) {
    return double(channel(picture, name)[size_t(y) * 101 + size_t(x)]);
  };
  for (const char* name : {"S0.450,000000nm", "S0.600,000000nm"}) {
    const double alpha = limbDarkening(name[3] == '4' ? 450 : 600);
    // 40 pixels from the centre are so many radii.
    const double rho = 40 / 50.5 * 1.1, expected = std::pow(1 - rho * rho, alpha / 2);
    EXPECT_NEAR(at(name, 90, 50) / at(name, 50, 50), expected, 2e-3);
    EXPECT_NEAR(at(name, 50, 10) / at(name, 50, 50), expected, 2e-3);
    EXPECT_EQ(at(name, 0, 0), 0);
  }
  // In the centre: irradiance over solid angle, times 1 + α/2.
  const double mean = 1.5 / (kPi * 0.00465 * 0.00465);
  EXPECT_NEAR(at("S0.450,000000nm", 50, 50) / mean, 1 + limbDarkening(450) / 2, 2e-4);
}

TEST(SkyPicture, BelowTheHorizon) {
  Sky sky = skyWith(std::make_shared<Rainbow>(), 0.5);
  sky.horizon = -0.15;
  SkyPictureOptions options;
  options.shape = {PictureMap::LatLong, 64, 32};
  options.quantity = Quantity::Luminance;
  const auto column = [&](BelowHorizon below) {
    options.below = below;
    const auto picture = drawn(sky, options);
    std::vector<double> values;
    for (size_t y = 0; y < 32; ++y) values.push_back(double(channel(picture, "Y")[y * 64 + 32]));
    return values;
  };
  const auto dome = column(BelowHorizon::Dome), ground = column(BelowHorizon::Ground),
             black = column(BelowHorizon::Black);
  for (size_t y = 0; y < 16; ++y) {
    EXPECT_EQ(ground[y], dome[y]);
    EXPECT_EQ(black[y], dome[y]);
  }
  for (size_t y = 19; y < 32; ++y) {
    EXPECT_GT(dome[y], 900);
    EXPECT_EQ(ground[y], 20);
    EXPECT_EQ(black[y], 0);
  }
  // The row from −.098 to −.196 rad has the horizon in it: half of its subpixels stand below.
  EXPECT_NEAR(black[17] / dome[17], 0.5, 0.02);
}

TEST(SkyPicture, TheRimOfAFisheyeIsSky) {
  Sky sky = skyWith(std::make_shared<Rainbow>(), 0.5);
  SkyPictureOptions options;
  options.shape = {PictureMap::Fisheye, 101, 101};
  options.quantity = Quantity::Luminance;
  options.below = BelowHorizon::Black;
  const auto picture = drawn(sky, options);
  for (size_t i = 0; i < picture.channels[0].values.size(); ++i) {
    if (picture.channels[1].values[i] > 0) {
      EXPECT_GE(picture.channels[0].values[i], 2000);
    }
  }
}

TEST(SkyPicture, SightAgrees) {
  const Sky sky = skyWith(std::make_shared<Rainbow>(), 0.5);
  const std::vector<double> nm{450, 800};
  std::vector<double> got(2);
  spectrumSeen(sky, BelowHorizon::Ground, {0, -1, 0}, nm, got);
  EXPECT_DOUBLE_EQ(got[0], 0.15);
  EXPECT_DOUBLE_EQ(got[1], 0.1);
  spectrumSeen(sky, BelowHorizon::Ground, {1, 0.1, 0}, nm, got);
  EXPECT_DOUBLE_EQ(got[0], 450 * 3.0);
  EXPECT_EQ(belowHorizonOf(Model::Fast), BelowHorizon::Dome);
  EXPECT_EQ(belowHorizonOf(Model::Preetham), BelowHorizon::Ground);
}

TEST(SkyPicture, NoChannelIsNegativeAndLuminanceStays) {
  // Monochromatic red, green, blue; white; black.
  for (const radiometry::Xyzv& xyzv :
       {radiometry::Xyzv(0.64, 0.265, 0.0, 0.0), radiometry::Xyzv(0.06, 0.71, 0.16, 1.0),
        radiometry::Xyzv(0.35, 0.06, 1.78, 0.5), radiometry::Xyzv(0.95, 1, 1.09, 2),
        radiometry::Xyzv(0, 0, 0, 0)}) {
    const Rgb rgb = radianceRgb(xyzv);
    EXPECT_GE(rgb.minCoeff(), 0);
    EXPECT_NEAR(683.002 * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]), xyzv[1], 1e-6);
  }
}

TEST(SkyPicture, WhatCannotBeDrawn) {
  const Sky sky = skyWith(std::make_shared<Night>(), 0.5);
  SkyPictureOptions options;
  const auto refused = [&](const PictureShape& shape, const char* says) {
    options.shape = shape;
    const auto picture = drawSky(sky, options);
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().kind, ErrorKind::BadUsage);
    EXPECT_NE(picture.error().message.find(says), std::string::npos) << picture.error().message;
  };
  refused({PictureMap::LatLong, 64, 33}, "twice as wide as high");
  refused({PictureMap::Fisheye, 64, 32}, "square");
  refused({PictureMap::Cube, 64, 32}, "six squares");
  refused({PictureMap::Camera, 64, 4}, "at least 8");
  options.quantity = Quantity::Spectral;
  options.wavelengths.assign(401, 0);
  for (int i = 0; i < 401; ++i) options.wavelengths[size_t(i)] = 340 + i;
  refused({PictureMap::LatLong, 2048, 1024}, "fewer wavelengths");
  options.shape = {PictureMap::LatLong, 64, 32};
  const auto cancelled = drawSky(sky, options, [](const ProgressUpdate&) { return false; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(SkyPicture, NamesOfChannels) {
  EXPECT_EQ(spectralChannel(550), "S0.550,000000nm");
  EXPECT_EQ(spectralChannel(442.5), "S0.442,500000nm");
}

}  // namespace
}  // namespace lambent::sky
