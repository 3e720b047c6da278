// Colours of a file that states its primaries → linear Rec. 709, as lambent/radiometry/primaries.cpp has it.

/** CIE 1931 x, y, as three's EXRLoader names them. */
export interface Chromaticities {
  redX: number;
  redY: number;
  greenX: number;
  greenY: number;
  blueX: number;
  blueY: number;
  whiteX: number;
  whiteY: number;
}

type Matrix = [number, number, number, number, number, number, number, number, number];

const kRec709: Chromaticities = {
  redX: 0.64,
  redY: 0.33,
  greenX: 0.3,
  greenY: 0.6,
  blueX: 0.15,
  blueY: 0.06,
  whiteX: 0.3127,
  whiteY: 0.329,
};
const kXyz: Chromaticities = {
  redX: 1,
  redY: 0,
  greenX: 0,
  greenY: 1,
  blueX: 0,
  blueY: 0,
  whiteX: 1 / 3,
  whiteY: 1 / 3,
};
/** Bradford's cones from X, Y, Z. */
const kCones: Matrix = [
  0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296,
];

function times(a: Matrix, b: Matrix): Matrix {
  const c = new Array<number>(9).fill(0);
  for (let i = 0; i < 3; ++i)
    for (let j = 0; j < 3; ++j)
      for (let k = 0; k < 3; ++k) c[3 * i + j]! += a[3 * i + k]! * b[3 * k + j]!;
  return c as Matrix;
}

function apply(m: Matrix, x: number, y: number, z: number): [number, number, number] {
  return [
    m[0] * x + m[1] * y + m[2] * z,
    m[3] * x + m[4] * y + m[5] * z,
    m[6] * x + m[7] * y + m[8] * z,
  ];
}

function inverse(m: Matrix): Matrix {
  const [a, b, c, d, e, f, g, h, i] = m;
  const cofactors = [
    e * i - f * h,
    c * h - b * i,
    b * f - c * e,
    f * g - d * i,
    a * i - c * g,
    c * d - a * f,
    d * h - e * g,
    b * g - a * h,
    a * e - b * d,
  ];
  const determinant = a * cofactors[0]! + b * cofactors[3]! + c * cofactors[6]!;
  return cofactors.map((value) => value / determinant) as Matrix;
}

function diagonal(x: number, y: number, z: number): Matrix {
  return [x, 0, 0, 0, y, 0, 0, 0, z];
}

function whiteOf(c: Chromaticities): [number, number, number] {
  return [c.whiteX / c.whiteY, 1, (1 - c.whiteX - c.whiteY) / c.whiteY];
}

function xyzFrom(c: Chromaticities): Matrix {
  const primaries: Matrix = [
    c.redX,
    c.greenX,
    c.blueX,
    c.redY,
    c.greenY,
    c.blueY,
    1 - c.redX - c.redY,
    1 - c.greenX - c.greenY,
    1 - c.blueX - c.blueY,
  ];
  return times(primaries, diagonal(...apply(inverse(primaries), ...whiteOf(c))));
}

function isNear(a: Chromaticities, b: Chromaticities): boolean {
  const names = Object.keys(kRec709) as (keyof Chromaticities)[];
  return names.every((name) => Math.abs(a[name] - b[name]) <= 2e-4);
}

/** Four floats a pixel, in place. Nothing happens to Rec. 709 and to primaries that span no triangle. */
export function toRec709(stated: Chromaticities, data: Float32Array): void {
  if (isNear(stated, kRec709)) return;
  let matrix = times(inverse(xyzFrom(kRec709)), xyzFrom(stated));
  if (!isNear(stated, kXyz)) {
    const from = apply(kCones, ...whiteOf(stated));
    const to = apply(kCones, ...whiteOf(kRec709));
    const cones = diagonal(to[0] / from[0], to[1] / from[1], to[2] / from[2]);
    const adapted = times(times(inverse(kCones), cones), kCones);
    matrix = times(times(inverse(xyzFrom(kRec709)), adapted), xyzFrom(stated));
  }
  if (!matrix.every(Number.isFinite)) return;
  for (let i = 0; i < data.length; i += 4) {
    const colour = apply(matrix, data[i]!, data[i + 1]!, data[i + 2]!);
    // A channel that is not finite is mended by itself, later.
    if (colour.every(Number.isFinite)) data.set(colour, i);
  }
}
