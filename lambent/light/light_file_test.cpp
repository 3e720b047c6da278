// The file LIGHT.json: it comes back bit for bit, and what is no light is refused.
#include "lambent/light/light_file.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "lambent/light/environment.h"
#include "lambent/math/random.h"

namespace lambent::light {
namespace {

class LightFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("lambent-light-") + test->test_suite_name() + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  std::filesystem::path folder_;
};
TEST_F(LightFile, ComesBackBitForBit) {
  math::Random random(4, 4);
  for (const int bands : {1, 2, 5, 10}) {
    sh::RgbCoefficients light(bands);
    for (float& value : light.values) {
      const std::uint32_t bits = std::uint32_t(random.bits() >> 32);
      std::memcpy(&value, &bits, sizeof value);
      if (!std::isfinite(value)) value = std::numeric_limits<float>::denorm_min();
    }
    light.values[0] = 0.1f;
    light.values[1] = -0.0f;
    light.values[2] = std::numeric_limits<float>::max();
    const Status written = writeLight(light, path("light.json"));
    ASSERT_TRUE(written) << written.error().message;
    const auto read = readLight(path("light.json"));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->bands, bands);
    EXPECT_EQ(std::memcmp(read->values.data(), light.values.data(), 4 * light.values.size()), 0);
    EXPECT_EQ(Environment::harmonics(*read).project(bands).values, light.values);
  }
}

TEST_F(LightFile, IsReadable) {
  sh::RgbCoefficients light(1);
  light.channel(0)[0] = 0.5f;
  light.channel(1)[0] = 0.1f;
  light.channel(2)[0] = 2;
  ASSERT_TRUE(writeLight(light, path("light.json")));
  std::ifstream file(path("light.json"));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text,
            "{\n  \"lambent\": \"light\",\n  \"bands\": 1,\n  \"coefficients\": [\n"
            "    [0.5, 0.100000001, 2]\n  ]\n}\n");
}

TEST_F(LightFile, RefusesWhatIsNoLight) {
  const auto refuse = [&](std::string_view text, std::initializer_list<const char*> words) {
    const std::string file = write("light.json", text);
    const auto light = readLight(file);
    ASSERT_FALSE(light) << text;
    const Error& error = light.error();
    EXPECT_EQ(int(error.kind), int(ErrorKind::BadInput)) << error.message;
    EXPECT_NE(error.message.find("light.json"), std::string::npos) << error.message;
    for (const char* word : words)
      EXPECT_NE(error.message.find(word), std::string::npos)
          << "'" << word << "' is missing in: " << error.message;
  };
  refuse("", {"not JSON", "\"coefficients\""});
  refuse("{\"lambent\": \"light\",\n \"bands\": }", {"not JSON", "line 2"});
  refuse("[1, 2]", {"\"lambent\": \"light\""});
  refuse("{\"lambent\": \"asset\"}", {"\"lambent\": \"light\""});
  refuse(R"({"lambent": "light", "bands": "2"})", {"\"bands\""});
  refuse(R"({"lambent": "light", "bands": 0, "coefficients": []})", {"\"bands\" is 0"});
  refuse(R"({"lambent": "light", "bands": 11, "coefficients": []})", {"\"bands\" is 11"});
  refuse(R"({"lambent": "light", "bands": 99999999999999999999, "coefficients": []})",
         {"\"bands\""});
  refuse(R"({"lambent": "light", "bands": 1})", {"\"coefficients\""});
  refuse(R"({"lambent": "light", "bands": 2, "coefficients": [[1, 2, 3]]})", {"1 rows", "need 4"});
  refuse(R"({"lambent": "light", "bands": 1, "coefficients": [[1, 2]]})", {"row 0", "[r, g, b]"});
  refuse(R"({"lambent": "light", "bands": 1, "coefficients": [[1, 2, "x"]]})",
         {"row 0, column 2", "\"x\"", "not a number"});
  refuse(R"({"lambent": "light", "bands": 1, "coefficients": [[1, null, 1]]})",
         {"row 0, column 1", "null"});
  refuse(R"({"lambent": "light", "bands": 1, "coefficients": [[1, NaN, 1]]})", {"not JSON"});
  refuse(R"({"lambent": "light", "bands": 1, "coefficients": [[1, 1e39, 1]]})",
         {"row 0, column 1", "32-bit"});
  refuse(R"({"lambent": "light", "bands": 1, "coefficients": [[1, 1e999, 1]]})", {"not JSON"});
  refuse(std::string(2 << 20, ' '), {"too many"});
  refuse(std::string(100000, '['), {"not JSON"});
}

TEST_F(LightFile, IsNotWrittenWithNumbersThatAreNone) {
  sh::RgbCoefficients light(1);
  light.channel(2)[0] = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(writeLight(light, path("light.json")));
  EXPECT_FALSE(std::filesystem::exists(path("light.json")));
  EXPECT_FALSE(writeLight(sh::RgbCoefficients(1), path("no/such/folder/light.json")));
}

}  // namespace
}  // namespace lambent::light
