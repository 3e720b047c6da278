#include "lambent/meso/acquired.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "lambent/image/io.h"
#include "lambent/math/random.h"
#include "lambent/meso/light_grid.h"
#include "lambent/sh/coefficients.h"
#include "lambent/sh/zonal.h"

namespace lambent::meso {
namespace {

std::vector<BtfSample> scattered(int count) {
  std::vector<BtfSample> samples;
  math::Random random(5, 1);
  const auto direction = [&]() -> Vec3 {
    const double z = 0.15 + 0.85 * random.uniformDouble(), turn = 2 * kPi * random.uniformDouble();
    const double r = std::sqrt(1 - z * z);
    return Vec3d(r * std::cos(turn), r * std::sin(turn), z).cast<float>();
  };
  for (int k = 0; k < count; ++k) samples.push_back({"", direction(), direction(), k + 2});
  return samples;
}

TEST(BtfInterpolation, IsExactAtTheSamplesAndKeepsConstants) {
  const std::vector<BtfSample> samples = scattered(60);
  const BtfInterpolation interpolation(samples);
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const std::vector<double> w = interpolation.weights(samples[s].view, samples[s].light);
    for (std::size_t k = 0; k < w.size(); ++k) EXPECT_NEAR(w[k], k == s ? 1.0 : 0.0, 1e-9);
  }
  const std::vector<double> between = interpolation.weights(Vec3(0, 0, 1), Vec3(0.6f, 0, 0.8f));
  double sum = 0.0;
  for (const double w : between) sum += w;
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(BtfInterpolation, ComesNearASmoothFunction) {
  const std::vector<BtfSample> samples = scattered(400), probes = scattered(430);
  const BtfInterpolation interpolation(samples);
  const auto f = [](const BtfSample& s) {
    return 0.5 + 0.3 * s.view.x() * s.light.x() + 0.2 * s.light.y();
  };
  double worst = 0.0;
  for (std::size_t p = 400; p < probes.size(); ++p) {
    const std::vector<double> w = interpolation.weights(probes[p].view, probes[p].light);
    double value = 0.0;
    for (std::size_t k = 0; k < w.size(); ++k) value += w[k] * f(samples[k]);
    worst = std::max(worst, std::abs(value - f(probes[p])));
  }
  EXPECT_LT(worst, 0.08);
}

class Acquired : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("lambent-btf-" + std::to_string(getpid()) + "-" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Pictures of a diffuse surface, dark on the left, from three views under twelve lights.
  void measureDiffuse() {
    std::ofstream table(folder_ / "btf.csv");
    table << "# a comment\nlight_phi,file,view_theta,view_phi,light_theta,note\n";
    int number = 0;
    for (const int viewTheta : {0, 40, 70})
      for (const int lightTheta : {10, 45, 75})
        for (const int lightPhi : {0, 90, 180, 270}) {
          image::Image picture(4, 2);
          for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 4; ++x)
              picture.at(x, y) = (x < 2 ? Rgb(0.2f, 0.2f, 0.2f) : Rgb(0.8f, 0.4f, 0.2f)) *
                                 float(std::cos(lightTheta * kPi / 180)) * (y == 0 ? 1.0f : 0.5f);
          const std::string name = "p" + std::to_string(number++) + ".exr";
          ASSERT_TRUE(image::write(picture, folder_ / name));
          table << lightPhi << ", " << name << ", " << viewTheta << ", 30, " << lightTheta
                << ", x\r\n";
        }
  }
  std::string refusal(const std::filesystem::path& path) {
    auto rtt = acquireRtt(path, {}, {});
    EXPECT_FALSE(rtt);
    return rtt ? std::string() : rtt.error().message;
  }
  std::filesystem::path folder_;
};

TEST_F(Acquired, PicturesOfADiffuseSurfaceAreItsCosineLobe) {
  measureDiffuse();
  AcquiredOptions options;
  options.width = 4, options.height = 2, options.views = 3;
  options.polarLights = 32, options.azimuthLights = 32;
  const auto acquired = acquireRtt(folder_, options, {});
  ASSERT_TRUE(acquired) << acquired.error().message;
  const transfer::SimulatedRtt& rtt = acquired->value;
  const sh::ZonalMoments cosine = sh::clampedCosine(5);
  for (int i = 0; i < 25; ++i) {
    const int l = sh::bandOf(i);
    const double y = i == sh::index(l, 0) ? std::sqrt((2 * l + 1) / (4 * kPi)) : 0.0;  // towards +z
    for (int v = 0; v < 9; ++v) {
      const auto at = [&](int x, int row, int c) {
        return double(rtt.values[rtt.index(i, x, row, v % 3, v / 3) + c]);
      };
      EXPECT_NEAR(at(0, 1, 0), 0.2 / kPi * cosine[l] * y, 1e-3) << i;  // far left
      EXPECT_NEAR(at(3, 1, 0), 0.8 / kPi * cosine[l] * y, 1e-3) << i;  // far right
      EXPECT_NEAR(at(3, 1, 1), 0.4 / kPi * cosine[l] * y, 1e-3) << i;
      EXPECT_NEAR(at(3, 0, 0), 0.4 / kPi * cosine[l] * y, 1e-3) << i;  // near right: half as bright
    }
  }
}

TEST_F(Acquired, GapsAndSeamsAreToldOf) {
  measureDiffuse();
  AcquiredOptions options;
  options.width = options.height = 4, options.views = 8;
  const auto acquired = acquireRtt(folder_ / "btf.csv", options, {});
  ASSERT_TRUE(acquired);
  bool views = false;
  for (const Finding& finding : acquired->findings) views = views || finding.code == "sparse-views";
  EXPECT_TRUE(views);  // measured in one half-plane only
}

TEST_F(Acquired, HostileTablesAreRefusedByLine) {
  EXPECT_NE(refusal(folder_).find(".csv"), std::string::npos);  // none there
  EXPECT_NE(refusal(folder_ / "no.csv").find("no.csv"), std::string::npos);
  const auto refusalOf = [&](const std::string& text) {
    std::ofstream(folder_ / "t.csv") << text;
    return refusal(folder_ / "t.csv");
  };
  const std::string header = "file,view_theta,view_phi,light_theta,light_phi\n";
  EXPECT_NE(refusalOf("").find("empty"), std::string::npos);
  EXPECT_NE(refusalOf("file,view_theta\n").find("view_phi"), std::string::npos);
  EXPECT_NE(refusalOf(header + "a.png,0,0,zero,0\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusalOf(header + "a.png,0,0,95,0\n").find("below 90"), std::string::npos);
  EXPECT_NE(refusalOf(header + "a.png,0,0\n").find("light_theta"), std::string::npos);
  EXPECT_NE(refusalOf(header + "a.png,0,0,nan,0\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusalOf(header + "a.png,0,0,1,0\n").find("too few"), std::string::npos);
  std::string many = header;
  for (int k = 0; k < 9; ++k) many += "gone.png,0,0," + std::to_string(9 * k) + ",0\n";
  EXPECT_NE(refusalOf(many).find("gone.png"), std::string::npos);
  EXPECT_NE(refusalOf(many + "x.png,0,0,72,360\n").find("lines 10 and 11"), std::string::npos);
}

TEST_F(Acquired, PicturesOfOtherSizesAreRefused) {
  measureDiffuse();
  ASSERT_TRUE(image::write(image::Image(5, 2), folder_ / "p7.exr"));
  EXPECT_NE(refusal(folder_).find("5×2"), std::string::npos);
}

}  // namespace
}  // namespace lambent::meso
