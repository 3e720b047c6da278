// This work is based on:
// - jensen2001physically, appendix: sidereal time, obliquity, the Sun's longitude and distance.
// - espenak2006five: polynomials for ΔT.
// - saemundsson1986refraction, meeus1998astronomical (chapter 16): refraction.
// - prsa2016nominal: the nominal radius of the Sun.
//
// As lambent/astronomy/sun.cpp (lowPrecisionSun), delta_t.cpp and refraction.cpp, but for leap
// seconds, which the library knows and which move the Sun by .3″. Within 1.1′ of the true place over
// 1900-2100. Azimuths are compass bearings: north 0, east π/2.

const kDegree = Math.PI / 180;
const kAstronomicalUnit = 149597870700; // m
const kSunRadius = 6.957e8; // m
const kFirstTime = Date.UTC(1599, 11, 31);
const kLastTime = Date.UTC(2401, 0, 2);

export interface SunPosition {
  /** Compass bearing in radians: north 0, east π/2; [0, 2π). */
  azimuth: number;
  /** Radians above the horizon, without refraction. */
  elevation: number;
  /** Metres from the Earth's centre. */
  distance: number;
}

function polynomial(t: number, ...coefficients: number[]): number {
  return coefficients.reduceRight((sum, c) => sum * t + c, 0);
}

/**
 * How far terrestrial time is ahead of the Earth's rotation, ΔT = TT − UT1, in seconds.
 *
 * @param year decimal, 1600 … 2401
 */
export function polynomialDeltaT(year: number): number {
  if (year < 1700) return polynomial(year - 1600, 120, -0.9808, -0.01532, 1 / 7129);
  if (year < 1800)
    return polynomial(year - 1700, 8.83, 0.1603, -0.0059285, 0.00013336, -1 / 1174000);
  if (year < 1860)
    return polynomial(
      year - 1800,
      ...[13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272, -0.0000001699],
      0.000000000875,
    );
  if (year < 1900)
    return polynomial(year - 1860, 7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1 / 233174);
  if (year < 1920)
    return polynomial(year - 1900, -2.79, 1.494119, -0.0598939, 0.0061966, -0.000197);
  if (year < 1941) return polynomial(year - 1920, 21.2, 0.84493, -0.0761, 0.0020936);
  if (year < 1961) return polynomial(year - 1950, 29.07, 0.407, -1 / 233, 1 / 2547);
  if (year < 1986) return polynomial(year - 1975, 45.45, 1.067, -1 / 260, -1 / 718);
  if (year < 2005)
    return polynomial(
      year - 2000,
      ...[63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599],
    );
  if (year < 2050) return polynomial(year - 2000, 62.92, 0.32217, 0.005589);
  const parabola = -20 + 32 * ((year - 1820) / 100) ** 2;
  return year < 2150 ? parabola - 0.5628 * (2150 - year) : parabola;
}

/**
 * Where the Sun stands. Throws a RangeError for a time outside of 1600 … 2400 and for a place that
 * is not on the Earth.
 *
 * @param time UTC, milliseconds since 1970, as `Date.getTime()` and `Date.UTC()` tell it
 * @param latitude radians, −π/2 … π/2, north positive
 * @param longitude radians, −π … π, east positive
 */
