#include "lambent/sky/sky_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "lambent/math/directions.h"
#include "lambent/sky/interpolation.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sky/table_cache.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

using test::kDegree;

TEST(Splines, GoThroughTheirNodesAndAreSmooth) {
  std::vector<float> values;
  for (int i = 0; i < 12; ++i) values.push_back(float(std::sin(0.6 * i)));
  std::vector<float> splines = values;
  makeSplines(splines, 12);
  const auto at = [&](double x) {
    const Taps taps = splineTaps(x, 12);
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      sum += taps.weight[k] * double(splines[std::size_t(taps.first + k)]);
    return sum;
  };
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(at(i), values[std::size_t(i)], 1e-6);
  for (double x = 3; x < 8; x += 0.25) EXPECT_NEAR(at(x), std::sin(0.6 * x), 2e-3);
  // No kink at a node: slopes on both sides agree.
  for (int i = 1; i < 11; ++i) EXPECT_NEAR(at(i + 1e-3) - at(i), at(i) - at(i - 1e-3), 5e-6) << i;
}

TEST(Splines, CubicsGoThroughTheirNodes) {
  const double values[] = {1, -2, 0.5, 3, 4, -1};
  for (int i = 0; i < 6; ++i) {
    const Taps taps = cubicTaps(i, 6);
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += taps.weight[k] * values[taps.first + k];
    EXPECT_NEAR(sum, values[i], 1e-12);
  }
}

