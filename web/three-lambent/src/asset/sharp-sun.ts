// Sharp shadows of the Sun over low-frequency transfer: lambent/shade/sharp_sun.h. With M the transfer
// that is shown, D what it is without bounces, L the light and S the Sun's part of it, a diffuse
// surface sends out M L − D S and what falls on it from the disc itself.

import { Matrix4, Quaternion, Vector3, type Camera, type Object3D, type WebGLRenderer } from "three";
import type { AssetDescription, PrimitiveTransfer, TransferKind } from "../format/description.js";
import { ordinaryProjection } from "../gpu/depth.js";
import { SunMap } from "../gpu/sun-map.js";
import { LambentLight, type Disc } from "../light/light.js";
import { kLargestSun, sunOf, sunPoints, type SunPoint } from "../light/sun.js";
import { stateOf } from "../materials/uniform-state.js";
import { kindOf, type TransferChoice } from "./choices.js";
import type { MeshSource } from "./mesh-source.js";
import type { RelitMesh } from "./relit-mesh.js";

/**
 * The kind of D of a bare surface with a diffuse part; null: it holds direct light and bounces as
 * one, or has no diffuse part, and shows the Sun as the harmonics have it.
 */
export function kindWithoutBounces(
  asset: AssetDescription,
  mesh: PrimitiveTransfer,
  choice: TransferChoice,
): TransferKind | null {
  if (mesh.biScale || !mesh.vectors) return null;
  const shown = kindOf(asset, mesh, choice);
  if (shown !== "interreflected") return shown;
  return mesh.shadowed?.vectors ? "shadowed" : null;
}

/** What of an asset a sharp Sun does not reach, in words; nothing: all of it is reached. */
export function sunNotes(
  description: AssetDescription,
  meshes: readonly RelitMesh[],
  choice: TransferChoice,
): string[] {
  let [together, soft, mirrors] = [0, 0, 0];
  for (const { transfer, isMirror } of meshes) {
    if (isMirror) ++mirrors;
    else if (transfer?.biScale || transfer?.matrices) ++soft;
    if (transfer?.vectors && !kindWithoutBounces(description, transfer, choice)) ++together;
  }
  const notes: string[] = [];
  if (together)
    notes.push(
      "The Sun's shadow stays soft: the asset holds its direct light and its bounces as one. Bake " +
        "it with --keep-shadowed.",
    );
  if (mirrors)
    notes.push("Under a sharp Sun its light does not reach surfaces by way of mirrors.");
  if (soft)
    notes.push(
      "Glossy surfaces and meso-structure show the Sun as the harmonics of the light have it.",
    );
  return notes;
}

/** The Sun of one asset: which it is, where it is seen from, and the map of what hides it. */
export class SharpSun {
  readonly map: SunMap;
  /** Of src/glsl/sun_light.glsl and shaders/sun_shadow.glsl. */
  readonly uniforms;
  private disc: Disc | null = null;
  private weights: readonly number[] = [];
  private points: SunPoint[] = [];

  constructor(meshes: readonly MeshSource[]) {
    this.map = new SunMap(meshes);
    this.uniforms = {
      sunDirection: { value: new Vector3(0, 1, 0) },
      sunIrradiance: { value: new Vector3() },
      ...this.map.uniforms,
    };
  }

  get shines(): boolean {
    return this.disc !== null;
  }

  /** Tells how it shines; "" without it. */
  get state(): string {
    const { sunDirection, sunIrradiance } = this.uniforms;
    return this.disc ? stateOf([sunDirection, sunIrradiance]) : "";
  }

  /** @throws RangeError for a disc that is no Sun */
  set(disc: Disc | null, weights: ArrayLike<number>): void {
    if (disc && disc.diameter > kLargestSun * (1 + 1e-6))
      throw new RangeError(
        `three-lambent: a Sun of ${disc.diameter} radians: its shadows are sharp up to 5° of ` +
          "diameter; larger discs are light for addDisc() alone",
      );
    this.disc = disc && sunOf([disc]);
    this.weights = Array.from(weights);
    this.points = [];
  }

  /** The Sun's share of light in so many bands, in the world. */
  share(bands: number): LambentLight {
    const light = new LambentLight(bands);
    if (!this.disc) return light;
    light.addDisc(this.disc);
    return this.weights.length ? light.attenuate(this.weights) : light;
  }

  /**
   * Towards this picture's point of the disc.
   *
   * @param sample which of `samples` pictures that are added up
   */
  aim(root: Object3D, sample: number, samples: number): void {
    if (!this.disc) return;
    const count = Math.max(1, Math.floor(samples));
    if (this.points.length !== count) this.points = sunPoints(this.disc, count);
    const { direction, irradiance } = this.points[sample % count];
    root.matrixWorld.decompose(position, rotation, scale);
    const { sunDirection, sunIrradiance } = this.uniforms;
    sunDirection.value.set(...direction).applyQuaternion(rotation.invert());
    sunIrradiance.value.set(...irradiance);
  }

  /** The map of what hides that point from what a camera sees; without a camera from all of it. */
  drawMap(renderer: WebGLRenderer, root: Object3D, camera: Camera | undefined): void {
    if (!this.disc) return;
    let clipFromAsset: Matrix4 | null = null;
    if (camera) {
      camera.updateWorldMatrix(true, false);
      clipFromAsset = camera.matrixWorld
        .clone()
        .invert()
        .multiply(root.matrixWorld)
        .premultiply(ordinaryProjection(camera));
    }
    const { x, y, z } = this.uniforms.sunDirection.value;
    this.map.draw(renderer, [x, y, z], clipFromAsset);
  }
}

const position = new Vector3();
const rotation = new Quaternion();
const scale = new Vector3();
