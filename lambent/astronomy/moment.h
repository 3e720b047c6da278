// A moment as the civil clock tells it, and what it is called in the time scales of astronomy.
//
// UTC   the civil clock without its offset. Days have 86 400 s here: the second 23:59:60 has no name.
// UT1   the angle of the Earth's rotation; |UT1 − UTC| < 0.9 s since 1972.
// TT    terrestrial time, in which planets move evenly (delta_t.h).
#pragma once

#include <string_view>

#include "lambent/report/result.h"

namespace lambent::astronomy {

/// A Julian date as a sum, so that it keeps microseconds: `day` is a whole number or a half,
/// `fraction` a part of a day.
struct JulianDate {
  double day = 2451544.5;
  double fraction = 0.5;
};

/// Julian centuries of 36 525 days since 2000 January 1, 12 h (JD 2451545.0).
double centuriesSinceJ2000(const JulianDate& date);

inline constexpr int kFirstYear = 1600;
inline constexpr int kLastYear = 2400;

struct Moment {
  int day = 51544;         ///< UTC: modified Julian day, JD − 2400000.5; 51544 is 2000 January 1
  double second = 43200;   ///< UTC: of the day, [0, 86400)
  double ut1MinusUtc = 0;  ///< s; (−0.9, 0.9), as the Earth's rotation was measured; left at 0
                           ///< it turns the sky by up to 13.5″
};

/// A date and a time of day of the (proleptic) Gregorian calendar.
struct CivilTime {
  int year = 2000;
  int month = 1;      ///< 1 … 12
  int day = 1;        ///< 1 … 31
  int hour = 12;      ///< 0 … 23
  int minute = 0;     ///< 0 … 59
  double second = 0;  ///< [0, 60)
};

/// The moment at which a clock that is `utcOffsetHours` (−14 … 14, positive to the east) ahead of
/// UTC shows a date "YYYY-MM-DD", years kFirstYear … kLastYear, and a time "HH:MM", "HH:MM:SS" or
/// "HH:MM:SS.s", 00:00 … 23:59:59.99…. BadUsage for anything else: the message says what is wrong
/// and what is allowed.
Result<Moment> parseMoment(std::string_view date, std::string_view time, double utcOffsetHours);

/// The same from numbers.
Result<Moment> momentOf(const CivilTime& clock, double utcOffsetHours);

/// What that clock shows then.
CivilTime civilTime(const Moment& moment, double utcOffsetHours = 0);

/// `seconds` later, or earlier; ut1MinusUtc stays. BadUsage if that is no number or leaves the days
/// on which a clock somewhere shows the years kFirstYear … kLastYear.
Result<Moment> later(const Moment& moment, double seconds);

JulianDate universalTime(const Moment& moment);    ///< UT1
JulianDate coordinatedTime(const Moment& moment);  ///< UTC
JulianDate terrestrialTime(const Moment& moment);  ///< TT

}  // namespace lambent::astronomy
