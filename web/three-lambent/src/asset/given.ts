// What somebody gave an asset to be seen under; undefined: nobody said.

import type { Disc, LambentLight } from "../light/light.js";
import type { Environment } from "../materials/environment-uniforms.js";
import type { AerialPerspective } from "../sky/air.js";
import type { AirOptions } from "./asset-air.js";

export interface Given {
  light?: LambentLight | null;
  environment?: Environment | null;
  sun?: { disc: Disc | null; weights: ArrayLike<number> };
  air?: { air: AerialPerspective | null; options: AirOptions };
}
