#!/usr/bin/env python3
"""Writes sun_positions.json: where the Sun stands at some moments and places by the formulas of
jensen2001physically, which the tests of the C++ library and of the web package both read.

usage: make_sun_positions.py [--check] (without it: writes sun_positions.json beside this file)

Everything follows from the printed formulas and from spherical trigonometry, and from nothing of
Lambent's: where those turn vectors by matrices, this takes right ascension, declination and hour
angle. Terrestrial time is that of leap seconds where a row tells them, else of the polynomials of
espenak2006five.
"""
import json
import math
import sys
from datetime import datetime, timezone
from pathlib import Path

# Date and time (UTC), TT − UTC or None, latitude, longitude (degrees).
ROWS = [
    ("2026-06-21T03:40:00", 69.184, 46.2, 6.1),
    ("2026-06-21T11:37:00", 69.184, 46.2, 6.1),
    ("2026-06-21T19:28:30", 69.184, 46.2, 6.1),
    ("2026-12-21T12:00:00", 69.184, 51.4779, 0),
    ("2026-03-20T06:05:00", 69.184, 0, 0),
    ("2026-03-20T12:07:25", 69.184, 0, 0),
    ("2024-02-29T23:59:59", 69.184, -33.8568, 151.2153),
    ("2017-01-01T00:00:00", 69.184, 40.7128, -74.006),
    ("2016-12-31T23:59:59", 68.184, 40.7128, -74.006),
    ("2003-10-17T19:30:30", 64.184, 39.742476, -105.1786),
    ("2000-01-01T12:00:00", 64.184, 89.9, 30),
    ("1999-08-11T11:03:04", 64.184, 45.08, 24.2883),
    ("1987-04-10T19:21:00", 55.184, -90, 0),
    ("1955-05-05T05:05:05", None, 27.9881, 86.925),
    ("1900-01-01T00:00:00", None, -12, 180),
    ("1850-07-04T15:30:00", None, 64.1466, -21.9426),
    ("1755-11-01T09:40:00", None, 38.7223, -9.1393),
    ("1600-01-01T06:00:00", None, 50.0755, 14.4378),
    ("2199-09-23T17:45:12.500", None, -54.8, -68.3),
    ("2400-12-31T21:00:00", None, 66.6, -180),
]

# First year of validity, origin, coefficients from the constant term up.
DELTA_T = [
    (1600, 1600, [120, -0.9808, -0.01532, 1 / 7129]),
    (1700, 1700, [8.83, 0.1603, -0.0059285, 0.00013336, -1 / 1174000]),
    (1800, 1800, [13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272,
                  -0.0000001699, 0.000000000875]),
    (1900, 1900, [-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197]),
    (1941, 1950, [29.07, 0.407, -1 / 233, 1 / 2547]),
    (2150, 1820, [-20, 0, 32 / 10000]),
]


def delta_t(year):
    _, origin, coefficients = [piece for piece in DELTA_T if piece[0] <= year][-1]
    return sum(c * (year - origin) ** k for k, c in enumerate(coefficients))


def refraction(h):
    """Degrees, by saemundsson1986refraction in minutes, for h ≥ −1°."""
    lift = 1.02 / math.tan(math.radians(h + 10.3 / (h + 5.11))) + 0.0019279
    return lift / 60


def row(moment, terrestrial_minus_utc, latitude, longitude):
    utc = datetime.fromisoformat(moment).replace(tzinfo=timezone.utc)
    since = utc - datetime(2000, 1, 1, 12, tzinfo=timezone.utc)
    days = since.days + (since.seconds + since.microseconds * 1e-6) / 86400
    if terrestrial_minus_utc is None:
        terrestrial_minus_utc = delta_t(2000 + (days + 0.5) / 365.25)
    t = (days + terrestrial_minus_utc / 86400) / 36525
    m = 6.24 + 628.302 * t
    ecliptic_longitude = (4.895048 + 628.331951 * t + (0.033417 - 0.000084 * t) * math.sin(m)
                          + 0.000351 * math.sin(2 * m))
    distance = (1.000140 - (0.016708 - 0.000042 * t) * math.cos(m)
                - 0.000141 * math.cos(2 * m))
    obliquity = 0.409093 - 0.000227 * t
    declination = math.asin(math.sin(obliquity) * math.sin(ecliptic_longitude))
    right_ascension = math.atan2(math.cos(obliquity) * math.sin(ecliptic_longitude),
                                 math.cos(ecliptic_longitude))
    phi = math.radians(latitude)
    hour_angle = (4.894961 + 230121.675315 * days / 36525 + math.radians(longitude)
                  - right_ascension)
    elevation = math.asin(math.sin(phi) * math.sin(declination)
                          + math.cos(phi) * math.cos(declination) * math.cos(hour_angle))
    azimuth = math.atan2(-math.cos(declination) * math.sin(hour_angle),
                         math.sin(declination) * math.cos(phi)
                         - math.cos(declination) * math.cos(hour_angle) * math.sin(phi))
    h = math.degrees(elevation)
    return {
        "utc": moment, "latitude": latitude, "longitude": longitude,
        "terrestrialMinusUtc": terrestrial_minus_utc,
        "azimuth": math.degrees(azimuth) % 360, "elevation": h,
        "seenElevation": h + refraction(h) if h >= -1 else None,
        "distance": distance * 149597870700.0,
    }


def main():
    path = Path(__file__).with_name("sun_positions.json")
    made = {"positions": [row(*r) for r in ROWS]}
    if "--check" not in sys.argv[1:]:
        path.write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8")
        return 0
    stored = json.loads(path.read_text(encoding="utf-8"))["positions"]
    for a, b in zip(made["positions"], stored):
        same = a.keys() == b.keys() and all(
            abs(a[k] - b[k]) <= 1e-9 * max(1, abs(a[k])) if isinstance(a[k], float) and
            isinstance(b[k], float) else a[k] == b[k] for k in a)
        if not same:
            print(f"sun_positions.json is not what make_sun_positions.py writes: {b}",
                  file=sys.stderr)
            return 1
    return 0 if len(stored) == len(ROWS) else 1


if __name__ == "__main__":
    sys.exit(main())
