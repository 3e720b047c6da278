// The air before an asset: shade::Air. The eye stands on the ground, wherever it is in the scene.

import {
  Box3,
  Matrix3,
  Matrix4,
  Quaternion,
  Vector2,
  Vector3,
  Vector4,
  type Camera,
  type Object3D,
  type Texture,
} from "three";
import { kAirSize } from "../sky/air_data.js";
import type { QuaternionLike } from "../light/light.js";
import type { AerialPerspective } from "../sky/air.js";
import type { SunMap } from "../gpu/sun-map.js";
import { airSource } from "../materials/air-source.js";
import type { AirMode } from "../materials/surroundings.js";
import { stateOf } from "../materials/uniform-state.js";

export interface AirOptions {
  /** Metres in one unit of the world. Default 1. */
  metresPerUnit?: number;
  /**
   * Shafts of light: what throws a sharp shadow of the Sun ({@link LambentAsset.setSun}) throws it into
   * the air as well. `update` then wants the camera. Default false.
   */
  shafts?: boolean;
  /** worldFromSky: how the sky was turned that this is the air of. */
  rotation?: QuaternionLike;
}

// As shade::Shafts has them: across the view, and between two of them.
const kPlanes = 16;
const kSamples = 4;
const kCornetteShanks = 3; // the place in media::PhaseFunction

/** From a frame whose x is towards the Sun along the horizon, y up. */
function worldFromSun(azimuth: number): Quaternion {
  const half = Math.PI / 4 - azimuth / 2;
  return new Quaternion(0, Math.sin(half), 0, Math.cos(half));
}

export class AssetAir {
  /** Of shaders/aerial_perspective.glsl, air_texels.glsl, air_behind.glsl and shafts.glsl. */
  readonly uniforms = {
    airTable: { value: null as Texture | null },
    airNodes: { value: [kAirSize.azimuths, kAirSize.elevations, kAirSize.distances] as number[] },
    airShell: { value: new Vector4() },
    airScale: { value: 1 },
    towardsSun: { value: new Vector3(0, 1, 0) },
    aerosolPhase: { value: new Vector4() },
    sunFromWorld: { value: new Matrix3() },
    metresPerUnit: { value: 1 },
    airGround: { value: new Vector3() },
    shaftMap: { value: null as Texture | null },
    shaftMapFromWorld: { value: new Matrix4() },
    shaftEye: { value: new Vector3() },
    shaftOrigin: { value: new Vector3() }, // places are counted from the eye
    shaftAxis: { value: new Vector3() },
    shaftDepths: { value: new Vector2() },
    shaftRate: { value: 0 },
    shaftPlanes: { value: [kPlanes, kSamples] },
  };
  /** Without its translation: what a background needs beside them. */
  readonly assetFromWorld = new Matrix3();
  private air: AerialPerspective | null = null;
  private metresPerUnit = 1;
  private wantsShafts = false;
  private readonly worldFromSky = new Quaternion();

  /** @throws RangeError for metres that are none */
  set(air: AerialPerspective | null, options: AirOptions): void {
    const { metresPerUnit = 1, shafts = false, rotation } = options;
    if (!(metresPerUnit > 0 && Number.isFinite(metresPerUnit)))
      throw new RangeError(`three-lambent: ${metresPerUnit} metres in a unit: a number above 0`);
    this.air = air;
    this.metresPerUnit = metresPerUnit;
    this.wantsShafts = shafts;
    if (rotation) this.worldFromSky.set(rotation.x, rotation.y, rotation.z, rotation.w).normalize();
    else this.worldFromSky.identity();
    this.uniforms.airTable.value = air?.texture ?? null;
  }

  get wanted(): boolean {
    return this.air !== null;
  }
  get shafts(): boolean {
    return this.air !== null && this.wantsShafts;
  }

  /** Of fragment shaders. */
  source(mode: AirMode): string {
    return airSource(mode);
  }

  /** Where the asset stands in the air. */
  look(root: Object3D): void {
    const { air, uniforms: u } = this;
    if (!air) return;
    root.matrixWorld.decompose(position, rotation, scale);
    const sunFromWorld = this.worldFromSky.clone().multiply(worldFromSun(air.sunAzimuth)).invert();
    u.sunFromWorld.value.copy(matrixOf(sunFromWorld.multiply(rotation)));
    const size = Math.max(scale.x, scale.y, scale.z);
    this.assetFromWorld.copy(matrixOf(rotation.invert())).multiplyScalar(1 / size);
    u.metresPerUnit.value = this.metresPerUnit * size;
    u.airGround.value.copy(position).negate().applyMatrix3(this.assetFromWorld);
    const { radius, height, asymmetry } = air.table;
    u.airShell.value.set(radius, height, 0, 0);
    u.airScale.value = air.scale;
    u.towardsSun.value.set(Math.cos(air.sunElevation), Math.sin(air.sunElevation), 0);
    u.aerosolPhase.value.set(kCornetteShanks, asymmetry, 0, 0);
  }

  /** Tells all of it that lies before what is seen from anywhere in the asset. */
  get state(): string {
    const { airTable, airShell, airScale, towardsSun, aerosolPhase, ...u } = this.uniforms;
    const air = [airTable, airShell, airScale, towardsSun, aerosolPhase];
    return stateOf([...air, u.sunFromWorld, u.metresPerUnit]);
  }

  /** Shafts of light lie before a camera alone. */
  lookWithoutShafts(): void {
    this.uniforms.shaftDepths.value.set(0, 0);
  }

  /**
   * Planes across the view, from the camera to the end of the asset.
   *
   * @param map of the Sun's shadows, drawn for this camera
   * @throws Error without a camera
   */
  lookForShafts(root: Object3D, camera: Camera | undefined, bounds: Box3, map: SunMap): void {
    if (!this.shafts) return;
    if (!camera)
      throw new Error(
        "three-lambent: shafts of light lie across the view: call update(renderer, camera)",
      );
    camera.updateWorldMatrix(true, false);
    const assetFromCamera = root.matrixWorld.clone().invert().multiply(camera.matrixWorld);
    const eye = new Vector3().setFromMatrixPosition(assetFromCamera);
    const axis = new Vector3(0, 0, -1).transformDirection(assetFromCamera);
    const farthest = new Vector3(
      axis.x > 0 ? bounds.max.x : bounds.min.x,
      axis.y > 0 ? bounds.max.y : bounds.min.y,
      axis.z > 0 ? bounds.max.z : bounds.min.z,
    );
    const u = this.uniforms;
    const end = Math.max(axis.dot(farthest.sub(eye)), 1e-3) * u.metresPerUnit.value;
    u.shaftEye.value.copy(eye);
    u.shaftAxis.value.copy(axis).applyMatrix3(u.sunFromWorld.value);
    u.shaftDepths.value.set(0, end);
    u.shaftMap.value = map.uniforms.sunMap.value;
    u.shaftMapFromWorld.value.copy(map.uniforms.sunMapFromWorld.value);
  }
}

const position = new Vector3();
const rotation = new Quaternion();
const scale = new Vector3();
const matrixOf = (q: Quaternion) =>
  new Matrix3().setFromMatrix4(new Matrix4().makeRotationFromQuaternion(q));
