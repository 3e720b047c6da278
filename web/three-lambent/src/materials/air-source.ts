// What a shader that looks through the air includes.

import { aerialPerspective } from "../generated/aerialPerspective.js";
import { airBehind } from "../generated/airBehind.js";
import { airMaps } from "../generated/airMaps.js";
import { airTexels } from "../generated/airTexels.js";
import { phaseFunction } from "../generated/phaseFunction.js";
import { shafts } from "../generated/shafts.js";
import { defines, flag } from "./defines.js";
import { kNoAir, type AirMode } from "./surroundings.js";

/**
 * `vec3 seenThroughAir(vec3 away, vec3 sent)` and `vec3 seenBehindAir(vec3 from, vec3 direction, vec3
 * radiance)` where there is air; the defines in any case.
 */
export function airSource(mode: AirMode): string {
  if (mode === "none") return kNoAir;
  const withShafts = mode === "shafts";
  return [
    defines({ AIR: 1, SHAFTS: flag(withShafts) }),
    phaseFunction,
    aerialPerspective,
    withShafts ? shafts : "",
    airMaps,
    airTexels,
    airBehind,
  ].join("\n");
}
