// Whether what a program calls a light is one that relights.

import type { LambentLight } from "./light.js";

function remedy(name: string, given: Record<string, unknown>): string {
  if (given.isLightProbe) return "use LambentLight.fromLightProbe(probe)";
  if (given.isTexture) return "use LambentLight.fromEquirectangular(map, asset.info.bands)";
  if (given.isAmbientLight) return "use LambentLight.uniform([r, g, b])";
  if (given.isLight)
    return (
      "three's lights do not relight it. Use new LambentLight().addDisc({ direction, diameter, " +
      "radiance }), with a direction away from the scene"
    );
  if (name === "Sky") return "use new LambentLight(asset.info.bands).setSky(sky)";
  return "make one by new LambentLight(), LambentLight.fromEquirectangular(map), …";
}

/** @throws TypeError for what is neither a LambentLight nor null */
export function checkLight(light: LambentLight | null): LambentLight | null {
  if (light === null) return light;
  const given = light as unknown;
  const of = (typeof given === "object" ? given : {}) as Record<string, unknown>;
  // Not by its class: a page may have the package twice.
  if (of.coefficients instanceof Float64Array && typeof of.version === "number") return light;
  const name =
    typeof given === "object" ? (given as object).constructor?.name || "object" : String(given);
  throw new TypeError(
    `three-lambent: setLight() takes a LambentLight or null, not ${name}: ${remedy(name, of)}`,
  );
}
