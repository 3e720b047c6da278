// Atmospheres as JSON: every one comes back as it was, and what is none is refused, with the place
// and the range.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "lambent/math/random.h"
#include "lambent/sky/atmosphere.h"

namespace lambent::sky {
namespace {

using media::DensityProfile;

Atmosphere parsed(const std::string& members) {
  const auto read = parseAtmosphere(R"({"lambent": "atmosphere")" + members + "}", "sky.json");
  EXPECT_TRUE(read) << members << ": " << read.error().message;
  return read ? *read : Atmosphere{};
}

void expectBack(const Atmosphere& a) {
  const std::string text = toJson(a);
  const auto again = parseAtmosphere(text, "again.json");
  ASSERT_TRUE(again) << again.error().message << '\n' << text;
  EXPECT_TRUE(*again == a) << text << toJson(*again);
  EXPECT_EQ(toJson(*again), text);
}

void expectRefused(const std::string& members, std::initializer_list<std::string_view> words) {
  const auto read = parseAtmosphere(R"({"lambent": "atmosphere", )" + members + "}", "sky.json");
  ASSERT_FALSE(read) << members;
  EXPECT_EQ(int(read.error().kind), int(ErrorKind::BadInput));
  EXPECT_TRUE(read.error().message.starts_with("sky.json: ")) << read.error().message;
  EXPECT_LT(read.error().message.size(), 700u) << read.error().message;
  for (const std::string_view word : words)
    EXPECT_NE(read.error().message.find(word), std::string::npos)
        << "'" << word << "' is missing in: " << read.error().message;
}

TEST(AtmosphereFile, EveryPresetComesBack) {
  for (const std::string_view name : presets()) {
    expectBack(*preset(name));
    EXPECT_EQ(parsed(R"(, "base": ")" + std::string(name) + '"'), *preset(name));
  }
  EXPECT_EQ(parsed(""), *preset("clear"));
}

TEST(AtmosphereFile, EveryLawComesBack) {
  Atmosphere a = *preset("reference");
  expectBack(Atmosphere{});
  for (const media::PhaseFunction& phase :
       {media::PhaseFunction(media::Isotropic{}), media::PhaseFunction(media::RayleighPhase{}),
        media::PhaseFunction(media::HenyeyGreenstein{-0.99}),
        media::PhaseFunction(media::DoubleHenyeyGreenstein{0.2, 0.8, -0.4}),
        media::PhaseFunction(media::Schlick{0.7})}) {
    a.aerosolPhase = phase;
    expectBack(a);
  }
  for (const auto law : {Atmosphere::Rayleigh::Formula, Atmosphere::Rayleigh::Seed}) {
    a.rayleigh = law;
    expectBack(a);
  }
  a.air = DensityProfile::tabulated({{0, 1}, {1000, 0.9}, {1000, 0.1}, {1e5, 0}});
  a.aerosolProfile = DensityProfile::usStandard1976();
  a.ozone = 2000;
  a.ozoneProfile = DensityProfile::tabulated({{0, 1}});
  a.groundAlbedo = {{700}, {0.25}};
  a.solarIrradiance = Spectral{{400, 400.5}, {0, 1000}};
  a.name = "a \"name\"\n\u00e9\x01";
  expectBack(a);
  a.aerosols = Atmosphere::Junge{};
  expectBack(a);
  a.aerosols = Atmosphere::Junge{2.5e-16, 3.5};
  a.turbidity = 4;  // said, not made by withTurbidity
  expectBack(a);
  a.aerosols = Atmosphere::Angstrom{0.1, 1.3};
  expectBack(a);
  for (const double turbidity : {1.0, 1.7, 2.0, 3.3, 10.0}) {
    expectBack(withTurbidity(a, turbidity));
    EXPECT_NE(toJson(withTurbidity(a, turbidity)).find(R"("aerosols": {"turbidity": )"),
              std::string::npos);
  }
}

TEST(AtmosphereFile, EveryDoubleComesBack) {
  math::Random random(3, 7);
  const auto between = [&](double least, double most) {
    return least + (most - least) * random.uniform();
  };
  for (int i = 0; i < 300; ++i) {
    Atmosphere a;
    a.planetRadius = between(1e5, 1e7);
    a.height = between(2e4, 1e6);
    a.air = DensityProfile::exponential(between(10, 3e4));
    a.aerosols = Atmosphere::Angstrom{between(0, 20), between(-2, 4)};
    a.singleScatteringAlbedo = between(0, 1);
    a.aerosolPhase = media::CornetteShanks{between(-0.99, 0.99)};
    a.aerosolProfile = DensityProfile::tabulated(
        {{between(0, 1e3), between(1e-9, 1e-6)}, {between(1e3, 2e4), between(0.1, 1000)}});
    a.ozone = between(0, 2000);
    a.groundAlbedo = Spectral::constant(between(0, 1));
    expectBack(a);
    expectBack(withTurbidity(a, between(1, 10)));
  }
}

TEST(AtmosphereFile, EqualAtmospheresAreTheSameBytes) {
  Atmosphere a, b;
  a.ozone = 0.0;
  b.ozone = -0.0;
  ASSERT_EQ(a, b);
  EXPECT_EQ(toJson(a), toJson(b));
  b.ozone = std::numeric_limits<double>::min();
  EXPECT_NE(toJson(a), toJson(b));
  // What has no place in JSON is written, and refused.
  b.ozone = std::numeric_limits<double>::quiet_NaN();
  const auto read = parseAtmosphere(toJson(b), "nan.json");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("\"ozone_dobson\" is null"), std::string::npos);
}

TEST(AtmosphereFile, IsReadable) {
  Atmosphere a = withTurbidity(*preset("standard"), 3);
  EXPECT_EQ(toJson(a), R"({
  "lambent": "atmosphere",
  "name": "standard",
  "planet_radius_m": 6360000,
  "top_m": 100000,
  "rayleigh": "penndorf",
  "air": "us1976",
  "aerosols": {"turbidity": 3},
  "single_scattering_albedo": 0.9,
  "aerosol_phase": {"cornette_shanks": 0.7},
  "aerosol_profile": {"scale_height_m": 1200},
  "ozone_dobson": 300,
  "ozone_profile": {"altitude_m": [0, 10000, 25000, 40000, 60000], "density": [0, 0, 1, 0, 0]},
  "ground_albedo": 0.1,
  "solar_irradiance": "astm_g173"
}
)");
}

TEST(AtmosphereFile, EachKeyIsLaidOverTheBase) {
  const Atmosphere base = *preset("reference");
  const auto over = [&](const std::string& members) {
    return parsed(R"(, "base": "reference", )" + members);
  };
  const auto expectChange = [&](const std::string& members, auto change) {
    Atmosphere expected = base;
    change(expected);
    EXPECT_NE(expected, base) << members;
    EXPECT_EQ(over(members), expected) << members << toJson(over(members));
  };
  using A = Atmosphere;
  EXPECT_EQ(over(R"("comment": ["of any kind"])"), base);
  expectChange(R"("name": "Vega")", [](A& a) { a.name = "Vega"; });
  expectChange(R"("planet_radius_km": 3389.5)", [](A& a) { a.planetRadius = 3389500; });
  expectChange(R"("planet_radius_m": 1e9)", [](A& a) { a.planetRadius = 1e9; });
  expectChange(R"("top_km": 100)", [](A& a) { a.height = 1e5; });
  expectChange(R"("rayleigh": "seed")", [](A& a) { a.rayleigh = A::Rayleigh::Seed; });
  expectChange(R"("air": {"scale_height_km": 8.5})",
               [](A& a) { a.air = DensityProfile::exponential(8500); });
  expectChange(R"("air": {"scale_height_m": 7994})",
               [](A& a) { a.air = DensityProfile::exponential(7994); });
  expectChange(R"("air": "us1976")", [](A& a) { a.air = DensityProfile::usStandard1976(); });
  expectChange(R"("air": {"altitude_km": [0, 1, 1, 20], "density": [1, 0.9, 0.5, 0]})", [](A& a) {
    a.air = DensityProfile::tabulated({{0, 1}, {1000, 0.9}, {1000, 0.5}, {20000, 0}});
  });
  expectChange(R"("aerosols": {"optical_thickness_at_1um": 0.2})", [](A& a) {
    a.aerosols = A::Angstrom{0.2, 0.8};
  });
  expectChange(R"("aerosols": {"angstrom_exponent": 1.3})", [](A& a) {
    a.aerosols = A::Angstrom{0.04, 1.3};
  });
  expectChange(R"("aerosols": {"turbidity": 3})", [](A& a) { a = withTurbidity(a, 3); });
  expectChange(R"("aerosols": {"turbidity": 3, "angstrom_exponent": 1})", [](A& a) {
    a.aerosols = A::Angstrom{0.04, 1};
    a.turbidity = 3;
  });
  expectChange(R"("aerosols": {"junge": {}})", [](A& a) { a.aerosols = A::Junge{}; });
  expectChange(R"("aerosols": {"junge": {"concentration": 1e-16, "exponent": 4.1}})", [](A& a) {
    a.aerosols = A::Junge{1e-16, 4.1};
  });
  expectChange(R"("single_scattering_albedo": 1)", [](A& a) { a.singleScatteringAlbedo = 1; });
  expectChange(R"("aerosol_phase": {"schlick": -0.5})",
               [](A& a) { a.aerosolPhase = media::Schlick{-0.5}; });
  expectChange(R"("aerosol_phase": "isotropic")",
               [](A& a) { a.aerosolPhase = media::Isotropic{}; });
  expectChange(R"("aerosol_phase": {"double_henyey_greenstein": [0.1, 0.8, -0.3]})", [](A& a) {
    a.aerosolPhase = media::DoubleHenyeyGreenstein{0.1, 0.8, -0.3};
  });
  expectChange(R"("aerosol_profile": {"scale_height_km": 2})",
               [](A& a) { a.aerosolProfile = DensityProfile::exponential(2000); });
  expectChange(R"("ozone_dobson": 240.5)", [](A& a) { a.ozone = 240.5; });
  expectChange(R"("ozone_profile": {"altitude_km": [20], "density": [1]})", [](A& a) {
    a.ozoneProfile = DensityProfile::tabulated({{20000, 1}});
  });
  expectChange(R"("ground_albedo": 0.8)", [](A& a) { a.groundAlbedo = Spectral::constant(0.8); });
  expectChange(R"("ground_albedo": {"wavelength_nm": [400, 700], "value": [0, 1]})", [](A& a) {
    a.groundAlbedo = {{400, 700}, {0, 1}};
  });
  expectChange(R"("solar_irradiance": "astm_g173")", [](A& a) { a.solarIrradiance.reset(); });
  expectChange(R"("solar_irradiance": {"wavelength_nm": [550], "value_w_m2_nm": [1]})",
               [](A& a) { a.solarIrradiance = Spectral::constant(1); });
}

TEST(AtmosphereFile, NumbersHaveRanges) {
  const auto expectRange = [](const std::string& before, const std::string& path,
                              const std::string& after, double least, double most,
                              std::string_view range) {
    const auto with = [&](double value) {
      std::ostringstream text;
      text.precision(17);
      text << R"({"lambent": "atmosphere", "top_km": 1000, )" << before << value << after << '}';
      return parseAtmosphere(text.str(), "sky.json");
    };
    const double margin = 1e-9 * std::max(1.0, most);
    for (const double value : {least, most})
      EXPECT_TRUE(with(value)) << with(value).error().message;
    for (const double value : {least - margin, most + margin, 1e300, -1e300}) {
      const auto read = with(value);
      ASSERT_FALSE(read) << path << ' ' << value;
      EXPECT_TRUE(read.error().message.starts_with("sky.json: \"" + path + "\" is "))
          << read.error().message;
      EXPECT_NE(read.error().message.find(range), std::string::npos) << read.error().message;
    }
  };
  expectRange(R"("planet_radius_km": )", "planet_radius_km", "", 100, 1e6, "from 100 to 1000000");
  expectRange(R"("planet_radius_m": )", "planet_radius_m", "", 1e5, 1e9,
              "from 100000 to 1000000000");
  expectRange(R"("single_scattering_albedo": )", "single_scattering_albedo", "", 0, 1,
              "from 0 to 1");
  expectRange(R"("ozone_dobson": )", "ozone_dobson", "", 0, 2000, "from 0 to 2000");
  expectRange(R"("ground_albedo": )", "ground_albedo", "", 0, 1, "from 0 to 1");
  expectRange(R"("aerosols": {"turbidity": )", "aerosols.turbidity", "}", 1, 10, "from 1 to 10");
  expectRange(R"("aerosols": {"optical_thickness_at_1um": )", "aerosols.optical_thickness_at_1um",
              "}", 0, 20, "from 0 to 20");
  expectRange(R"("aerosols": {"angstrom_exponent": )", "aerosols.angstrom_exponent", "}", -2, 4,
              "from -2 to 4");
  expectRange(R"("aerosols": {"junge": {"concentration": 0, "exponent": )",
              "aerosols.junge.exponent", "}}", 2, 6, "from 2 to 6");
  for (const std::string phase : {"henyey_greenstein", "cornette_shanks", "schlick"})
    expectRange(R"("aerosol_phase": {")" + phase + "\": ", "aerosol_phase." + phase, "}", -0.99,
                0.99, "from -0.99 to 0.99");
  expectRange(R"("aerosol_phase": {"double_henyey_greenstein": [)",
              "aerosol_phase.double_henyey_greenstein[0]", ", 0.5, -0.5]}", 0, 1, "from 0 to 1");
  expectRange(R"("aerosol_phase": {"double_henyey_greenstein": [0.5, 0.8, )",
              "aerosol_phase.double_henyey_greenstein[2]", "]}", -0.99, 0.99, "from -0.99 to 0.99");
  expectRange(R"("aerosol_profile": {"scale_height_km": )", "aerosol_profile.scale_height_km", "}",
              0.01, 1000, "from 0.01 to 1000");
  expectRange(R"("air": {"density": [1], "altitude_km": [)", "air.altitude_km[0]", "]}", 0, 1000,
              "from 0 to 1000");
  expectRange(R"("air": {"altitude_km": [5], "density": [)", "air.density[0]", "]}", 0, 1000,
              "0 or from 1e-09 to 1000");
  expectRange(R"("ground_albedo": {"wavelength_nm": [550], "value": [)", "ground_albedo.value[0]",
              "]}", 0, 1, "from 0 to 1");
  expectRange(R"("ground_albedo": {"value": [0.5], "wavelength_nm": [)",
              "ground_albedo.wavelength_nm[0]", "]}", 100, 10000, "from 100 to 10000");
  expectRange(R"("solar_irradiance": {"wavelength_nm": [550], "value_w_m2_nm": [)",
              "solar_irradiance.value_w_m2_nm[0]", "]}", 0, 1000, "from 0 to 1000");
  expectRefused(R"("top_km": 0.09)", {"\"top_km\" is 0.09", "from 0.1 to 1000"});
  expectRefused(R"("top_km": 1001)", {"\"top_km\" is 1001", "from 0.1 to 1000"});
  expectRefused(R"("aerosols": {"junge": {"concentration": -1e-17}})",
                {"\"aerosols.junge.concentration\" is -1e-17", "from 0 to 1"});
  expectRefused(R"("air": {"altitude_km": [5], "density": [1e-10]})",
                {"\"air.density[0]\" is 1e-10", "0 or from 1e-09 to 1000"});
}

