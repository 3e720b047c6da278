// What mirrors and the background show.

import type { Texture } from "three";
import { kMostDiscs } from "../generated/constants.js";
import type { Disc, QuaternionLike, Rgb } from "../light/light.js";

export { kMostDiscs };

/** The environment as mirrors and {@link EnvironmentBackground} show it. */
export interface Environment {
  /**
   * Latitude-longitude, in the layout of three's EquirectangularReflectionMapping. Looked up
   * without mipmaps, bilinear, whatever its own filters are. null: no map.
   */
  texture?: Texture | null;
  /** worldFromEnvironment: how the map is turned. The discs stand in the world. */
  rotation?: QuaternionLike;
  /** Times the texture's values. Default 1. */
  intensity?: number;
  /** At most {@link kMostDiscs}. */
  discs?: readonly Disc[];
  /** Radiance from everywhere, beside the rest. */
  uniform?: Rgb;
  /** What is seen above a horizon, however far one looks into it: a sky. */
  sky?: EnvironmentSky | null;
}

/** A sky above a horizon, smooth but for where it ends. */
export interface EnvironmentSky {
  /**
   * Columns as of a latitude-longitude map. Rows as three keeps a texture (no flipY): the last is
   * the zenith, the first the horizon itself, row r of n the elevation
   * horizon + (π/2 − horizon) (r/(n − 1))².
   */
  texture: Texture;
  /** Elevation of the horizon, radians. Default 0. */
  horizon?: number;
  /** worldFromSky: its own frame has +y up. */
  rotation?: QuaternionLike;
}

/** @throws RangeError for more discs than can be shown */
export function checkEnvironment(environment: Environment | null): void {
  const count = environment?.discs?.length ?? 0;
  if (count > kMostDiscs)
    throw new RangeError(`three-lambent: ${count} discs, where ${kMostDiscs} can be shown`);
}
