// One table of Sun positions, tests/conventions/sun_positions.json, which library and web package
// both come to.
#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lambent/astronomy/delta_t.h"
#include "lambent/astronomy/refraction.h"
#include "lambent/astronomy/sun.h"
#include "lambent/astronomy/test_sky.h"

namespace lambent::astronomy {
namespace {

TEST(Conventions, SunPositions) {
  std::ifstream file(LAMBENT_SUN_POSITIONS);
  const nlohmann::json table = nlohmann::json::parse(file);
  ASSERT_EQ(table["positions"].size(), 20u);
  for (const nlohmann::json& row : table["positions"]) {
    const std::string utc = row["utc"];
    const Result<Moment> moment = parseMoment(utc.substr(0, 10), utc.substr(11), 0);
    ASSERT_TRUE(moment) << moment.error().message;
    const Result<Place> place = placeFromDegrees(row["latitude"], row["longitude"]);
    ASSERT_TRUE(place) << place.error().message;
    EXPECT_NEAR(terrestrialMinusUtc(*moment), row["terrestrialMinusUtc"], 0.01) << utc;
    const Topocentric sun = lowPrecisionSun(*moment, *place);
    const Horizontal expected{double(row["azimuth"]) * kDegree, double(row["elevation"]) * kDegree};
    EXPECT_LT(angleBetween(sun.direction, expected), 1e-8) << utc;
    EXPECT_NEAR(sun.distance / double(row["distance"]), 1, 1e-10) << utc;
    if (!row["seenElevation"].is_null()) {
      EXPECT_NEAR(refracted(sun.direction).elevation / kDegree, row["seenElevation"], 1e-6) << utc;
    }
  }
}

}  // namespace
}  // namespace lambent::astronomy