TEST(AtmosphereFile, UnknownKeysAreRefusedWithTheNearest) {
  const auto expectHint = [](const std::string& key, const std::string& meant) {
    expectRefused(
        '"' + key + "\": 1",
        {'"' + key + "\" is not a key of an atmosphere; did you mean \"" + meant + "\"?"});
  };
  expectHint("ozone_dobsn", "ozone_dobson");
  expectHint("planet_radius", "planet_radius_m");
  expectHint("radius_km", "planet_radius_km");
  expectHint("Air", "air");
  expectHint("albedo", "ground_albedo");
  expectHint("turbidity", "aerosols.turbidity");
  expectHint("turbidty", "aerosols.turbidity");
  expectHint("aerosol", "aerosols");
  expectHint("sun_irradiance", "solar_irradiance");
  expectRefused(R"("zzz": 1)",
                {"\"zzz\" is not a key", "there are \"lambent\", \"name\"", "\"top_km\""});
  expectRefused(R"("aerosols": {"turbidty": 3})", {"\"aerosols.turbidty\"", "\"turbidity\"?"});
  expectRefused(R"("aerosols": {"junge": {"exponnent": 3}})",
                {"\"aerosols.junge.exponnent\"", "\"exponent\"?"});
  expectRefused(R"("air": {"scale_height": 8})", {"\"air.scale_height\"", "\"scale_height_m\"?"});
  expectRefused(R"("aerosol_phase": {"henyey": 0.8})",
                {"\"aerosol_phase.henyey\"", "\"henyey_greenstein\"?"});
  expectRefused(R"("ground_albedo": {"values": [1], "wavelength_nm": [550]})",
                {"\"ground_albedo.values\"", "\"value\"?"});
  expectRefused(R"("base": "referense")", {"\"base\" is \"referense\"", "\"reference\"?"});
  expectRefused(R"("base": 3)", {"\"base\" is 3", "\"clear\", \"reference\""});
  expectRefused(R"("rayleigh": "penndorff")", {"\"rayleigh\" is", "\"penndorf\"?"});
  expectRefused(R"("rayleigh": null)", {"\"rayleigh\" is null", "\"penndorf\", \"formula\""});
  expectRefused(R"("air": "us76")", {"\"air\" is \"us76\"", "\"us1976\"?"});
  expectRefused('"' + std::string(100000, 'q') + "\": 1", {"qqq...\" is not a key", "there are"});
  expectRefused(R"("\u0000\ud83d\ude00": 1)", {"\"\\u0000\\ud83d\\ude00\" is not a key"});
}

