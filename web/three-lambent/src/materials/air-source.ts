// What a shader that looks through the air includes.

import {
  aerialPerspective,
  airMaps,
  airTexels,
  phaseFunction,
  shafts,
} from "../generated/shaders.js";

export type AirMode = "none" | "air" | "shafts";

/** `vec3 seenThroughAir(vec3 away, vec3 sent)` where there is air; the defines in any case. */
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
  ].join("\n");
}
