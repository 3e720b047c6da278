// Glossy lobes as they are shown: of the material's moments, softened where lobes are, and with the
// gain of what is softened. As lambent/shade/lobe.h, which tells why.
//
// This work is based on:
// - sloan2002precomputed: eq. 12.

import { leastSofteningOfZonal } from "./window.js";
import { capMoments, legendre, phongLobeMoments } from "./zonal.js";

/** E(μ) of Phong's lobe: the shares of circles about R, of which each stands for as much of the lobe. */
function shareOfPhong(exponent: number, mu: number): number {
  const circles = 1000;
  let sum = 0;
  for (let i = 0; i < circles; ++i) {
    const z = ((i + 0.5) / circles) ** (1 / (exponent + 1));
    const across = Math.sqrt((1 - z * z) * (1 - mu * mu));
    sum += across > 0 ? Math.acos(Math.min(Math.max((-z * mu) / across, -1), 1)) / Math.PI : 1;
  }
  return sum / circles;
}

/** E_soft(μ): what a lobe of these moments shows of an even light of radiance 1 above a horizon. */
function shareAboveHorizon(lobe: Float64Array, mu: number): number {
  const horizon = capMoments(lobe.length, Math.PI / 2);
  const p = legendre(lobe.length, mu);
  const sum = lobe.reduce((all, each, l) => all + (2 * l + 1) * each * horizon[l] * p[l], 0);
  return sum / (4 * Math.PI);
}

export interface ShownLobe {
  /** By bands. */
  moments: Float64Array;
  /** 1 + Σ_k gain[k] μ^(k+1), μ = max(N·R, 0), is what it is multiplied by. */
  gain: [number, number, number, number];
}

/** @param horizon whether what reaches the lobe has one: matrices of all kinds but unshadowed */
export function shownLobe(
  bands: number,
  exponent: number,
  { soft, horizon }: { soft: boolean; horizon: boolean },
): ShownLobe {
  const plain = phongLobeMoments(bands, exponent);
  if (!soft) return { moments: plain, gain: [0, 0, 0, 0] };
  const window = leastSofteningOfZonal(plain);
  const moments = plain.map((moment, l) => moment * window[l]);
  if (!horizon || window[bands - 1] === 1) return { moments, gain: [0, 0, 0, 0] };
  const material = Math.min(exponent, 3 * bands);

  // Newton's form of the polynomial through (E(μ)/E_soft(μ) − 1)/μ, then multiplied out.
  const nodes = [0, 1, 2, 3].map((i) => 0.5 + 0.5 * Math.cos((2 * Math.PI * i) / 7));
  const values = nodes.map(
    (mu) => (shareOfPhong(material, mu) / shareAboveHorizon(moments, mu) - 1) / mu,
  );
  for (let order = 1; order < 4; ++order)
    for (let i = 3; i >= order; --i)
      values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - order]);
  const gain: ShownLobe["gain"] = [0, 0, 0, 0];
  for (let i = 3; i >= 0; --i) {
    for (let k = 3; k > 0; --k) gain[k] = gain[k - 1] - nodes[i] * gain[k];
    gain[0] = values[i] - nodes[i] * gain[0];
  }
  return { moments, gain };
}
