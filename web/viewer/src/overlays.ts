// What can be shown over a surface with meso-structure of how its patch lies. Not part of a view.
import type { Object3D } from "three";
import type { LambentAsset } from "three-lambent";

export const kOverlays = ["field", "singularities", "seams", "cuts"] as const;
export type Overlay = (typeof kOverlays)[number];
export type Overlays = Readonly<Record<Overlay, boolean>>;
export const kNoOverlays: Overlays =
  { field: false, singularities: false, seams: false, cuts: false };
export const anyOf = (overlays: Overlays): boolean => kOverlays.some((each) => overlays[each]);

/** Radiance of the lines that show seams, where a picture is exposed by 0 EV. */
export const kSeamColor = [1.2, 0.05, 0.7] as const;

/** What is drawn of them besides seams, in the scene that the asset stands in. */
export interface Marks {
  readonly object: Object3D;
  /** After the asset's update(). `brightness`: the radiance that the picture shows as 1. */
  show(shown: Overlays, brightness: number, width: number, height: number): void;
  dispose(): void;
}
export type MakeMarks = (asset: LambentAsset) => Marks;
