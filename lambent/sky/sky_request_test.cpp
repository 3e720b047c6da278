#include "lambent/sky/sky_request.h"

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <unistd.h>
#include <Eigen/LU>

namespace lambent::sky {
namespace {

constexpr double kRad = kPi / 180;
constexpr const char* kBern = "date=2026-06-21,time=14:00,utc-offset=2,lat=46.95,lon=7.45";

ResolvedSky resolved(std::string_view text) {
  const auto request = parseRequest(text);
  EXPECT_TRUE(request) << text << ": " << (request ? "" : request.error().message);
  if (!request) return {};
  const auto sky = resolve(*request);
  EXPECT_TRUE(sky) << text << ": " << (sky ? "" : sky.error().message);
  return sky ? sky->value : ResolvedSky{};
}

void expectRefused(std::string_view text, std::initializer_list<const char*> words,
                   ErrorKind kind = ErrorKind::BadUsage) {
  const auto request = parseRequest(text);
  Error error;
  if (request) {
    const auto sky = resolve(*request);
    ASSERT_FALSE(sky) << text;
    error = sky.error();
  } else {
    error = request.error();
  }
  EXPECT_EQ(int(error.kind), int(kind)) << text << ": " << error.message;
  for (const char* word : words)
    EXPECT_NE(error.message.find(word), std::string::npos)
        << text << ": '" << word << "' is missing in: " << error.message;
}

TEST(SkyRequest, FindsTheSunOfAMomentAndAPlace) {
  // The summer solstice at Bern: 12:30 UTC is some minutes after noon there; the Sun is at its
  // highest, 90° − 46.95° + 23.44° and a little refraction.
  const ResolvedSky noon = resolved("date=2026-06-21,time=13:32,utc-offset=+2,lat=46.95,lon=7.45");
  EXPECT_NEAR(noon.options.sunElevation / kRad, 66.5, 0.05);
  EXPECT_NEAR(noon.sunBearing / kRad, 180, 2);
  EXPECT_NEAR(noon.options.sunDistance, 1.0163, 3e-4);
  // Refraction at 66.5°: 1.02′ cot 66.5°, .44′.
  ASSERT_TRUE(noon.trueElevation);
  EXPECT_NEAR((noon.options.sunElevation - *noon.trueElevation) / kRad * 60, 0.44, 0.02);
  EXPECT_FALSE(resolved("sun-elevation=10").trueElevation);
  // The same moment by other clocks.
  for (const char* same : {"date=2026-06-21,time=11:32,lat=46.95,lon=7.45",
                           "date=2026-06-21,time=17:02:00,utc-offset=+05:30,lat=46.95,lon=7.45",
                           "date=2026-06-21,time=08:02,utc-offset=-03:30,lat=46.95,lon=7.45",
                           "lon=+7.45,lat=46.95,utc-offset=2e+0,time=13:32,date=2026-06-21"})
    EXPECT_NEAR(resolved(same).options.sunElevation, noon.options.sunElevation, 1e-12) << same;
}

TEST(SkyRequest, TurnsTheSunsFrameToTheWorld) {
  const struct {
    const char* text;
    Vec3d towards;
  } cases[] = {{"sun-elevation=0,sun-azimuth=0", {0, 0, -1}},
               {"sun-elevation=0,sun-azimuth=90", {1, 0, 0}},
               {"sun-elevation=0", {0, 0, 1}},
               {"sun-elevation=0,sun-azimuth=-90", {-1, 0, 0}}};
  for (const auto& each : cases) {
    const Mat3d turn = resolved(each.text).worldFromSun;
    EXPECT_LT((turn * Vec3d::UnitX() - each.towards).norm(), 1e-12) << each.text;
    EXPECT_LT((turn * Vec3d::UnitY() - Vec3d::UnitY()).norm(), 1e-15);
    EXPECT_NEAR(turn.determinant(), 1, 1e-12);
  }
  // In the afternoon of Bern the Sun is in the west.
  const ResolvedSky evening =
      resolved("date=2026-06-21,time=19:00,utc-offset=2,lat=46.95,lon=7.45");
  EXPECT_LT((evening.worldFromSun * Vec3d::UnitX()).x(), -0.9);
}

TEST(SkyRequest, AtPolesAndAtTheDateLine) {
  // Midnight Sun and polar day: the Sun circles at one height.
  for (const char* lon : {"-180", "-90", "0", "90", "180"}) {
    const std::string text = std::string("date=2026-06-21,time=06:00,lat=90,lon=") + lon;
    EXPECT_NEAR(resolved(text).options.sunElevation / kRad, 23.44 + 0.04, 0.02) << lon;
  }
  const auto a = resolved("date=2026-03-01,time=00:00,lat=10,lon=180");
  const auto b = resolved("date=2026-03-01,time=00:00,lat=10,lon=-180");
  EXPECT_NEAR(a.options.sunElevation, b.options.sunElevation, 1e-12);
  EXPECT_NEAR(std::remainder(a.sunBearing - b.sunBearing, 2 * kPi), 0, 1e-12);
  expectRefused("date=2026-06-21,time=06:00,lat=-90,lon=0", {"-23.4", "night"});
}

TEST(SkyRequest, RefusesTheNight) {
  resolved("sun-elevation=-18");
  expectRefused("sun-elevation=-18.1", {"-18.10", "night"});
  expectRefused("date=2026-12-21,time=00:00,utc-offset=1,lat=46.95,lon=7.45", {"night"});
}

TEST(SkyRequest, MistakesAreNamed) {
  expectRefused("", {"KEY=VALUE"});
  expectRefused("lat", {"'lat' is not KEY=VALUE"});
  expectRefused("sun-elevation=10,,", {"KEY=VALUE"});
  expectRefused("latitude=46", {"'latitude'", "did you mean lat?", "utc-offset"});
  expectRefused("sun-elevaton=10", {"did you mean sun-elevation?"});
  expectRefused("colour=10", {"no key 'colour'", "turbidity"});
  expectRefused("lat=46,lat=47", {"'lat' is given twice"});
  expectRefused("lat=north", {"lat:", "'north'"});
  expectRefused("lat=90.1", {"lat:", "-90 to 90"});
  expectRefused("lon=181", {"lon:", "-180 to 180"});
  expectRefused("lat=nan", {"'nan'"});
  expectRefused("lat=", {"lat:", "''"});
  expectRefused("date=1599-12-31", {"date:", "1600"});
  expectRefused("date=2401-01-01", {"date:", "2400"});
  expectRefused("date=2026-02-29", {"date:"});
  expectRefused("date=tomorrow", {"date:"});
  expectRefused("time=24:00", {"time:"});
  expectRefused("utc-offset=15", {"utc-offset:", "-14 to 14"});
  expectRefused("utc-offset=5:3", {"utc-offset:", "+05:30"});
  expectRefused("turbidity=0.9", {"turbidity:", "1 to 10"});
  expectRefused("turbidity=11", {"turbidity:"});
  expectRefused("albedo=1.5", {"albedo:"});
  expectRefused("ozone=-1", {"ozone:"});
  expectRefused("altitude=-10", {"altitude:", "under the ground"});
  expectRefused("altitude=2e5", {"altitude:", "in space"});
  expectRefused("model=sunny", {"model:", "'sunny'", "preetham"});
  expectRefused("model=cie:16", {"model:", "cie:15"});
  expectRefused("model=cie:1.5", {"model:"});
  expectRefused("refine=9", {"refine:"});
  expectRefused("refine=1.5,model=exact", {"refine:"});
  // Each is sound, and together they are not.
  expectRefused("model=exact", {"sun-elevation", "date"});
  expectRefused("sun-azimuth=10", {"sun-elevation with sun-azimuth"});
  expectRefused("date=2026-06-21,lat=1", {"time and lon are missing"});
  expectRefused("date=2026-06-21,time=10:00,lat=1", {"lon is missing"});
  expectRefused(std::string(kBern) + ",sun-elevation=10", {"one of them"});
  expectRefused("sun-elevation=10,direct-normal=800", {"direct-normal", "perez"});
  expectRefused("sun-elevation=10,refine=1", {"refine", "exact"});
  expectRefused("sun-elevation=10,atmosphere=thick", {"'thick'", "clear", "reference"});
  expectRefused("sun-elevation=10,atmosphere=none.json", {"none.json"}, ErrorKind::BadInput);
  expectRefused("sun-elevation=10,altitude=100001", {"in space", "100000"});
  expectRefused("sun-elevation=10+uniform", {"'+'"});
}

TEST(SkyRequest, FillsInTheAtmosphere) {
  const ResolvedSky sky = resolved(
      "sun-elevation=10,turbidity=4,albedo=0.3,ozone=250,altitude=1500,model=exact,refine=2");
  EXPECT_EQ(sky.options.model, Model::Exact);
  EXPECT_EQ(sky.options.refine, 2);
  EXPECT_EQ(sky.options.altitude, 1500);
  EXPECT_EQ(sky.options.atmosphere.turbidity, 4.0);
  EXPECT_EQ(sky.options.atmosphere.ozone, 250);
  EXPECT_EQ(sky.options.atmosphere.groundAlbedo.at(500), 0.3);
  EXPECT_NEAR(sky.options.sunElevation, 10 * kRad, 1e-15);
  EXPECT_EQ(sky.options.sunDistance, 1);
  EXPECT_EQ(resolved("sun-elevation=10,atmosphere=reference").options.atmosphere.ozone, 0);
  EXPECT_EQ(resolved("sun-elevation=10,model=cie:7").options.cieType, 7);
  const ResolvedSky perez =
      resolved("sun-elevation=10,model=perez,direct-normal=600,diffuse-horizontal=100");
  EXPECT_EQ(perez.options.directNormalIrradiance, 600.0);
  EXPECT_EQ(perez.options.diffuseHorizontalIrradiance, 100.0);
  const auto request = parseRequest("sun-elevation=10,model=preetham,altitude=10");
  ASSERT_TRUE(request);
  const auto warned = resolve(*request);
  ASSERT_TRUE(warned);
  ASSERT_EQ(warned->findings.size(), 1u);
  EXPECT_EQ(warned->findings[0].code, "sky-altitude-unused");
}

TEST(SkyRequest, EveryKeyIsSaidOnceAndTakesWhatItShows) {
  std::set<std::string_view> keys;
  for (const RequestKey& key : requestKeys()) {
    EXPECT_TRUE(keys.insert(key.key).second) << key.key;
    EXPECT_FALSE(key.help.empty() || key.syntax.empty() || key.group.empty()) << key.key;
    SkyRequest request;
    EXPECT_FALSE(setKey(request, key.key, "")) << key.key;
  }
}

TEST(SkyRequest, ValuesEndWhereTheyShould) {
  const auto value = [](std::string_view text) {
    const std::size_t at = text.find('=') + 1;
    return text.substr(at, endOfRequestValue(text, at) - at);
  };
  EXPECT_EQ(value("utc-offset=+2,lat=1"), "+2");
  EXPECT_EQ(value("utc-offset=+2+uniform"), "+2");
  EXPECT_EQ(value("altitude=1e+3+uniform"), "1e+3");
  EXPECT_EQ(value("model=cie:3+uniform"), "cie:3");
  EXPECT_EQ(value("model=haze+uniform"), "haze");
  EXPECT_EQ(value("atmosphere=no-such+file,x.json,lat=1"), "no-such");
}

TEST(SkyRequest, ComesBackFromItsText) {
  for (const std::string_view text :
       {"date=2026-06-21,time=05:40,utc-offset=2,lat=46.2,lon=6.1", "sun-elevation=-0.1",
        "date=1999-12-31,time=23:59:59,utc-offset=-3.5,lat=-90,lon=-179.123456789012",
        "sun-elevation=12,sun-azimuth=-140.25,model=exact,refine=2",
        "sun-elevation=12,model=preetham,turbidity=2.7,albedo=0",
        "sun-elevation=12,model=perez,direct-normal=800,diffuse-horizontal=1e-07",
        "sun-elevation=12,model=asrc-cie", "sun-elevation=12,model=cie-overcast",
        "sun-elevation=12,model=cie-clear", "sun-elevation=12,model=cie:1",
        "sun-elevation=12,model=cie:15",
        "sun-elevation=12,turbidity=3,albedo=0.3,ozone=300,altitude=1500,atmosphere=hazy"}) {
    const auto request = parseRequest(text);
    ASSERT_TRUE(request) << request.error().message;
    EXPECT_EQ(toText(*request), text);
  }
  EXPECT_EQ(toText(SkyRequest{}), "");
  const auto usual = parseRequest("model=fast,sun-elevation=1e1,atmosphere=clear,utc-offset=0");
  ASSERT_TRUE(usual);
  EXPECT_EQ(toText(*usual), "sun-elevation=10");
}

class AtmosphereFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("lambent-sky-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(AtmosphereFiles, AreNamedInRequests) {
  const std::string odd = write(
      "a+b,c.json", R"({"lambent": "atmosphere", "ozone_dobson": 123, "ground_albedo": 0.7})");
  const ResolvedSky sky = resolved("sun-elevation=10,atmosphere=" + odd + ",albedo=0.2");
  EXPECT_EQ(sky.options.atmosphere.ozone, 123);
  EXPECT_EQ(sky.options.atmosphere.groundAlbedo.at(550), 0.2);
  EXPECT_EQ(resolved("atmosphere=" + odd + ",sun-elevation=10").options.atmosphere.ozone, 123);
  expectRefused("sun-elevation=10,atmosphere=" + write("bad.json", "{"), {"bad.json", "not JSON"},
                ErrorKind::BadInput);
  expectRefused("sun-elevation=10,atmosphere=" + folder_.string(), {"lambent-sky-"},
                ErrorKind::BadInput);
}

}  // namespace
}  // namespace lambent::sky
