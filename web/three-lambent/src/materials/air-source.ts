// What a shader that looks through the air includes.

import {
  aerialPerspective,
  airBehind,
  airMaps,
  airTexels,
  phaseFunction,
  shafts,
} from "../generated/shaders.js";

export type AirMode = "none" | "air" | "shafts";

/**
 * `vec3 seenThroughAir(vec3 away, vec3 sent)` and `vec3 seenBehindAir(vec3 from, vec3 direction, vec3
 * radiance)` where there is air; the defines in any case.
 */
export function airSource(mode: AirMode): string {
  const defines =
    `#define LAMBENT_AIR ${mode === "none" ? 0 : 1}\n` +
    `#define LAMBENT_SHAFTS ${mode === "shafts" ? 1 : 0}\n`;
  if (mode === "none") return defines;
  return [
    defines,
    phaseFunction,
    aerialPerspective,
    mode === "shafts" ? shafts : "",
    airMaps,
    airTexels,
    airBehind,
  ].join("\n");
}
