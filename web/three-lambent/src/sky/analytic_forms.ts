// What analytic skies have in common: gradation and indicatrix, angles, sums over the dome. As
// lambent/sky/standard_skies.h and dome_quadrature.h.

import { gaussLegendre } from "../sh/quadrature.js";

export type Triple = [number, number, number];

/** X, Y, Z in cd m⁻² by cosine of the zenith angle and angle from the Sun (radians). */
export type Luminous = (cosZenith: number, sunAngle: number) => Triple;

export const clamp = (x: number, low: number, high: number): number =>
  Math.min(Math.max(x, low), high);

export interface Shape {
  /** Towards the horizon. */
  a: number;
  b: number;
  /** About the Sun. */
  c: number;
  d: number;
  e: number;
  k: number;
}

const gradation = ({ a, b }: Shape, cosZenith: number) =>
  Math.max(1 + a * Math.exp(b / Math.max(cosZenith, 0.01)), 0);
const indicatrix = ({ c, d, e, k }: Shape, angle: number) =>
  Math.max(k + c * Math.exp(d * angle) + e * Math.cos(angle) ** 2, 0);
export const shapeAt = (shape: Shape, cosZenith: number, angle: number): number =>
  gradation(shape, cosZenith) * indicatrix(shape, angle);

/** Relative optical air mass, kasten1965new. */
export function airMass(elevation: number): number {
  const degrees = (elevation * 180) / Math.PI;
  return 1 / (Math.sin(elevation) + 0.15 * (degrees + 3.885) ** -1.253);
}

/** Daylight of 6500 K. */
export const white = (luminance: number): Triple => {
  const [x, y] = [0.3127, 0.329];
  return [(luminance * x) / y, luminance, (luminance * (1 - x - y)) / y];
};

/** Directions over the dome with their projected solid angles. */
export function forDome(
  nodes: number,
  sun: number,
  add: (cosZenith: number, sunAngle: number, weight: number) => void,
): void {
  const sines = gaussLegendre(nodes, 0, 1);
  const turns = gaussLegendre(nodes, 0, Math.PI);
  for (let i = 0; i < nodes; ++i)
    for (let j = 0; j < nodes; ++j) {
      const y = sines.nodes[i];
      const x = Math.sqrt(1 - y * y) * Math.cos(turns.nodes[j]);
      const z = Math.sqrt(1 - y * y) * Math.sin(turns.nodes[j]);
      add(y, angleFromSun(x, y, z, sun), 2 * sines.weights[i] * turns.weights[j] * y);
    }
}

export function angleFromSun(x: number, y: number, z: number, sun: number): number {
  const chord = Math.hypot(x - Math.cos(sun), y - Math.sin(sun), z);
  return 2 * Math.asin(Math.min(chord / 2, 1));
}