TEST(AtmosphereFile, WrongShapesAreRefused) {
  expectRefused(R"("planet_radius_km": 6360, "planet_radius_m": 6360000)", {"say the same"});
  expectRefused(R"("planet_radius_km": "6360")",
                {"\"planet_radius_km\" is \"6360\", not a number"});
  expectRefused(R"("ozone_dobson": null)", {"\"ozone_dobson\" is null, not a number"});
  expectRefused(R"("ozone_dobson": true)", {"is true, not a number"});
  expectRefused(R"("ground_albedo": [0.1])", {"\"ground_albedo\" is [0.1], not a number"});
  expectRefused(R"("name": 3)", {"\"name\" is 3", "200 bytes"});
  expectRefused(R"("name": ")" + std::string(201, 'x') + '"', {"\"name\" is", "200 bytes"});
  expectRefused(R"("aerosols": "none")", {"\"aerosols\" is \"none\", not an object"});
  expectRefused(R"("aerosols": {})", {"\"aerosols\" is empty"});
  expectRefused(R"("aerosols": {"junge": 3})", {"\"aerosols.junge\" is 3, not an object"});
  expectRefused(R"("aerosols": {"junge": {}, "angstrom_exponent": 1})", {"not by both"});
  expectRefused(R"("aerosols": {"junge": {"concentration": 1e-13}})",
                {"\"aerosols.junge\"", "optical thickness", "20 at most"});
  expectRefused(R"("aerosol_phase": {})", {"one phase function"});
  expectRefused(R"("aerosol_phase": {"schlick": 0.1, "cornette_shanks": 0.2})",
                {"one phase function"});
  expectRefused(R"("aerosol_phase": 0.7)", {"\"aerosol_phase\" is 0.7", "\"isotropic\""});
  expectRefused(R"("aerosol_phase": {"double_henyey_greenstein": [0.5, 0.8]})", {"[f, g1, g2]"});
  expectRefused(R"("air": {})", {"\"air\"", "scale height"});
  expectRefused(R"("air": {"density": [1]})", {"\"air\"", "altitudes and densities"});
  expectRefused(R"("air": {"altitude_km": [1]})", {"\"air\"", "altitudes and densities"});
  expectRefused(R"("air": {"scale_height_km": 8, "altitude_km": [1], "density": [1]})",
                {"\"air\"", "altitudes and densities"});
  expectRefused(R"("air": {"altitude_km": [], "density": []})",
                {"\"air.altitude_km\" has 0 entries"});
  expectRefused(R"("air": {"altitude_km": 3, "density": [1]})", {"is 3, not a list"});
  expectRefused(R"("air": {"altitude_km": [0, 1], "density": [1]})",
                {"\"air.density\" has 1 entries for 2 altitudes"});
  expectRefused(R"("air": {"altitude_km": [0, 2, 1], "density": [1, 1, 1]})",
                {"\"air.altitude_km[2]\"", "must rise"});
  expectRefused(R"("air": {"altitude_m": [0, 1, 1, 1], "density": [1, 1, 1, 1]})",
                {"\"air.altitude_m[3]\"", "third"});
  expectRefused(R"("air": {"altitude_m": [0, null], "density": [1, 1]})",
                {"\"air.altitude_m[1]\" is null, not a number"});
  expectRefused(R"("aerosol_profile": {"altitude_km": [0], "density": [0]})",
                {"\"aerosol_profile\"", "no place"});
  expectRefused(R"("ozone_profile": {"altitude_km": [0, 120, 130], "density": [0, 0, 1]})",
                {"\"ozone_profile\"", "below the top (100 km)"});
  EXPECT_EQ(
      parsed(R"(, "base": "pure", "ozone_profile": {"altitude_km": [0], "density": [0]})").ozone,
      0);
  expectRefused(R"("ground_albedo": {"value": [0.5]})", {"\"ground_albedo\"", "\"wavelength_nm\""});
  expectRefused(R"("ground_albedo": {"value": [0.5], "wavelength_nm": [400, 500]})",
                {"has 1 entries for 2 wavelengths"});
  expectRefused(R"("ground_albedo": {"value": [0, 1], "wavelength_nm": [500, 500]})",
                {"\"ground_albedo.wavelength_nm[1]\"", "must rise"});
  expectRefused(R"("solar_irradiance": "am0")",
                {"\"solar_irradiance\" is \"am0\"", "\"astm_g173\""});
  expectRefused(R"("solar_irradiance": 1)", {"\"solar_irradiance\" is 1", "\"astm_g173\""});
  const auto table = [](int entries) {
    std::string altitudes, densities;
    for (int i = 0; i < entries; ++i) {
      altitudes += (i ? "," : "") + std::to_string(i);
      densities += i ? ",1" : "1";
    }
    return R"("air": {"altitude_m": [)" + altitudes + R"(], "density": [)" + densities + "]}";
  };
  (void)parsed(", " + table(10000));
  expectRefused(table(10001), {"\"air.altitude_m\" has 10001 entries", "from 1 to 10000"});
}

