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

/** The same with channels below 0 made 0: what is shown. */
export function shownRgb(x: number, y: number, z: number): Triple {
  return rgbOfXyz(x, y, z).map((value) => Math.max(0, value)) as Triple;
}
