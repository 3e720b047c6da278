// What a shader that looks through the air includes.

import { aerialPerspective } from "../generated/aerialPerspective.js";
import { airBehind } from "../generated/airBehind.js";
import { airMaps } from "../generated/airMaps.js";
import { airTexels } from "../generated/airTexels.js";
import { phaseFunction } from "../generated/phaseFunction.js";
import { shafts } from "../generated/shafts.js";
import { defines, flag } from "./defines.js";

/**
 * `vec3 seenThroughAir(vec3 away, vec3 sent)` and `vec3 seenBehindAir(vec3 from, vec3 direction, vec3
 * radiance)`.
 */
export function airSource(withShafts: boolean): string {
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