TEST(AtmosphereFile, HostileTextIsRefused) {
  const auto refuse = [](const std::string& text, std::initializer_list<std::string_view> words) {
    const auto read = parseAtmosphere(text, "sky.json");
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(int(read.error().kind), int(ErrorKind::BadInput));
    EXPECT_TRUE(read.error().message.starts_with("sky.json: ")) << read.error().message;
    EXPECT_LT(read.error().message.size(), 700u);
    for (const std::string_view word : words)
      EXPECT_NE(read.error().message.find(word), std::string::npos) << read.error().message;
  };
  refuse("", {"not JSON", "An atmosphere looks like"});
  refuse("[]", {"\"lambent\": \"atmosphere\" is missing"});
  refuse("null", {"\"lambent\": \"atmosphere\" is missing"});
  refuse(R"({"lambent": "light"})", {"\"lambent\": \"atmosphere\" is missing"});
  refuse(R"({"base": "clear"})", {"\"lambent\": \"atmosphere\" is missing"});
  refuse(R"({"lambent": {"lambent": "atmosphere"}})", {"\"lambent\": \"atmosphere\" is missing"});
  refuse(std::string(100000, '['), {"not JSON", "nested"});
  std::string deep = R"({"lambent": "atmosphere", "air": )";
  for (int i = 0; i < 190; ++i) deep += R"({"air": )";
  refuse(deep + "1" + std::string(191, '}'), {"\"air.air\""});
  for (int i = 0; i < 65000; ++i) deep += R"({"air": )";
  refuse(deep, {"not JSON", "nested"});
  expectRefused(R"("ozone_dobson": 1e400)", {"not JSON", "1e400"});
  expectRefused(R"("ozone_dobson": NaN)", {"not JSON"});
  expectRefused(R"("ozone_dobson": -Infinity)", {"not JSON"});
  expectRefused(R"("ozone_dobson": 99999999999999999999999)", {"\"ozone_dobson\" is 9.99"});
  expectRefused(R"("ozone_dobson": 18446744073709551615)",
                {"\"ozone_dobson\" is 18446744073709551615"});
  expectRefused(R"("ozone_dobson": 1, "ozone_dobson": 2)",
                {"\"ozone_dobson\" stands twice in one object"});
  expectRefused(R"("aerosols": {"turbidity": 2, "turbidit\u0079": 3})",
                {"\"turbidity\" stands twice"});
  refuse(R"({"lambent": "light", "lambent": "atmosphere"})", {"\"lambent\" stands twice"});
  refuse(std::string((1 << 20) + 1, ' '), {"1048577 bytes are too many"});
  refuse("{\"lambent\": \"atmosphere\", \"name\": \"\xff\"}", {"not JSON"});
  // Cut anywhere it is no JSON.
  const std::string whole = toJson(*preset("standard"));
  for (std::size_t size = 0; size + 2 < whole.size(); ++size)
    EXPECT_FALSE(parseAtmosphere(std::string_view(whole).substr(0, size), "cut.json")) << size;
}

TEST(AtmosphereFile, IsReadFromDisk) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "lambent-atmosphere-file";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto path = folder / "sky.json";
  std::ofstream(path, std::ios::binary) << toJson(*preset("hazy"));
  const auto read = readAtmosphere(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, *preset("hazy"));

  const auto expectMessage = [](const Result<Atmosphere>& result, std::string_view word) {
    ASSERT_FALSE(result);
    EXPECT_EQ(int(result.error().kind), int(ErrorKind::BadInput)) << result.error().message;
    EXPECT_NE(result.error().message.find("sky.json"), std::string::npos);
    EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
  };
  std::ofstream(path, std::ios::binary) << std::string(2 << 20, ' ');
  expectMessage(readAtmosphere(path), "2097152 bytes are too many");
  expectMessage(readAtmosphere(folder / "no-sky.json"), "no-sky.json");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lambent::sky
