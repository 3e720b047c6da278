#include "lambent/astronomy/moment.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "lambent/astronomy/delta_t.h"

namespace lambent::astronomy {
namespace {

constexpr double kSecondsPerDay = 86400;
constexpr double kJulianOfModified = 2400000.5;
constexpr double kMostOffset = 14;

bool isLeap(int year) {
  return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

int daysInMonth(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return month == 2 && isLeap(year) ? 29 : kDays[month - 1];
}

/// Days are counted from March 1, so that the leap day is a year's last; years here are positive.
int modifiedJulianDay(int year, int month, int day) {
  const int y = month > 2 ? year : year - 1;
  const int sinceMarch = (month + 9) % 12;
  return 365 * y + y / 4 - y / 100 + y / 400 + (153 * sinceMarch + 2) / 5 + day - 678882;
}

const int kFirstDay = modifiedJulianDay(kFirstYear, 1, 1) - 1;
const int kLastDay = modifiedJulianDay(kLastYear, 12, 31) + 1;

/// Digits alone, `width` of them.
std::optional<int> digits(std::string_view text, std::size_t at, std::size_t width) {
  if (at + width > text.size()) return std::nullopt;
  int value = 0;
  for (const char c : text.substr(at, width)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

std::optional<double> seconds(std::string_view text) {
  if (!digits(text, 0, 2)) return std::nullopt;
  if (text.size() > 2 && (text[2] != '.' || text.size() == 3)) return std::nullopt;
  for (const char c : text.substr(std::min<std::size_t>(text.size(), 3)))
    if (c < '0' || c > '9') return std::nullopt;
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Carries what is more than a day, or less than none, over to the day.
Result<Moment> carried(double day, double second, double ut1MinusUtc) {
  double whole = std::floor(second / kSecondsPerDay);
  double rest = second - whole * kSecondsPerDay;
  if (rest >= kSecondsPerDay) {  // a hair below 0, rounded up
    whole += 1;
    rest = 0;
  }
  rest = std::max(rest, 0.0);
  day += whole;
  if (!(day >= kFirstDay && day <= kLastDay))  // no number fails as well
    return report::badUsage(
        fmt::format("a moment outside of the years {} to {}", kFirstYear, kLastYear));
  return Moment{int(day), rest, ut1MinusUtc};
}

JulianDate julianDate(const Moment& moment, double addedSeconds) {
  return {kJulianOfModified + moment.day, (moment.second + addedSeconds) / kSecondsPerDay};
}

}  // namespace

double centuriesSinceJ2000(const JulianDate& date) {
  return ((date.day - 2451545.0) + date.fraction) / 36525.0;
}

Result<Moment> momentOf(const CivilTime& clock, double utcOffsetHours) {
  const auto [year, month, day, hour, minute, second] = clock;
  if (year < kFirstYear || year > kLastYear)
    return report::badUsage(
        fmt::format("the year {}: years run from {} to {}", year, kFirstYear, kLastYear));
  if (month < 1 || month > 12)
    return report::badUsage(fmt::format("the month {}: months run from 1 to 12", month));
  if (day < 1 || day > daysInMonth(year, month))
    return report::badUsage(fmt::format("the day {}: {:04}-{:02} has the days 1 to {}", day, year,
                                        month, daysInMonth(year, month)));
  if (hour < 0 || hour > 23)
    return report::badUsage(fmt::format(
        "the hour {}: hours run from 0 to 23, and midnight is 00:00 of the next day", hour));
  if (minute < 0 || minute > 59)
    return report::badUsage(fmt::format("the minute {}: minutes run from 0 to 59", minute));
  if (!(second >= 0 && second < 60))
    return report::badUsage(fmt::format(
        "the second {}: seconds run from 0 to less than 60, without leap seconds", second));
  if (!(std::abs(utcOffsetHours) <= kMostOffset))
    return report::badUsage(
        fmt::format("the offset from UTC {}: hours from -14 to 14, for example "
                    "2 for Central European Summer Time",
                    utcOffsetHours));
  return carried(modifiedJulianDay(year, month, day),
                 3600.0 * hour + 60.0 * minute + second - 3600.0 * utcOffsetHours, 0);
}

Result<Moment> parseMoment(std::string_view date, std::string_view time, double utcOffsetHours) {
  CivilTime clock;
  const auto year = digits(date, 0, 4), month = digits(date, 5, 2), day = digits(date, 8, 2);
  if (date.size() != 10 || date[4] != '-' || date[7] != '-' || !year || !month || !day)
    return report::badUsage(
        fmt::format("the date '{}' is not written YYYY-MM-DD, for example 2026-06-21", date));
  const auto hour = digits(time, 0, 2), minute = digits(time, 3, 2);
  const bool told = time.size() > 5;
  const auto second = told ? seconds(time.substr(6)) : std::optional<double>(0.0);
  if (time.size() < 5 || time[2] != ':' || !hour || !minute || (told && time[5] != ':') || !second)
    return report::badUsage(fmt::format(
        "the time '{}' is not written HH:MM or HH:MM:SS, for example 05:40 or 05:40:30.5", time));
  clock = {*year, *month, *day, *hour, *minute, *second};
  Result<Moment> moment = momentOf(clock, utcOffsetHours);
  if (!moment)
    return report::badUsage(fmt::format("'{} {}': {}", date, time, moment.error().message));
  return moment;
}

CivilTime civilTime(const Moment& moment, double utcOffsetHours) {
  double second = moment.second + 3600 * utcOffsetHours;
  const double carry = std::floor(second / kSecondsPerDay);
  second = std::max(second - carry * kSecondsPerDay, 0.0);
  // The inverse of modifiedJulianDay: eras of 400 years, years that begin on March 1.
  const int sinceEra = moment.day + int(carry) + 678881;
  const int era = sinceEra / 146097;
  const int dayOfEra = sinceEra % 146097;
  const int yearOfEra = (dayOfEra - dayOfEra / 1460 + dayOfEra / 36524 - dayOfEra / 146096) / 365;
  const int dayOfYear = dayOfEra - (365 * yearOfEra + yearOfEra / 4 - yearOfEra / 100);
  const int sinceMarch = (5 * dayOfYear + 2) / 153;
  CivilTime clock;
  clock.day = dayOfYear - (153 * sinceMarch + 2) / 5 + 1;
  clock.month = sinceMarch < 10 ? sinceMarch + 3 : sinceMarch - 9;
  clock.year = 400 * era + yearOfEra + (clock.month <= 2 ? 1 : 0);
  const int minutes = std::min(int(second / 60), 24 * 60 - 1);
  clock.hour = minutes / 60;
  clock.minute = minutes % 60;
  clock.second = std::min(second - 60.0 * minutes, std::nextafter(60.0, 0.0));
  return clock;
}

Result<Moment> later(const Moment& moment, double seconds) {
  return carried(moment.day, moment.second + seconds, moment.ut1MinusUtc);
}

JulianDate universalTime(const Moment& moment) {
  return julianDate(moment, moment.ut1MinusUtc);
}

JulianDate coordinatedTime(const Moment& moment) {
  return julianDate(moment, 0);
}

JulianDate terrestrialTime(const Moment& moment) {
  return julianDate(moment, terrestrialMinusUtc(moment));
}

}  // namespace lambent::astronomy
