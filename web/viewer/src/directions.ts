// Directions as latitude-longitude images and SOURCE have them (lambent/math/directions.h): azimuth
// from +x towards +z, elevation from the horizon up to +y; radians.
import { Vector3 } from "three";

/** A degree. */
export const kRadians = Math.PI / 180;

export function directionFromAzimuthElevation(azimuth: number, elevation: number): Vector3 {
  const cosine = Math.cos(elevation);
  return new Vector3(
    cosine * Math.cos(azimuth),
    Math.sin(elevation),
    cosine * Math.sin(azimuth),
  );
}

/** The inverse, of a direction of any length but 0. */
export function azimuthElevationOf(direction: { x: number; y: number; z: number }): {
  azimuth: number;
  elevation: number;
} {
  const { x, y, z } = direction;
  return { azimuth: Math.atan2(z, x), elevation: Math.atan2(y, Math.hypot(x, z)) };
}
