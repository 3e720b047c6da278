// A disc as harmonics: plain, darker towards its limb, cut by a horizon. As lambent/light/disc.cpp,
// whose legend holds here.

import { coefficientCount, evaluateHarmonics } from "../sh/basis.js";
import { gaussLegendre } from "../sh/quadrature.js";
import { capMoments, turnZonal } from "../sh/zonal.js";
import type { Disc } from "./light.js";

type Vector = readonly [number, number, number];

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sum = (a: Vector, b: Vector, share: number): Vector => [
  a[0] + share * b[0],
  a[1] + share * b[1],
  a[2] + share * b[2],
];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

function unit({ x, y, z }: { x: number; y: number; z: number }): Vector {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

const clampToOne = (x: number) => Math.max(-1, Math.min(1, x));

/** Moments of μ over the disc. */
function limbMoments(bands: number, versine: number): Float64Array {
  const moments = new Float64Array(bands);
  const { nodes, weights } = gaussLegendre(bands + 1, 0, 1);
  for (let i = 0; i < nodes.length; ++i) {
    const mu = nodes[i];
    const x = 1 - versine * (1 - mu * mu);
    const value = 4 * Math.PI * versine * mu * mu * weights[i];
    let [previous, p] = [0, 1];
    for (let l = 0; l < bands; ++l) {
      moments[l] += value * p;
      [previous, p] = [p, ((2 * l + 1) * x * p - l * previous) / (l + 1)];
    }
  }
  return moments;
}

/** What stands above the horizon of a disc that the horizon cuts: calls `add` for parts of it. */
function forNodesAbove(
  axis: Vector,
  half: number,
  up: Vector,
  horizon: number,
  add: (direction: Vector, area: number, mu: number) => void,
): void {
  const kSteps = 8;
  const center = Math.asin(clampToOne(dot(axis, up)));
  const axisRho = Math.cos(center);
  const versine = 2 * Math.sin(half / 2) ** 2;
  if (horizon >= center + half || !(axisRho > 0)) return;
  const level = sum(axis, up, -Math.sin(center));
  const ahead = unit({ x: level[0], y: level[1], z: level[2] });
  const aside = cross(up, ahead);
  const psis = gaussLegendre(kSteps, Math.asin(clampToOne((horizon - center) / half)), Math.PI / 2);
  const chis = gaussLegendre(kSteps, -Math.PI / 2, Math.PI / 2);
  for (let j = 0; j < kSteps; ++j) {
    const e = center + half * Math.sin(psis.nodes[j]);
    const rho = Math.cos(e);
    const inside = (2 * versine - (2 * Math.sin((e - center) / 2)) ** 2) / (4 * rho * axisRho);
    if (!(inside > 0)) continue;
    const phiMax = 2 * Math.asin(Math.sqrt(Math.min(inside, 1)));
    for (let i = 0; i < kSteps; ++i) {
      const phi = phiMax * Math.sin(chis.nodes[i]);
      const mu2 =
        (2 * rho * axisRho * Math.sin((phiMax - phi) / 2) * Math.sin((phiMax + phi) / 2)) / versine;
      const level = sum([0, 0, 0], ahead, rho * Math.cos(phi));
      add(
        sum(sum(level, aside, rho * Math.sin(phi)), up, Math.sin(e)),
        psis.weights[j] *
          half *
          Math.cos(psis.nodes[j]) *
          rho *
          chis.weights[i] *
          phiMax *
          Math.cos(chis.nodes[i]),
        Math.sqrt(Math.max(0, Math.min(1, mu2))),
      );
    }
  }
}

/** Adds a disc to coefficients, [coefficient][3]. Its direction is of some length. */
export function addDisc(coefficients: Float64Array, bands: number, disc: Disc): void {
  const axis = unit(disc.direction);
  const half = Math.min(disc.diameter / 2, Math.PI);
  const dark = disc.limbDarkening ?? ([0, 0, 0] as const);
  const addZonal = (moments: Float64Array, towards: Vector, share: (c: number) => number) => {
    const zonal = turnZonal(moments, ...towards);
    for (let i = 0; i < zonal.length; ++i)
      for (let c = 0; c < 3; ++c)
        coefficients[3 * i + c] += zonal[i] * share(c) * disc.radiance[c];
  };
  if (disc.horizon) {
    const up = unit(disc.horizon.up);
    const { elevation } = disc.horizon;
    if (half >= Math.PI) {
      addZonal(capMoments(bands, Math.PI / 2 - elevation), up, () => 1);
      return;
    }
    if (Math.asin(clampToOne(dot(axis, up))) - half < elevation) {
      forNodesAbove(axis, half, up, elevation, (s, area, mu) => {
        const y = evaluateHarmonics(bands, ...s);
        for (let i = 0; i < coefficientCount(bands); ++i)
          for (let c = 0; c < 3; ++c)
            coefficients[3 * i + c] += y[i] * area * disc.radiance[c] * (1 - dark[c] * (1 - mu));
      });
      return;
    }
  }
  addZonal(capMoments(bands, half), axis, (c) => 1 - dark[c]);
  if (dark.some((u) => u > 0))
    addZonal(limbMoments(bands, 2 * Math.sin(half / 2) ** 2), axis, (c) => dark[c]);
}