/// One table for all that is asked of it: it takes seconds.
TEST(SkyTables, HoldTheSkyOfEveryPlaceOfTheSun) {
  const Atmosphere atmosphere = *preset("reference");
  const auto table = SkyTable::make(atmosphere, 0);
  ASSERT_TRUE(table);

  // Against the simulation that it was made of, between its nodes.
  const std::vector<double> nm = {450, 550, 650, 720};
  const auto scattering = Scattering::solve(mediumOf(atmosphere, nm), Resolution::fast());
  ASSERT_TRUE(scattering);
  for (const double sun : {-9.3, -3.7, 1.2, 17.3, 52.4}) {
    const auto dome = table->dome(sun * kDegree);
    double squares = 0;
    int count = 0;
    for (const double elevation : {0.7, 4.1, 13.0, 35.0, 77.0})
      for (const double azimuth : {3.0, 47.0, 101.0, 177.0}) {
        const Vec3d s = math::directionFromAzimuthElevation(azimuth * kDegree, elevation * kDegree);
        const Vec3d toSun(std::cos(sun * kDegree), std::sin(sun * kDegree), 0);
        const std::vector<double> truth =
            scattering->radiance({0, s.y(), (90 - sun) * kDegree, s.dot(toSun)});
        double ours[4];
        dome->spectrum(s, nm, ours);
        for (std::size_t i = 0; i < 4; ++i, ++count)
          squares +=
              std::pow(ours[i] / (truth[i] * scattering->medium().solarIrradiance[i]) - 1, 2);
      }
    EXPECT_LT(std::sqrt(squares / count), 0.01) << sun;
  }

  // Its harmonics are those of its colours.
  for (const double sun : {-4.4, 0.3, 41.0}) {
    const auto dome = table->dome(sun * kDegree);
    struct Plain final : Dome {
      std::shared_ptr<const Dome> dome;
      radiometry::Xyzv color(const Vec3d& s) const override { return dome->color(s); }
      void spectrum(const Vec3d& s, std::span<const double> w,
                    std::span<double> out) const override {
        dome->spectrum(s, w, out);
      }
    } plain;
    plain.dome = dome;
    const std::vector<double> tabulated = projectDome(*dome, 0, 5),
                              integrated = projectDome(plain, 0, 5);
    for (std::size_t i = 0; i < tabulated.size(); ++i)
      EXPECT_NEAR(tabulated[i], integrated[i], 2e-3 * integrated[i / 25 * 25]) << sun << ' ' << i;
  }

  // What its nodes hold makes the sky in their directions.
  const std::vector<double> suns = table->sunElevations();
  EXPECT_NEAR(suns.front(), kPi / 2, 1e-6);
  EXPECT_LE(suns.back(), kLowestSun + 1e-6);
  for (const double sun : {suns[20], -4.4 * kDegree}) {
    const std::vector<SkyTable::NodeColor> colors = table->nodeColors(sun);
    const ViewGrid& view = table->view();
    ASSERT_EQ(colors.size(), std::size_t(view.nodes()));
    const Vec3d toSun(std::cos(sun), std::sin(sun), 0);
    for (const int row : {2, 11, 23})
      for (const int column : {0, 7, 18}) {
        const Vec3d s =
            math::directionFromAzimuthElevation(view.azimuth(column), view.elevation(row));
        const auto& [rest, aerosols] = colors[std::size_t(row * view.azimuths + column)];
        const radiometry::Xyzv expected =
            rest + media::evaluate(atmosphere.aerosolPhase, s.dot(toSun)) * aerosols;
        const radiometry::Xyzv seen = table->dome(sun)->color(s);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(seen[c] / expected[c], 1, 1e-4) << row << column;
      }
  }

  // Smooth and monotone while the Sun sets, to the end of twilight.
  const double degree = 0.1 * kDegree;
  for (const double elevation : {1.0, 30.0, 90.0}) {
    double before = 0, twoBefore = 0;
    for (int i = 0; i <= 280; ++i) {
      const double sun = 10 * kDegree - i * degree;
      const double y = std::log(table->dome(sun)->color(
          math::directionFromAzimuthElevation(kPi, elevation * kDegree))[1]);
      ASSERT_TRUE(std::isfinite(y));
      if (i > 1) {
        EXPECT_LT(std::abs(y - 2 * before + twoBefore), 0.015) << sun / kDegree;
        if (sun < 0) {
          EXPECT_LT(y, before) << sun / kDegree;
        }
      }
      twoBefore = before;
      before = y;
    }
  }

  // As bytes and back; and nothing of another altitude, atmosphere or length.
  const std::vector<std::byte> bytes = table->bytes();
  EXPECT_LT(bytes.size(), 8u << 20);
  const auto again = SkyTable::fromBytes(bytes, atmosphere, 0);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->bytes(), bytes);
  EXPECT_FALSE(SkyTable::fromBytes(bytes, atmosphere, 1));
  EXPECT_FALSE(SkyTable::fromBytes(bytes, *preset("clear"), 0));
  EXPECT_FALSE(SkyTable::fromBytes(std::span(bytes).first(bytes.size() - 4), atmosphere, 0));

  // On disk, and not trusted when a byte of it has changed.
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "lambent-sky-table-test";
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(readTable(folder, atmosphere, 0));
  ASSERT_TRUE(keepTable(folder, atmosphere, *table));
  EXPECT_TRUE(readTable(folder, atmosphere, 0));
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::FILE* file = std::fopen(entry.path().c_str(), "r+b");
    ASSERT_TRUE(file);
    std::fseek(file, 100000, SEEK_SET);
    std::fputc('x', file);
    std::fputc('y', file);
    std::fclose(file);
  }
  EXPECT_FALSE(readTable(folder, atmosphere, 0));
  std::filesystem::remove_all(folder);
}

TEST(MakeSky, SaysWhatIsOutOfRange) {
  const auto refused = [](auto change) {
    SkyOptions options;
    options.model = Model::Preetham;
    options.sunElevation = 0.5;
    change(options);
    const auto sky = makeSky(options);
    return !sky && sky.error().kind == ErrorKind::BadUsage;
  };
  EXPECT_FALSE(refused([](SkyOptions&) {}));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.sunElevation = -0.33; }));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.sunElevation = std::nan(""); }));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.altitude = -1; }));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.altitude = 1e7; }));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.sunDistance = 0; }));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.cieType = 16; }));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.wavelengths = {339}; }));
  EXPECT_TRUE(refused([](SkyOptions& o) { o.directNormalIrradiance = std::nan(""); }));
}

}  // namespace
}  // namespace lambent::sky
