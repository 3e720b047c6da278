// Twilight for models that know none. As lambent/sky/twilight.cpp.
//
// This work is based on seidelmann1992explanatory: the decimal logarithm of the illuminance on a
// horizontal plane as cubics of the Sun's elevation; their values every 3°, joined monotonically
// (fritsch1980monotone).

const kStep = 3; // degrees

function logIlluminance(degrees: number): number {
  const [l0, l1, l2, l3] =
    degrees >= -0.8
      ? [2.88, 22.26, -207.64, 1034.3]
      : degrees >= -5
        ? [2.88, 21.81, -258.11, -858.36]
        : degrees >= -12
          ? [2.7, 12.17, -431.69, -1899.83]
          : [13.84, 262.72, 1447.42, 2797.93];
  const x = degrees / 90;
  return l0 + x * (l1 + x * (l2 + x * l3));
}

const values = [-18, -15, -12, -9, -6, -3, 0].map((d) => logIlluminance(d) - logIlluminance(0));
const slopes = values.map((value, i) => {
  if (i === 0) return values[1] - value;
  const before = value - values[i - 1];
  if (i === values.length - 1) return before;
  const after = values[i + 1] - value;
  return before > 0 && after > 0 ? (2 * before * after) / (before + after) : 0;
});

/** Light of a clear sky relative to that with the Sun on the horizon, radians ≤ 0; above it 1. */
export function twilightFactor(sunElevation: number): number {
  if (!(sunElevation < 0)) return 1;
  const u = Math.max((sunElevation * 180) / Math.PI / kStep + (values.length - 1), 0);
  const i = Math.min(Math.floor(u), values.length - 2);
  const t = u - i;
  const s = 1 - t;
  return (
    10 **
    (values[i] * s * s * (1 + 2 * t) +
      slopes[i] * t * s * s +
      values[i + 1] * t * t * (1 + 2 * s) -
      slopes[i + 1] * s * t * t)
  );
}
