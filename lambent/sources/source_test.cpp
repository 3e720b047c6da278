// The grammar of SOURCE: what is understood, and how the rest is refused.
#include "lambent/sources/source.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "lambent/image/io.h"
#include "lambent/image/maps.h"
#include "lambent/light/light_file.h"
#include "lambent/math/directions.h"
#include "lambent/math/random.h"

namespace lambent::sources {
namespace {

using light::Environment;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("lambent-sources-") + test->test_suite_name() + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  std::string writeImage(const std::string& name, const image::Image& image) const {
    const Status status = image::write(image, path(name));
    EXPECT_TRUE(status) << status.error().message;
    return path(name);
  }

  std::filesystem::path folder_;
};
using Source = Files;

void expectLight(std::string_view text, const Environment& expected) {
  const auto light = parseSource(text);
  ASSERT_TRUE(light) << text << ": " << light.error().message;
  EXPECT_TRUE(light->findings.empty()) << text;
  const auto a = light->value.project(6), b = expected.project(6);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    EXPECT_NEAR(a.values[i], b.values[i], 1e-5f * (1 + std::abs(b.values[i]))) << text;
}

void expectError(std::string_view text, ErrorKind kind, std::initializer_list<const char*> words) {
  const auto light = parseSource(text);
  ASSERT_FALSE(light) << text;
  EXPECT_EQ(int(light.error().kind), int(kind)) << text << ": " << light.error().message;
  for (const char* word : words)
    EXPECT_NE(light.error().message.find(word), std::string::npos)
        << "'" << word << "' is missing in: " << light.error().message;
}

TEST_F(Source, AnalyticLights) {
  const float h = std::sqrt(0.5f);
  expectLight("uniform", Environment::uniform(Rgb::Ones()));
  expectLight("uniform:0.25", Environment::uniform(Rgb::Constant(0.25f)));
  expectLight("uniform:1/2/3", Environment::uniform(Rgb(1, 2, 3)));
  expectLight("disc:0,0,30", Environment::disc(Vec3::UnitX(), kPi / 6, Rgb::Ones()));
  expectLight("disc:90,0,30,2", Environment::disc(Vec3::UnitZ(), kPi / 6, Rgb::Constant(2)));
  expectLight("disc:90,45,360,1/0/0.5", Environment::disc(Vec3(0, h, h), 2 * kPi, Rgb(1, 0, 0.5f)));
  expectLight("disc:-90,-90,1,2e+4",
              Environment::disc(-Vec3::UnitY(), kPi / 180, Rgb::Constant(2e4f)));
  expectLight("directional:180,0,3", Environment::directional(-Vec3::UnitX(), Rgb::Constant(3)));
}

TEST_F(Source, SumsAddUp) {
  expectLight("uniform:1+uniform:2/3/4", Environment::uniform(Rgb(3, 4, 5)));
  expectLight("uniform:1e+1+disc:0,90,60+uniform:1E+1",
              Environment::uniform(Rgb::Constant(20)) +
                  Environment::disc(Vec3::UnitY(), kPi / 3, Rgb::Ones()));
}

TEST_F(Source, TermsOfASum) {
  const std::string odd = writeImage("a+b.hdr", image::Image(4, 2));
  EXPECT_EQ(sourceTerms("uniform"), std::vector<std::string_view>{"uniform"});
  const std::string sum = "uniform:1e+3+" + odd + "+ball:" + odd;
  const std::string ball = "ball:" + odd;
  EXPECT_EQ(sourceTerms(sum), (std::vector<std::string_view>{"uniform:1e+3", odd, ball}));
}

TEST_F(Source, MistakesComeWithAnExample) {
  const ErrorKind usage = ErrorKind::BadUsage;
  expectError("", usage, {"empty", "uniform"});
  expectError("+", usage, {"'+'"});
  expectError("uniform:1+", usage, {"'+'"});
  expectError("uniform:", usage, {"uniform:1"});
  expectError("uniform:red", usage, {"'red'", "uniform:1"});
  expectError("uniform:1/2", usage, {"'1/2'"});
  expectError("uniform:-1", usage, {"'-1'"});
  expectError("uniform:nan", usage, {"'nan'"});
  expectError("uniform:1e40", usage, {"'1e40'"});
  expectError("disc", usage, {"AZIMUTH", "disc:45,60,30"});
  expectError("disc:1,2", usage, {"2 values", "disc:45,60,30"});
  expectError("disc:1,2,3,4,5", usage, {"5 values"});
  expectError("disc:north,2,3", usage, {"azimuth 'north'"});
  expectError("disc:0,91,3", usage, {"elevation 91"});
  expectError("disc:0,0,0", usage, {"angular diameter 0", "directional:"});
  expectError("disc:0,0,361", usage, {"angular diameter 361"});
  expectError("disc:0,0,inf", usage, {"'inf'"});
  expectError("directional:1", usage, {"1 value;", "directional:45,60"});
  expectError("sun:1", usage, {"'sun:1'", "disc:"});
  expectError("scene.glb", usage, {"'scene.glb'", ".exr"});
}

TEST_F(Source, Skies) {
  // South at noon, east in the morning: the Sun's disc outshines all that is beside it.
  const auto noon = parseSource("sky:sun-elevation=30,model=preetham,turbidity=3");
  ASSERT_TRUE(noon) << noon.error().message;
  const float c = std::sqrt(0.75f);
  EXPECT_GT(noon->value.radiance(Vec3(0, 0.5f, c))[1], 1e4f);
  EXPECT_LT(noon->value.radiance(Vec3(0, 0.5f, -c))[1], 1e2f);
  const auto morning =
      parseSource("sky:date=2026-03-20,time=09:00,utc-offset=+2,lat=0,lon=+30,model=preetham");
  ASSERT_TRUE(morning) << morning.error().message;
  const auto f = morning->value.project(2);
  EXPECT_GT(f.channel(1)[3], 0);  // from +x, the east
  // A sum is the sum, and a sky has a ground.
  const auto sum = parseSource("sky:sun-elevation=30,model=preetham,turbidity=3+uniform:2");
  ASSERT_TRUE(sum) << sum.error().message;
  for (const Vec3& s : {Vec3(0, 1, 0), Vec3(0.6f, 0.8f, 0), Vec3(0, -1, 0)}) {
    const Rgb sky = noon->value.radiance(s);
    EXPECT_GT(sky.minCoeff(), 0.0f);
    EXPECT_LT((sum->value.radiance(s) - sky - 2).abs().maxCoeff(), 1e-5f);
  }
}

TEST_F(Source, TheSkyOfASum) {
  const auto sky = resolvedSky("uniform:2+sky:sun-elevation=30,altitude=1e+3+disc:1,2,3");
  ASSERT_TRUE(sky) << sky.error().message;
  EXPECT_NEAR(sky->value.options.sunElevation, kPi / 6, 1e-12);
  EXPECT_EQ(sky->value.options.altitude, 1000);
  const auto expectNone = [](const std::string& text, const std::string& says) {
    const auto none = resolvedSky(text);
    ASSERT_FALSE(none) << text;
    EXPECT_EQ(none.error().kind, ErrorKind::BadUsage);
    EXPECT_NE(none.error().message.find(says), std::string::npos) << none.error().message;
  };
  expectNone("uniform+disc:1,2,3", "no sky");
  expectNone("", "no sky");
  expectNone("sky:sun-elevation=3+sky:sun-elevation=4", "two skies");
  expectNone("sky:sunelevation=30", "did you mean sun-elevation?");
}

TEST_F(Source, TermsOfSkies) {
  using Terms = std::vector<std::string_view>;
  const std::string odd = write("a+b,c.json", "{}");
  const std::string sky = "sky:utc-offset=+2,altitude=1e+3,atmosphere=" + odd + ",lat=+4";
  EXPECT_EQ(sourceTerms(sky), Terms{sky});
  EXPECT_EQ(sourceTerms(sky + "+uniform"), (Terms{sky, "uniform"}));
  EXPECT_EQ(sourceTerms("sky:lat=1+disc:1,2,3"), (Terms{"sky:lat=1", "disc:1,2,3"}));
  EXPECT_EQ(sourceTerms("uniform+sky"), (Terms{"uniform", "sky"}));
  EXPECT_EQ(sourceTerms("sky+uniform"), (Terms{"sky", "uniform"}));
  EXPECT_EQ(filesOf(sky), std::vector<std::filesystem::path>{odd});
  EXPECT_TRUE(filesOf("sky:atmosphere=clear,lat=1").empty());
  EXPECT_EQ(filesOf("cube:a.exr"), std::vector<std::filesystem::path>{"a.exr"});
  EXPECT_EQ(filesOf("a.exr"), std::vector<std::filesystem::path>{"a.exr"});
  EXPECT_TRUE(filesOf("disc:1,2,3").empty());
}

TEST_F(Source, SkiesThatAreNone) {
  const ErrorKind bad = ErrorKind::BadUsage;
  expectError("sky", bad, {"'sky'", "KEY=VALUE", "sky:date="});
  expectError("sky:sun-elevation=30,lat=1", bad, {"one of them", "sky:date="});
  expectError("sky:sunelevation=30", bad, {"did you mean sun-elevation?"});
  expectError("sky:sun-elevation=-30", bad, {"night"});
  expectError("sky:sun-elevation=3,atmosphere=" + path("none.json"), ErrorKind::BadInput,
              {"none.json"});
  expectError("sky:sun-elevation=3,atmosphere=" + write("broken.json", "["), ErrorKind::BadInput,
              {"broken.json"});
}

TEST_F(Source, Images) {
  image::Image image(8, 4);
  for (int i = 0; i < 32; ++i) image.pixels[i] = Rgb(float(i), 1, 0.5f);
  const Environment expected = Environment::latLong(image);
  expectLight(writeImage("map.exr", image), expected);
  expectLight(writeImage("a+b.exr", image), expected);
  expectLight(path("a+b.exr") + "+uniform:2+" + path("map.exr"),
              expected + expected + Environment::uniform(Rgb::Constant(2)));
  std::filesystem::copy_file(path("map.exr"), path("MAP.EXR"));
  expectLight(path("MAP.EXR"), expected);
}

TEST_F(Source, OtherMapsShowTheSameLight) {
  // A smooth light, drawn into every kind of map.
  sh::RgbCoefficients f(3);
  math::Random random(6, 0);
  for (float& value : f.values) value = random.uniform() - 0.5f;
  for (int c = 0; c < 3; ++c) f.channel(c)[0] = 8;  // positive everywhere
  const Environment expected = Environment::harmonics(f);
  const auto compare = [&](const std::string& text, image::MapKind kind, int width, int height) {
    image::Image map(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (const auto s = image::directionOf({kind, width, height}, {x + 0.5, y + 0.5}))
          map.at(x, y) = expected.radiance(s->cast<float>());
    writeImage("map.exr", map);
    const auto light = parseSource(text + path("map.exr"));
    ASSERT_TRUE(light) << light.error().message;
    const auto g = light->value.project(3);
    for (std::size_t i = 0; i < g.values.size(); ++i)
      EXPECT_NEAR(g.values[i], f.values[i], 0.01) << text << width << "x" << height;
    for (int n = 0; n < 100; ++n) {
      const Vec3 s = math::uniformSphere(random.uniform2());
      EXPECT_LT((light->value.radiance(s) - expected.radiance(s)).abs().maxCoeff(), 0.02) << text;
    }
  };
  compare("", image::MapKind::LatLong, 128, 64);
  compare("cube:", image::MapKind::Cube, 32, 192);
  compare("cube:", image::MapKind::Cube, 128, 96);
  compare("angular:", image::MapKind::Angular, 128, 128);
  // A mirrored ball hardly shows what is behind it; its rim is the seam.
  compare("ball:", image::MapKind::MirrorBall, 512, 512);
}

TEST_F(Source, ImagesThatAreNoLight) {
  expectError(path("none.exr"), ErrorKind::BadInput, {"none.exr"});
  expectError(write("broken.hdr", "#?RADIANCE\n"), ErrorKind::BadInput, {"broken.hdr"});
  expectError(writeImage("square.exr", image::Image(4, 4)), ErrorKind::BadInput,
              {"square.exr", "4 x 4", "angular:FILE"});
  expectError(writeImage("cross.exr", image::Image(8, 6)), ErrorKind::BadInput, {"cube:FILE"});
  expectError(writeImage("odd.exr", image::Image(7, 5)), ErrorKind::BadInput, {"2:1"});
  expectError("cube:" + path("odd.exr"), ErrorKind::BadInput, {"odd.exr"});
  expectError("angular:" + path("none.exr"), ErrorKind::BadInput, {"none.exr"});
  expectError("cube:", ErrorKind::BadUsage, {"cube:probe.exr"});
}

TEST_F(Source, LayersOfAFile) {
  image::Image picture(8, 4), diffuse(8, 4);
  for (Rgb& p : picture.pixels) p = Rgb(1, 2, 3);
  for (Rgb& p : diffuse.pixels) p = Rgb(0.5f, 0.25f, 0.125f);
  const std::string file = path("a+b.exr");
  ASSERT_TRUE(image::write(picture, file, {.halfFloat = false, .layers = {{"diffuse", &diffuse}}}));
  const auto whole = parseSource(file);
  ASSERT_TRUE(whole) << whole.error().message;
  ASSERT_EQ(whole->findings.size(), 1u);
  EXPECT_EQ(whole->findings[0].code, "exr-layers");
  expectLight(file + ":diffuse", Environment::latLong(diffuse));
  expectLight(file + ":diffuse+" + file + ":diffuse",
              Environment::latLong(diffuse) + Environment::latLong(diffuse));
  expectLight("latlong:" + file + ":diffuse", Environment::latLong(diffuse));
  expectError(file + ":none", ErrorKind::BadInput, {"a+b.exr", "no layer none", "diffuse"});
  EXPECT_EQ(filesOf(file + ":diffuse"), std::vector<std::filesystem::path>{file});
  EXPECT_EQ(filesOf("cube:" + file + ":diffuse"), std::vector<std::filesystem::path>{file});
  // Only of OpenEXR; and a file of such a name is a file.
  EXPECT_EQ(pictureNameOf("a.hdr:x").path, "a.hdr:x");
  std::filesystem::copy_file(file, path("c.exr:d"));
  EXPECT_EQ(pictureNameOf(path("c.exr:d")).layer, "");
}

TEST_F(Source, MapsOfAnyShapeByAWord) {
  image::Image tall(8, 8);  // a latitude-longitude map, stretched
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) tall.at(x, y) = y < 4 ? Rgb(4, 4, 4) : Rgb(2, 2, 2);
  const auto light = parseSource("latlong:" + writeImage("tall.exr", tall));
  ASSERT_TRUE(light) << light.error().message;
  EXPECT_NEAR(light->value.radiance(Vec3::UnitY())[0], 4, 1e-3);
  EXPECT_NEAR(light->value.radiance(-Vec3::UnitY())[1], 2, 1e-3);
}

TEST_F(Source, WhatWasMadeForAScreenIsTold) {
  image::Image map(8, 4);
  for (Rgb& p : map.pixels) p = Rgb(1, 1, 1);
  const auto light = parseSource(writeImage("map.png", map));
  ASSERT_TRUE(light) << light.error().message;
  ASSERT_EQ(light->findings.size(), 1u);
  EXPECT_EQ(light->findings[0].code, "light-not-hdr");
}

TEST_F(Source, PixelsThatAreNoRadiance) {
  image::Image image(8, 4);
  for (Rgb& p : image.pixels) p = Rgb(1, 2, 3);
  image.at(5, 2) = Rgb(1, std::numeric_limits<float>::infinity(), 3);
  image.at(6, 3) = Rgb(std::nanf(""), -1, 3);
  const std::string file = writeImage("map.exr", image);
  expectError(file, ErrorKind::BadInput, {"map.exr", "column 5, row 2", "(1, inf, 3)"});

  const auto light = parseSource(file, {.notFinite = SourceOptions::NotFinite::Repair});
  ASSERT_TRUE(light) << light.error().message;
  const Findings& findings = light->findings;
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].code, "light-pixels-repaired");
  EXPECT_EQ(findings[0].count, 2u);
  EXPECT_NE(findings[0].message.find("column 5, row 2"), std::string::npos);
  EXPECT_EQ(findings[1].code, "light-pixels-negative");
  image.at(5, 2) = Rgb(1, 2, 3);
  image.at(6, 3) = Rgb(0, 0, 3);
  const auto a = light->value.project(4), b = Environment::latLong(image).project(4);
  for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_EQ(a.values[i], b.values[i]);
}