export function sunPosition(time: number, latitude: number, longitude: number): SunPosition {
  if (!(time >= kFirstTime && time <= kLastTime))
    throw new RangeError(`the time ${time}: milliseconds since 1970 of the years 1600 to 2400`);
  if (!(Math.abs(latitude) <= Math.PI / 2))
    throw new RangeError(`the latitude ${latitude}: radians from -π/2 (south) to π/2 (north)`);
  if (!(Math.abs(longitude) <= Math.PI))
    throw new RangeError(`the longitude ${longitude}: radians from -π (west) to π (east)`);

  const days = time / 86400000 - 10957.5; // since 2000 January 1, 12 h
  const turned = days / 36525; // centuries by the Earth's rotation
  const t = (days + polynomialDeltaT(2000 + (days + 0.5) / 365.25) / 86400) / 36525;

  // The Sun in the ecliptic, then along the equator.
  const m = 6.24 + 628.302 * t;
  const lambda =
    4.895048 +
    628.331951 * t +
    (0.033417 - 0.000084 * t) * Math.sin(m) +
    0.000351 * Math.sin(2 * m);
  const distance =
    1.00014 - (0.016708 - 0.000042 * t) * Math.cos(m) - 0.000141 * Math.cos(2 * m);
  const obliquity = 0.409093 - 0.000227 * t;
  const x = Math.cos(lambda);
  const y = Math.sin(lambda) * Math.cos(obliquity);
  const z = Math.sin(lambda) * Math.sin(obliquity);

  // Turned to the observer's meridian, and down from the pole to his horizon.
  const sidereal = 4.894961 + 230121.675315 * turned + longitude;
  const meridian = x * Math.cos(sidereal) + y * Math.sin(sidereal);
  const east = y * Math.cos(sidereal) - x * Math.sin(sidereal);
  const south = meridian * Math.sin(latitude) - z * Math.cos(latitude);
  const up = meridian * Math.cos(latitude) + z * Math.sin(latitude);

  let azimuth = Math.atan2(east, -south);
  if (azimuth < 0) azimuth += 2 * Math.PI;
  if (azimuth >= 2 * Math.PI) azimuth = 0;
  return {
    azimuth,
    elevation: Math.atan2(up, Math.hypot(south, east)),
    distance: distance * kAstronomicalUnit,
  };
}

/** The air where the observer stands. */
export interface Air {
  /** Kelvin; 283 unless told. */
  temperature?: number;
  /** Pascal; 101 000 unless told. 0: no refraction. */
  pressure?: number;
}

const kJoin = -1; // degrees: above it the published formula holds

/** Minutes of arc at an elevation in degrees, with the first two derivatives. */
function saemundsson(h: number): [number, number, number] {
  const reach = h + 5.11;
  const angle = (h + 10.3 / reach) * kDegree;
  const d1 = (1 - 10.3 / (reach * reach)) * kDegree;
  const d2 = ((2 * 10.3) / (reach * reach * reach)) * kDegree;
  const cotangent = 1 / Math.tan(angle);
  const cosecant2 = 1 + cotangent * cotangent;
  return [
    1.02 * cotangent + 0.0019279,
    -1.02 * cosecant2 * d1,
    1.02 * cosecant2 * (2 * cotangent * d1 * d1 - d2),
  ];
}

const kAtJoin = saemundsson(kJoin);

/**
 * By how many radians a body outside of the air seems higher than its true elevation (radians,
 * −π/2 … π/2) tells: about 34.5′ for what seems to stand at the horizon, 1′ at 45°, 0 at 90°. Below
 * −1° it goes on smoothly and fades out.
 */
export function refraction(
  trueElevation: number,
  { temperature = 283, pressure = 101000 }: Air = {},
): number {
  const h = trueElevation / kDegree;
  let minutes: number;
  if (h >= kJoin) {
    minutes = saemundsson(h)[0];
  } else {
    const [a, slope, curvature] = kAtJoin;
    const b = a - slope;
    const c = (curvature + 2 * b - a) / 2;
    const x = kJoin - h;
    minutes = (a + b * x + c * x * x) * Math.exp(-x);
  }
  return (pressure / 101000) * (283 / temperature) * (minutes / 60) * kDegree;
}

/** The unit vector of glTF's space (+y up, north −z, east +x) at a compass bearing, radians. */
export function worldDirection(azimuth: number, elevation: number): [number, number, number] {
  const level = Math.cos(elevation);
  return [level * Math.sin(azimuth), Math.sin(elevation), -level * Math.cos(azimuth)];
}

/** Half the angle (radians) that the Sun's disc covers at a distance in metres. */
export function sunAngularRadius(distance: number): number {
  return Math.asin(kSunRadius / distance);
}

/** What sunlight at a distance in metres is of that at one astronomical unit. */
export function sunIrradianceScale(distance: number): number {
  return (kAstronomicalUnit / distance) ** 2;
}
