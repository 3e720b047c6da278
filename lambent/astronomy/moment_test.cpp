#include "lambent/astronomy/moment.h"

#include <cmath>
#include <random>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "lambent/astronomy/delta_t.h"
#include "lambent/astronomy/place.h"
#include "lambent/math/types.h"

namespace lambent::astronomy {
namespace {

double julian(const JulianDate& date) {
  return date.day + date.fraction;
}

std::string refusal(std::string_view date, std::string_view time, double offset = 0) {
  const Result<Moment> moment = parseMoment(date, time, offset);
  return moment ? "accepted" : moment.error().message;
}

testing::AssertionResult refuses(const std::string& message, std::string_view what) {
  if (message.find(what) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << message << "' does not say '" << what << "'";
}

TEST(Moment, JulianDatesThatTheWorldAgreesOn) {
  EXPECT_EQ(julian(coordinatedTime(*parseMoment("2000-01-01", "12:00", 0))), 2451545.0);
  EXPECT_EQ(julian(coordinatedTime(*parseMoment("1858-11-17", "00:00", 0))), 2400000.5);
  EXPECT_EQ(julian(coordinatedTime(*parseMoment("1987-06-19", "12:00", 0))), 2446966.0);
  EXPECT_EQ(julian(coordinatedTime(*parseMoment("1600-01-01", "00:00", 0))), 2305447.5);
  EXPECT_EQ(julian(coordinatedTime(*parseMoment("2400-12-31", "00:00", 0))), 2598006.5);
}

// jensen2001physically (9), whose floors are their own arithmetic.
TEST(Moment, AgreesWithTheFormulaOfTheAppendix) {
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    CivilTime clock;
    clock.year = 1600 + int(random() % 801);
    clock.month = 1 + int(random() % 12);
    clock.day = 1 + int(random() % 28);
    clock.hour = int(random() % 24);
    clock.minute = int(random() % 60);
    clock.second = double(random() % 60000) / 1000;
    const int y = clock.month <= 2 ? clock.year - 1 : clock.year;
    const int m = clock.month <= 2 ? clock.month + 12 : clock.month;
    const double expected = 1720996.5 - std::floor(y / 100) + std::floor(y / 400) +
                            std::floor(365.25 * y) + std::floor(30.6001 * (m + 1)) + clock.day +
                            (clock.hour + (clock.minute + clock.second / 60) / 60) / 24;
    const Moment moment = *momentOf(clock, 0);
    ASSERT_NEAR(julian(coordinatedTime(moment)), expected, 1e-9);
    const CivilTime back = civilTime(moment);
    ASSERT_EQ(back.year, clock.year);
    ASSERT_EQ(back.month, clock.month);
    ASSERT_EQ(back.day, clock.day);
    ASSERT_NEAR(3600 * back.hour + 60 * back.minute + back.second,
                3600 * clock.hour + 60 * clock.minute + clock.second, 1e-9);
  }
}

TEST(Moment, EveryDayFollowsTheOneBefore) {
  Moment moment = *parseMoment("1600-01-01", "00:00", 0);
  for (int year = 1600; year <= 2400; ++year)
    for (int month = 1; month <= 12; ++month)
      for (int day = 1; day <= 31; ++day) {
        CivilTime clock;
        clock.year = year;
        clock.month = month;
        clock.day = day;
        clock.hour = 0;
        const Result<Moment> found = momentOf(clock, 0);
        if (!found) continue;
        ASSERT_EQ(found->day, moment.day) << year << '-' << month << '-' << day;
        ASSERT_EQ(civilTime(moment).day, day);
        moment.day += 1;
      }
  EXPECT_EQ(moment.day - parseMoment("1600-01-01", "00:00", 0)->day, 2 * 146097 + 366);
}

TEST(Moment, ClocksAheadOfUtcShowTheSameMomentLater) {
  const Moment utc = *parseMoment("2026-06-21", "03:40:30.25", 0);
  for (const auto& [date, time, offset] : {std::tuple{"2026-06-21", "05:40:30.25", 2.0},
                                           {"2026-06-20", "17:40:30.25", -10.0},
                                           {"2026-06-21", "09:10:30.25", 5.5},
                                           {"2026-06-21", "17:40:30.25", 14.0}}) {
    const Moment moment = *parseMoment(date, time, offset);
    EXPECT_EQ(moment.day, utc.day) << date;
    EXPECT_DOUBLE_EQ(moment.second, utc.second) << date;
    EXPECT_EQ(civilTime(moment, offset).hour, std::stoi(std::string(time)));
  }
}

TEST(Moment, SecondsCarryOverDaysMonthsAndYears) {
  const Moment eve = *parseMoment("2023-12-31", "23:59:59.5", 0);
  const CivilTime after = civilTime(*later(eve, 1));
  EXPECT_EQ(after.year, 2024);
  EXPECT_EQ(after.month, 1);
  EXPECT_EQ(after.day, 1);
  EXPECT_DOUBLE_EQ(after.second, 0.5);
  const CivilTime leap = civilTime(*later(*parseMoment("2024-02-28", "12:00", 0), 86400));
  EXPECT_EQ(leap.month, 2);
  EXPECT_EQ(leap.day, 29);
  const Moment back = *later(*later(eve, 1e9), -1e9);
  EXPECT_EQ(back.day, eve.day);
  EXPECT_NEAR(back.second, eve.second, 1e-6);
  const Moment hair = *later(*parseMoment("2024-01-01", "00:00", 0), -1e-13);
  EXPECT_LT(hair.second, 86400);
  EXPECT_GE(hair.second, 0);
  EXPECT_FALSE(later(eve, std::nan("")));
  EXPECT_FALSE(later(eve, 1e300));
  EXPECT_FALSE(later(eve, 86400.0 * 366 * 400));
  EXPECT_TRUE(later(*parseMoment("2400-12-31", "23:59", -14), 59));
}

TEST(Moment, WhatCannotBeIsRefusedWithItsReason) {
  EXPECT_TRUE(refuses(refusal("1599-12-31", "12:00"), "1600 to 2400"));
  EXPECT_TRUE(refuses(refusal("2401-01-01", "12:00"), "1600 to 2400"));
  EXPECT_TRUE(refuses(refusal("2026-13-01", "12:00"), "months run from 1 to 12"));
  EXPECT_TRUE(refuses(refusal("2026-00-01", "12:00"), "months run from 1 to 12"));
  EXPECT_TRUE(refuses(refusal("2026-02-29", "12:00"), "2026-02 has the days 1 to 28"));
  EXPECT_TRUE(refuses(refusal("1900-02-29", "12:00"), "1900-02 has the days 1 to 28"));
  EXPECT_TRUE(refuses(refusal("2026-04-31", "12:00"), "2026-04 has the days 1 to 30"));
  EXPECT_TRUE(refuses(refusal("2026-04-00", "12:00"), "2026-04 has the days 1 to 30"));
  EXPECT_TRUE(refuses(refusal("2026-06-21", "24:00"), "00:00 of the next day"));
  EXPECT_TRUE(refuses(refusal("2026-06-21", "12:60"), "minutes run from 0 to 59"));
  EXPECT_TRUE(refuses(refusal("2026-06-21", "23:59:60"), "less than 60"));
  EXPECT_TRUE(refuses(refusal("2026-06-21", "12:00", 14.5), "-14 to 14"));
  EXPECT_TRUE(refuses(refusal("2026-06-21", "12:00", std::nan("")), "-14 to 14"));
  for (const char* date : {"", "2026", "2026-6-21", "2026-06-21 ", "21.06.2026", "2026-06-2x",
                           "+026-06-21", "-026-06-21", "nan", "2026/06/21", "20260621"})
    EXPECT_TRUE(refuses(refusal(date, "12:00"), "YYYY-MM-DD")) << date;
  for (const char* time : {"", "12", "12:0", "1:00", "12:00:", "12:00:1", "12:00:00.", "12:00:0.5",
                           "12.00", "12:00:00.5x", "nan:00", "-1:00", "12:00:1e1", "12:00 "})
    EXPECT_TRUE(refuses(refusal("2026-06-21", time), "HH:MM")) << time;
  EXPECT_EQ(refusal("2024-02-29", "23:59:59.999"), "accepted");
  EXPECT_EQ(refusal("2000-02-29", "00:00"), "accepted");
}

// Values of espenak2006five, table of ΔT by observation.
TEST(DeltaT, IsThatOfTheRecord) {
  EXPECT_NEAR(polynomialDeltaT(1600), 120, 1e-9);
  EXPECT_NEAR(polynomialDeltaT(1700), 9, 0.5);
  EXPECT_NEAR(polynomialDeltaT(1800), 14, 0.5);
  EXPECT_NEAR(polynomialDeltaT(1900), -2.7, 0.1);
  EXPECT_NEAR(polynomialDeltaT(1950), 29.1, 0.1);
  EXPECT_NEAR(polynomialDeltaT(1955), 31.1, 0.1);
  EXPECT_NEAR(polynomialDeltaT(1980), 50.5, 0.1);
  EXPECT_NEAR(polynomialDeltaT(2000), 63.8, 0.1);
}

TEST(DeltaT, PiecesMeet) {
  for (const double year : {1700, 1800, 1860, 1900, 1920, 1941, 1961, 1986, 2005, 2050, 2150})
    EXPECT_NEAR(polynomialDeltaT(year - 1e-9), polynomialDeltaT(year), 0.2) << year;
}

TEST(DeltaT, LeapSecondsWhereTheyAreKnown) {
  const auto at = [](const char* date) {
    return terrestrialMinusUtc(*parseMoment(date, "00:00", 0));
  };
  EXPECT_DOUBLE_EQ(at("2017-01-01"), 69.184);
  EXPECT_DOUBLE_EQ(at("2016-12-31"), 68.184);
  EXPECT_DOUBLE_EQ(at("1972-01-01"), 42.184);
  EXPECT_DOUBLE_EQ(at("1999-01-01"), 64.184);
  // Neither end steps by what anyone sees: a second turns the Sun by .04″ among the stars.
  for (const char* date : {"1960-01-01", "2027-01-01"}) {
    const Moment end = *parseMoment(date, "00:00", 0);
    EXPECT_NEAR(terrestrialMinusUtc(*later(end, -1)), terrestrialMinusUtc(end), 0.1) << date;
  }
  EXPECT_NEAR(at("2200-01-01"), polynomialDeltaT(2200), 0.01);
}

TEST(Place, DegreesAndWhatIsRefused) {
  const Place place = *placeFromDegrees(-90, 180, 20);
  EXPECT_DOUBLE_EQ(place.latitude, -kPi / 2);
  EXPECT_DOUBLE_EQ(place.longitude, kPi);
  EXPECT_TRUE(refuses(placeFromDegrees(90.01, 0).error().message, "-90 (south) to 90"));
  EXPECT_TRUE(refuses(placeFromDegrees(std::nan(""), 0).error().message, "latitude"));
  EXPECT_TRUE(refuses(placeFromDegrees(0, 181).error().message, "-180 (west) to 180"));
  EXPECT_TRUE(refuses(placeFromDegrees(0, INFINITY).error().message, "longitude"));
  EXPECT_TRUE(refuses(placeFromDegrees(0, 0, -1000).error().message, "altitude"));
  EXPECT_TRUE(refuses(placeFromDegrees(0, 0, 1e6).error().message, "altitude"));
}

}  // namespace
}  // namespace lambent::astronomy
