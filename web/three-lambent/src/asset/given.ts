// What somebody gave an asset to be seen under, and how clones follow that.

import type { Disc, LambentLight } from "../light/light.js";
import type { Environment } from "../materials/environment.js";
import type { AerialPerspective } from "../sky/air.js";
import type { AirOptions } from "./asset-air.js";
import type { LambentAsset } from "./asset.js";

/** undefined: nobody said. */
export interface Given {
  light?: LambentLight | null;
  environment?: Environment | null;
  sun?: { disc: Disc | null; weights: ArrayLike<number> };
  air?: { air: AerialPerspective | null; options: AirOptions };
}

const kSettings = [
  "transfer",
  "macro",
  "viewDependent",
  "filter",
  "lobeExponent",
  "softLobes",
  "mirrorSize",
  "seams",
  "unlit",
  "samples",
  "sample",
] as const;

/** What one asset last took from another. */
export interface Followed {
  settings: Record<string, unknown>;
  given: Given;
}

export function stateOfAsset(asset: LambentAsset): Followed {
  const settings = Object.fromEntries(kSettings.map((name) => [name, asset[name]]));
  return { settings, given: { ...asset.given } };
}

/**
 * Gives one asset what another has, but for what differs from what it last took: that is its own.
 *
 * @param followed what it last took; null: nothing is its own
 * @returns what it has taken now
 */
export function takeFrom(
  to: LambentAsset,
  from: LambentAsset,
  followed: Followed | null,
): Followed {
  const { settings, given: had } = followed ?? stateOfAsset(to);
  for (const name of kSettings)
    if (to[name] === settings[name]) Object.assign(to, { [name]: from[name] });
  const { given } = to;
  const { light, environment, sun, air } = from.given;
  const isDue = (name: keyof Given) =>
    from.given[name] !== undefined && given[name] === had[name] && given[name] !== from.given[name];
  if (isDue("light")) to.setLight(light!);
  if (isDue("environment")) to.setEnvironment(environment!);
  // Held as the same things, not as others like them.
  if (isDue("sun")) {
    to.setSun(sun!.disc, sun!.weights);
    given.sun = sun;
  }
  if (isDue("air")) {
    to.setAir(air!.air, air!.options);
    given.air = air;
  }
  return stateOfAsset(from);
}
