#include "lambent/sky/make_aerial_perspective.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lambent/sky/table_cache.h"

namespace lambent::sky {
namespace {

/// Gone with the test.
struct CacheFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      (std::string("lambent-") + testing::UnitTest::GetInstance()->current_test_info()->name());
  CacheFolder() { std::filesystem::remove_all(path); }
  ~CacheFolder() { std::filesystem::remove_all(path); }
  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(path))
      found.push_back(entry.path());
    return found;
  }
};

const std::vector<double> kWavelengths = {450, 550, 650};

Resolution coarse() {
  Resolution r;
  r.orders = 2;
  r.altitudes = 6;
  r.upward = r.downward = r.around = 4;
  r.zeniths = r.azimuths = 7;
  r.sunFrom = 1.1;
  r.sunTo = 1.4;
  return r;
}

TEST(AirCache, GivesBackWhatWasSolved) {
  const Atmosphere air = *preset("clear");
  const auto solved = Scattering::solve(mediumOf(air, kWavelengths), coarse());
  ASSERT_TRUE(solved);
  const CacheFolder folder;
  EXPECT_FALSE(readScattering(folder.path, air, kWavelengths, coarse()));
  EXPECT_FALSE(readScattering("", air, kWavelengths, coarse()));
  ASSERT_TRUE(keepScattering("", air, *solved));
  EXPECT_FALSE(keepScattering("/dev/null/cache", air, *solved));
  ASSERT_TRUE(keepScattering(folder.path, air, *solved));
  const auto back = readScattering(folder.path, air, kWavelengths, coarse());
  ASSERT_TRUE(back);
  EXPECT_EQ(back->bytes(air), solved->bytes(air));
  EXPECT_EQ(back->orders(), solved->orders());
  const RayInAir ray{100, 0.1, 1.2, 0.5};
  EXPECT_EQ(back->radiance(ray), solved->radiance(ray));

  // Nothing of another air, of other wavelengths, of another resolution.
  EXPECT_FALSE(readScattering(folder.path, *preset("reference"), kWavelengths, coarse()));
  EXPECT_FALSE(readScattering(folder.path, air, std::vector<double>{450, 550, 651}, coarse()));
  Resolution other = coarse();
  other.sunTo = 1.41;
  EXPECT_FALSE(readScattering(folder.path, air, kWavelengths, other));
  const std::vector<std::byte> bytes = solved->bytes(air);
  for (const std::size_t size : {bytes.size() - 4, std::size_t(10), std::size_t(0)})
    EXPECT_FALSE(Scattering::fromBytes(std::span(bytes).first(size), air, kWavelengths, coarse()));
  // Not trusted when a byte of it has changed.
  ASSERT_EQ(folder.files().size(), 1u);
  std::FILE* file = std::fopen(folder.files()[0].c_str(), "r+b");
  ASSERT_TRUE(file);
  std::fseek(file, 3000, SEEK_SET);
  std::fputs("xy", file);
  std::fclose(file);
  EXPECT_FALSE(readScattering(folder.path, air, kWavelengths, coarse()));
}

TEST(AirMaker, SolvesAnAirOnceForEverySun) {
  const CacheFolder folder;
  SkyOptions options;
  options.cache = folder.path;
  options.sunElevation = 0.4;
  const auto tableOf = [&](AirMaker& maker) {
    auto made = maker.make(options, AerialForm::Table);
    EXPECT_TRUE(made && made->findings.empty());
    return std::get<AirTable>(std::move(made->value));
  };
  const auto same = [](const AirTable& a, const AirTable& b) {
    return std::ranges::equal(a.extinction(), b.extinction()) &&
           std::ranges::equal(a.source(AirTable::Multiple), b.source(AirTable::Multiple));
  };
  AirMaker first, second;
  const AirTable anew = tableOf(first), read = tableOf(second);
  EXPECT_TRUE(same(anew, read));
  options.sunElevation = -0.05, options.altitude = 1000;
  const AirTable evening = tableOf(first);
  EXPECT_TRUE(same(evening, tableOf(second)));
  EXPECT_FALSE(same(evening, anew));
  EXPECT_EQ(folder.files().size(), 1u);
  // All Suns of the fast path's density: what one air takes of the user's cache folder.
  EXPECT_LT(std::filesystem::file_size(folder.files()[0]), 18u << 20);
}

}  // namespace
}  // namespace lambent::sky
