#include "lambent/astronomy/sun.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/astronomy/appendix.h"
#include "lambent/astronomy/moon.h"
#include "lambent/astronomy/observer.h"
#include "lambent/astronomy/refraction.h"
#include "lambent/astronomy/test_sky.h"

namespace lambent::astronomy {
namespace {

double degreesOf(double degrees, double minutes, double seconds) {
  return (degrees + minutes / 60 + seconds / 3600) * kDegree;
}

/// Signed, −π … π.
double turn(double angle) {
  return std::remainder(angle, 2 * kPi);
}

TEST(Horizontal, CompassInTheWorld) {
  EXPECT_NEAR((worldDirection({0, 0}) - Vec3d(0, 0, -1)).norm(), 0, 1e-15);
  EXPECT_NEAR((worldDirection({kPi / 2, 0}) - Vec3d(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((worldDirection({1, kPi / 2}) - Vec3d(0, 1, 0)).norm(), 0, 1e-15);
  for (double azimuth = 0; azimuth < 6.28; azimuth += 0.1)
    for (double elevation = -1.5; elevation < 1.55; elevation += 0.1) {
      const Horizontal back = horizontalOf(3 * worldDirection({azimuth, elevation}));
      ASSERT_NEAR(back.azimuth, azimuth, 1e-12);
      ASSERT_NEAR(back.elevation, elevation, 1e-12);
    }
  EXPECT_EQ(horizontalOf({0, 2, 0}).azimuth, 0);
  EXPECT_EQ(horizontalOf({-1e-300, 0, -1}).azimuth, 0);
}

// meeus1998astronomical, examples 25.a and 25.b: 1992 October 13, 0 h TD; apparent place by the
// complete VSOP87.
TEST(Sun, TheWorkedExample) {
  const Equatorial sun = geocentricSun({2448908.5, 0});
  EXPECT_NEAR(sun.rightAscension, 15 * degreesOf(13, 13, 30.749), 0.3 * kSecond);
  EXPECT_NEAR(sun.declination, -degreesOf(7, 47, 1.74), 0.3 * kSecond);
  EXPECT_NEAR(sun.distance / kAstronomicalUnit, 0.99760853, 2e-7);
}

// reda2004solar, appendix A.5: 2003 October 17, 12:30:30 at 7 h behind UTC, ΔT 67 s.
TEST(Sun, TheExampleOfTheSolarPositionAlgorithm) {
  const Moment moment = *parseMoment("2003-10-17", "12:30:30", -7);
  const Place place = *placeFromDegrees(39.742476, -105.1786, 1830.14);
  const Topocentric sun = apparentSun(moment, place);
  const Horizontal seen = refracted(sun.direction, *airFromCelsius(11, 820));
  EXPECT_NEAR(seen.azimuth / kDegree, 194.34024, 0.0005);
  EXPECT_NEAR(90 - seen.elevation / kDegree, 50.11162, 0.0005);
  EXPECT_NEAR(sun.distance / kAstronomicalUnit, 0.9965422974, 5e-5);  // that is geocentric
}

double crossing(Moment low, double lastSecond, double level, const Place& place) {
  double a = 0, b = lastSecond;
  const auto above = [&](double second) {
    return apparentSun(*later(low, second), place).direction.elevation - level;
  };
  const bool sign = above(a) < 0;
  while (b - a > 0.01) {
    const double middle = (a + b) / 2;
    (above(middle) < 0) == sign ? a = middle : b = middle;
  }
  return a;
}

// The same example: the Sun's centre is 50′ below the horizon at 6:12:43 and 17:20:19. The latter
// falls on that day of UTC, which is the evening before in local time.
TEST(Sun, SunriseAndSunsetOfTheAlmanac) {
  const Moment midnight = *parseMoment("2003-10-17", "00:00", -7);
  const Place place = *placeFromDegrees(39.742476, -105.1786, 1830.14);
  const double level = -0.8333 * kDegree;
  const double sunrise = 6 * 3600 + 12 * 60 + 43, sunset = 17 * 3600 + 20 * 60 + 19;
  EXPECT_NEAR(crossing(midnight, 43200, level, place), sunrise, 2);
  EXPECT_NEAR(crossing(*later(midnight, -43200), 43200, level, place), sunset - 43200, 2);
  // Its upper limb by the refraction and the disc that we have ourselves; 1′ takes 5 s to rise.
  const Topocentric sun = apparentSun(*later(midnight, sunrise), place);
  const double limb = sun.direction.elevation + sunAngularRadius(sun.distance);
  EXPECT_NEAR(limb + refraction(limb), 0, 1 * kMinute);
}

double momentOfRightAscension(Moment start, double angle) {
  double a = 0, b = 86400;
  const auto after = [&](double second) {
    return turn(geocentricSun(terrestrialTime(*later(start, second))).rightAscension - angle);
  };
  while (b - a > 0.01) {
    const double middle = (a + b) / 2;
    after(middle) < 0 ? a = middle : b = middle;
  }
  return a;
}

TEST(Sun, EquinoxAndSolsticeOf2026) {
  const Moment march = *parseMoment("2026-03-20", "00:00", 0);
  const double equinox = momentOfRightAscension(march, 0);
  EXPECT_NEAR(equinox, 14 * 3600 + 46 * 60, 30);
  EXPECT_NEAR(geocentricSun(terrestrialTime(*later(march, equinox))).declination, 0, 1 * kSecond);
  const Moment june = *parseMoment("2026-06-21", "00:00", 0);
  const double solstice = momentOfRightAscension(june, kPi / 2);
  // Almanacs round to 8:24 or to 8:25.
  EXPECT_NEAR(solstice, 8 * 3600 + 24 * 60 + 30, 10);
  EXPECT_NEAR(geocentricSun(terrestrialTime(*later(june, solstice))).declination,
              degreesOf(23, 26, 11), 10 * kSecond);
}

// meeus1998astronomical, chapter 25, low accuracy, by hand: apparent longitude 280.3711° to .01°.
TEST(Sun, AtTheEpoch) {
  const Equatorial sun = geocentricSun({2451545.0, 0});
  EXPECT_NEAR(sun.rightAscension / kDegree, 281.2808, 0.01);
  EXPECT_NEAR(sun.declination / kDegree, -23.0326, 0.01);
  EXPECT_NEAR(sun.distance / kAstronomicalUnit, 0.983328, 2e-5);
}

TEST(Sun, TheAppendixIsWithin1_2MinutesOver1900To2100) {
  Samples samples(11, 1900, 2100);
  double worst = 0, worstDistance = 0;
  for (int i = 0; i < 6000; ++i) {
    const Moment moment = samples.moment();
    const Place place = samples.place();
    const Topocentric low = lowPrecisionSun(moment, place), precise = apparentSun(moment, place);
    worst = std::max(worst, angleBetween(low.direction, precise.direction));
    worstDistance = std::max(worstDistance, std::abs(low.distance / precise.distance - 1));
  }
  EXPECT_LT(worst, 1.2 * kMinute);
  EXPECT_LT(worstDistance, 1.5e-4);  // parallax .4e-4, the planets the rest
}

TEST(Sun, ParallaxAndAberrationAreWhatTheyShouldBe) {
  // The Sun at the horizon is lowered by its radius of the Earth over the distance; in the zenith it
  // is nearer by one.
  const Place equator{0, 0, 0};
  const Moment noon = *parseMoment("2026-03-20", "12:07", 0);
  const Equatorial geocentric = geocentricSun(terrestrialTime(noon));
  const Topocentric seen = apparentSun(noon, equator);
  EXPECT_GT(seen.direction.elevation, 89 * kDegree);
  EXPECT_NEAR(geocentric.distance - seen.distance, 6378137, 3000);
}

TEST(Sun, TheDisc) {
  EXPECT_NEAR(sunAngularRadius(kAstronomicalUnit) / kSecond, 959.2, 0.1);
  EXPECT_DOUBLE_EQ(sunIrradianceScale(2 * kAstronomicalUnit), 0.25);
  double least = 2, most = 0;
  for (int day = 0; day < 366; ++day) {
    const double scale = sunIrradianceScale(
        lowPrecisionSun(*later(*parseMoment("2026-01-01", "00:00", 0), 86400.0 * day), {})
            .distance);
    least = std::min(least, scale);
    most = std::max(most, scale);
  }
  EXPECT_NEAR(least, 0.967, 0.001);
  EXPECT_NEAR(most, 1.034, 0.001);
}

TEST(Appendix, PrecessionIsThatOfTheUnion) {
  for (double t = -1; t <= 1; t += 0.1) {
    // ERFA's has nutation in it, up to 20″.
    const Mat3d precise = trueFromCelestial({2451545.0, 36525 * t});
    const Eigen::AngleAxisd between(precise * appendix::precession(t).transpose());
    EXPECT_LT(between.angle(), 25 * kSecond) << t;
  }
}

// Continuous over the poles and over ±180°, finite everywhere, and one Sun under all of them.
TEST(Sun, PolesAndTheDateLine) {
  Samples samples(5, 1600, 2400);
  for (int i = 0; i < 300; ++i) {
    const Moment moment = samples.moment();
    for (const auto body : {lowPrecisionSun, apparentSun, lowPrecisionMoon, apparentMoon}) {
      const double latitude = samples.place().latitude;
      const Vec3d east = worldDirection(body(moment, {latitude, kPi, 0}).direction);
      const Vec3d west = worldDirection(body(moment, {latitude, -kPi, 0}).direction);
      ASSERT_LT((east - west).norm(), 1e-9);
      const Topocentric pole = body(moment, {kPi / 2, 1, 0});
      ASSERT_TRUE(worldDirection(pole.direction).allFinite());
      const Vec3d near = worldDirection(body(moment, {kPi / 2 - 1e-9, 1, 0}).direction);
      ASSERT_LT((worldDirection(pole.direction) - near).norm(), 1e-7);
      // On a pole the longitude turns the compass and nothing else.
      const Topocentric turned = body(moment, {kPi / 2, 2, 0});
      ASSERT_NEAR(turned.direction.elevation, pole.direction.elevation, 1e-9);
      ASSERT_NEAR(turn(turned.direction.azimuth - pole.direction.azimuth - 1), 0, 1e-7);
    }
  }
}

TEST(Sun, NoMomentAndPlaceWithoutAnAnswer) {
  Samples samples(6, 1600, 2400);
  for (int i = 0; i < 1500; ++i) {
    const Moment moment = samples.moment();
    Place place = samples.place();
    if (i % 7 == 0) place.latitude = std::copysign(kPi / 2, place.latitude);
    if (i % 5 == 0) place.longitude = std::copysign(kPi, place.longitude);
    for (const auto body : {lowPrecisionSun, apparentSun, lowPrecisionMoon, apparentMoon}) {
      const Topocentric found = body(moment, place);
      const Horizontal seen = refracted(found.direction, standardAir(place.altitude));
      for (const Horizontal& direction : {found.direction, seen}) {
        ASSERT_GE(direction.azimuth, 0);
        ASSERT_LT(direction.azimuth, 2 * kPi);
        ASSERT_GE(direction.elevation, -kPi / 2);
        ASSERT_LE(direction.elevation, kPi / 2);
      }
      ASSERT_TRUE(std::isfinite(found.distance));
      ASSERT_GT(found.distance, 3.4e8);
      ASSERT_LT(found.distance, 1.03 * kAstronomicalUnit);
    }
  }
}

// While the clock runs nothing steps: a second of time moves the Sun by 15″ at most, whatever day
// begins and whatever leap second was told.
TEST(Sun, RunsWithoutSteps) {
  for (const char* date : {"1959-12-31", "2016-12-31", "2026-12-31", "2099-12-31"})
    for (const auto body : {lowPrecisionSun, apparentSun}) {
      const Moment start = *parseMoment(date, "23:59:00", 0);
      const Place place{0.8, 2, 0};
      for (int second = 0; second < 120; ++second)
        ASSERT_LT(angleBetween(body(*later(start, second), place).direction,
                               body(*later(start, second + 1), place).direction),
                  15.2 * kSecond)
            << date;
    }
}

}  // namespace
}  // namespace lambent::astronomy
