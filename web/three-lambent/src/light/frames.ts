// Frames about a direction: lambent/math/directions.h.

export type Vector = readonly [number, number, number];

/**
 * Two unit vectors that make a right-handed frame with the unit vector `axis`, which is its third
 * (duff2017building).
 */
export function worldFromTangent(axis: Vector): [Vector, Vector] {
  const [x, y, z] = axis;
  const sign = z < 0 || Object.is(z, -0) ? -1 : 1;
  const a = -1 / (sign + z);
  const b = x * y * a;
  return [
    [1 + sign * x * x * a, sign * b, -sign * x],
    [b, sign + y * y * a, -y],
  ];
}
