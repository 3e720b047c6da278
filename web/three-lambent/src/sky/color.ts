// From X, Y, Z to radiance in linear Rec. 709 channels, as lambent/radiometry/xyzv.cpp.

type Triple = [number, number, number];

const kPhotopicEfficacy = 683.002; // lm/W

/** Row after row: X, Y, Z in cd m⁻² → W m⁻² sr⁻¹ of luminous equivalent. */
const rgbFromXyz: readonly number[] = (() => {
  const primaries = [
    [0.64, 0.33, 0.2126],
    [0.3, 0.6, 0.7152],
    [0.15, 0.06, 0.0722],
  ].map(([x, y, luminance]) => [
    (luminance * x) / y,
    luminance,
    (luminance * (1 - x - y)) / y,
  ]);
  const [a, b, c] = primaries;
  const cross = (u: number[], v: number[]) => [
    u[1] * v[2] - u[2] * v[1],
    u[2] * v[0] - u[0] * v[2],
    u[0] * v[1] - u[1] * v[0],
  ];
  const rows = [cross(b, c), cross(c, a), cross(a, b)];
  const determinant = a[0] * rows[0][0] + a[1] * rows[0][1] + a[2] * rows[0][2];
  return rows.flat().map((value) => value / determinant / kPhotopicEfficacy);
})();

/** May be below 0, for colours out of the gamut. */
export function rgbOfXyz(x: number, y: number, z: number, out: number[] | Triple = [0, 0, 0]): Triple {
  for (let c = 0; c < 3; ++c)
    out[c] = rgbFromXyz[3 * c] * x + rgbFromXyz[3 * c + 1] * y + rgbFromXyz[3 * c + 2] * z;
  return out as Triple;
}

/**
 * What is shown: a colour out of the gamut moves towards the grey of its luminance until no channel is
 * below 0, in place. As lambent/sky/sight.cpp.
 */
export function withinGamut(rgb: Triple): Triple {
  const least = Math.min(rgb[0], rgb[1], rgb[2]);
  if (!(least < 0)) return rgb;
  const grey = Math.max(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2], 0);
  const share = grey / (grey - least);
  for (let c = 0; c < 3; ++c) rgb[c] = Math.max(0, grey + share * (rgb[c] - grey));
  return rgb;
}

/** {@link rgbOfXyz} within the gamut. */
export function shownRgb(x: number, y: number, z: number): Triple {
  return withinGamut(rgbOfXyz(x, y, z));
}
