#include "lambent/astronomy/moon.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/astronomy/sun.h"
#include "lambent/astronomy/test_sky.h"

namespace lambent::astronomy {
namespace {

double separation(const Topocentric& a, const Topocentric& b) {
  return angleBetween(a.direction, b.direction);
}

// meeus1998astronomical, example 47.a: 1992 April 12, 0 h TD.
TEST(Moon, TheWorkedExample) {
  const Equatorial moon = geocentricMoon({2448724.5, 0});
  EXPECT_NEAR(moon.rightAscension / kDegree, 134.688470, 0.0003);
  EXPECT_NEAR(moon.declination / kDegree, 13.768368, 0.0003);
  EXPECT_NEAR(moon.distance, 368409.7e3, 2e3);
}

// espenak2006five and the maps of its author: the places of greatest eclipse, where the axis of the
// shadow passes; the Moon stands before the Sun there.
TEST(Moon, StandsBeforeTheSunInItsEclipses) {
  struct Eclipse {
    const char *date, *time;
    double latitude, longitude, elevation;
  };
  for (const Eclipse& eclipse :
       {Eclipse{"2017-08-21", "18:25:32", 36 + 58.0 / 60, -(87 + 40.3 / 60), 63.9},
        Eclipse{"2024-04-08", "18:17:18", 25 + 17.4 / 60, -(104 + 8.3 / 60), 69.8},
        Eclipse{"1999-08-11", "11:03:04", 45 + 4.8 / 60, 24 + 17.3 / 60, 59.4}}) {
    const Moment moment = *parseMoment(eclipse.date, eclipse.time, 0);
    const Place place = *placeFromDegrees(eclipse.latitude, eclipse.longitude);
    const Topocentric sun = apparentSun(moment, place), moon = apparentMoon(moment, place);
    EXPECT_NEAR(sun.direction.elevation / kDegree, eclipse.elevation, 0.1) << eclipse.date;
    EXPECT_LT(separation(sun, moon), 20 * kSecond) << eclipse.date;
    EXPECT_GT(moonAngularRadius(moon.distance), sunAngularRadius(sun.distance));
    EXPECT_NEAR(phaseAngle(sun, moon), kPi, 0.001);
    EXPECT_LT(separation(lowPrecisionSun(moment, place), lowPrecisionMoon(moment, place)),
              8 * kMinute);
  }
}

TEST(Moon, TheAppendixIsWithin8MinutesOver1900To2100) {
  Samples samples(21, 1900, 2100);
  double worst = 0, worstDistance = 0;
  for (int i = 0; i < 6000; ++i) {
    const Moment moment = samples.moment();
    const Place place = samples.place();
    const Topocentric approximate = lowPrecisionMoon(moment, place);
    const Topocentric precise = apparentMoon(moment, place);
    worst = std::max(worst, separation(approximate, precise));
    worstDistance = std::max(worstDistance, std::abs(approximate.distance / precise.distance - 1));
  }
  EXPECT_LT(worst, 8 * kMinute);
  EXPECT_LT(worstDistance, 3e-3);
}

TEST(Moon, Phases) {
  const double far = 1.5e11, near = 3.8e8;
  const Topocentric moon{{1, 0.5}, near};
  EXPECT_NEAR(phaseAngle({{1, 0.5}, far}, moon), kPi, 1e-9);
  EXPECT_NEAR(phaseAngle({{1 + kPi, -0.5}, far}, moon), 0, 1e-9);
  EXPECT_NEAR(phaseAngle({{1, 0.5 + kPi / 2}, far}, moon), kPi / 2 - std::atan(near / far), 1e-9);
  EXPECT_DOUBLE_EQ(illuminatedFraction(0), 1);
  EXPECT_DOUBLE_EQ(illuminatedFraction(kPi / 2), 0.5);
  EXPECT_NEAR(illuminatedFraction(kPi), 0, 1e-15);
  // meeus1998astronomical, example 48.a: 1992 April 12, 0 h TD: phase 69.0756°, fraction .6786.
  const Moment moment = *parseMoment("1992-04-11", "23:59:01", 0);
  const Place nearby{0, 0, 0};
  const double phase = phaseAngle(apparentSun(moment, nearby), apparentMoon(moment, nearby));
  EXPECT_NEAR(phase / kDegree, 69.0756, 1);  // that is for the Earth's centre
}

TEST(Moon, TheTerminatorLiesAcrossTheSunlight) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Topocentric sun{{kPi + kPi * unit(random), std::asin(unit(random))}, 1.5e11};
    const Topocentric moon{{kPi + kPi * unit(random), std::asin(unit(random))}, 3.8e8};
    const Vec3d s = sun.distance * worldDirection(sun.direction);
    const Vec3d m = moon.distance * worldDirection(moon.direction);
    const Vec3d terminator = terminatorDirection(sun, moon);
    ASSERT_NEAR(terminator.norm(), 1, 1e-9);
    ASSERT_NEAR(terminator.dot((s - m).normalized()), 0, 1e-9);
    ASSERT_NEAR(terminator.dot(s.cross(m).normalized()), 0, 1e-9);
    ASSERT_GT(terminator.dot(-m), 0);  // on the side that is seen
  }
  const Topocentric same{{1, 0.3}, 1e9};
  EXPECT_EQ(terminatorDirection(same, same).norm(), 0);
}

}  // namespace
}  // namespace lambent::astronomy