TEST_F(Source, FindingsOfEveryTermAreTold) {
  image::Image image(8, 4);
  image.at(1, 1) = Rgb(-1, 2, 3);
  const std::string file = writeImage("map.exr", image);
  const auto light = parseSource(file + "+uniform:1+" + file);
  ASSERT_TRUE(light) << light.error().message;
  ASSERT_EQ(light->findings.size(), 2u);
  for (const Finding& finding : light->findings) EXPECT_EQ(finding.code, "light-pixels-negative");
}

TEST_F(Source, LightFiles) {
  sh::RgbCoefficients f(4);
  math::Random random(4, 4);
  for (float& value : f.values) value = 100 * random.uniform() - 50;
  ASSERT_TRUE(light::writeLight(f, path("light.json")));
  const auto light = parseSource(path("light.json"));
  ASSERT_TRUE(light) << light.error().message;
  EXPECT_EQ(light->value.project(4).values, f.values);
  const std::string file = write("asset.json", "{\"lambent\": \"asset\"}");
  expectError(file, ErrorKind::BadInput, {"asset.json", "\"lambent\": \"light\""});
}

TEST_F(Source, TheTableKnowsEveryWord) {
  for (const SourceKind& kind : sourceKinds()) {
    const std::string word(kind.word);
    EXPECT_EQ(kindOf(word + ":1"), &kind);
    EXPECT_TRUE(kind.syntax.starts_with(word)) << word;
    expectError("sun:1", ErrorKind::BadUsage, {word.c_str()});
    // A '+' in an exponent does not divide, one in a file's name only if there is no such file.
    const std::string sum = word + ":1e+3+uniform";
    EXPECT_EQ(sourceTerms(sum).size(), kind.takes == SourceKind::Takes::Numbers ? 2u : 3u) << word;
  }
  EXPECT_EQ(kindOf("sky.exr"), nullptr);
  EXPECT_EQ(kindOf("uniform.exr"), nullptr);
}

TEST_F(Source, HelpHasALineForEveryForm) {
  EXPECT_EQ(sourceHelp(), R"(SOURCE of light:
  FILE.exr FILE.hdr FILE.png   an environment image, latitude-longitude or as its header says
  FILE.exr:LAYER               a layer or part of it that is not its picture
  LIGHT.json                   coefficients written by 'lambent light'
  uniform[:RADIANCE]           the same from everywhere
  disc:AZIMUTH,ELEVATION,ANGULAR_DIAMETER[,RADIANCE]
                               degrees; azimuth from +x towards +z, elevation from the horizon
  directional:AZIMUTH,ELEVATION[,IRRADIANCE]
                               the same as a point infinitely far away
  sky:KEY=VALUE[,…]            a sky with its Sun and ground, by the keys of 'lambent sky'
  latlong:FILE                 an environment image of any size, latitude-longitude
  cube:FILE                    its six faces in a cross, a row or a column
  angular:FILE                 a light probe: the angular map
  ball:FILE                    a picture of a mirrored ball, cut to its rim
  A+B+…                        the sum of several. RADIANCE and IRRADIANCE are one number or
                               R/G/B.
)");
}

}  // namespace
}  // namespace lambent::sources
