// What mirrors and the background show, as their shaders are told.

import {
  DataTexture,
  FloatType,
  Matrix3,
  Matrix4,
  NearestFilter,
  Quaternion,
  RGBAFormat,
  Vector3,
  Vector4,
  type IUniform,
  type Texture,
} from "three";
import { environment } from "../generated/environment.js";
import { environmentMap } from "../generated/environmentMap.js";
import type { DirectionLike, QuaternionLike } from "../light/light.js";
import { checkEnvironment, kMostDiscs, type Environment } from "./environment.js";
import { stateOf } from "./uniform-state.js";

/** `vec3 environmentRadiance(vec3 worldDirection)`. */
export const environmentGlsl = environment + environmentMap;

const turnOf = (q: QuaternionLike = { x: 0, y: 0, z: 0, w: 1 }) =>
  new Quaternion(q.x, q.y, q.z, q.w).normalize();
const matrixOf = (q: Quaternion) =>
  new Matrix3().setFromMatrix4(new Matrix4().makeRotationFromQuaternion(q));

/** The uniforms of environmentGlsl, shared by all materials that show one environment. */
export class EnvironmentUniforms {
  private readonly none: DataTexture;
  private readonly copies = new Map<
    "environmentMap" | "environmentSky",
    { texture: Texture; version: number }
  >();
  readonly uniforms;

  constructor() {
    this.none = new DataTexture(new Float32Array(4), 1, 1, RGBAFormat, FloatType);
    this.none.needsUpdate = true;
    this.uniforms = {
      environmentMap: { value: this.none as Texture },
      hasEnvironmentMap: { value: false },
      environmentFromWorld: { value: new Matrix3() },
      environmentIntensity: { value: 1 },
      everywhere: { value: new Vector3() },
      discCount: { value: 0 },
      discs: { value: Array.from({ length: kMostDiscs }, () => new Vector4(0, 0, 1, 0)) },
      discRadiances: { value: Array.from({ length: kMostDiscs }, () => new Vector3()) },
      discDarkenings: { value: Array.from({ length: kMostDiscs }, () => new Vector3()) },
      discHorizons: { value: Array.from({ length: kMostDiscs }, () => new Vector4(0, 0, 0, -1)) },
      environmentSky: { value: this.none as Texture },
      hasEnvironmentSky: { value: false },
      skylightFromEnvironment: { value: new Matrix3() },
      skylightHorizon: { value: new Vector4(0, 1, 0, 0) },
    };
  }

  /** Tells all that is shown. */
  get state(): string {
    return stateOf(Object.values<IUniform>(this.uniforms));
  }

  /** @throws RangeError for more discs than can be shown */
  set(environment: Environment | null): void {
    const { texture = null, intensity = 1, discs = [], uniform } = environment ?? {};
    checkEnvironment(environment);
    const u = this.uniforms;
    this.use("environmentMap", texture);
    u.hasEnvironmentMap.value = texture !== null;
    u.environmentIntensity.value = intensity;
    u.everywhere.value.set(...(uniform ?? ([0, 0, 0] as const)));
    const turned = turnOf(environment?.rotation).invert();
    u.environmentFromWorld.value.copy(matrixOf(turned));
    const inEnvironment = ({ x, y, z }: DirectionLike) =>
      new Vector3(x, y, z).normalize().applyQuaternion(turned);
    const sky = environment?.sky ?? null;
    this.use("environmentSky", sky?.texture ?? null);
    u.hasEnvironmentSky.value = sky !== null;
    if (sky) {
      const worldFromSky = turnOf(sky.rotation);
      const up = new Vector3(0, 1, 0).applyQuaternion(worldFromSky).applyQuaternion(turned);
      u.skylightHorizon.value.set(up.x, up.y, up.z, Math.sin(sky.horizon ?? 0));
      const worldFromEnvironment = turned.clone().invert();
      u.skylightFromEnvironment.value.copy(
        matrixOf(worldFromSky.invert().multiply(worldFromEnvironment)),
      );
    }
    u.discCount.value = discs.length;
    discs.forEach((disc, i) => {
      const axis = inEnvironment(disc.direction);
      const sine = Math.sin(disc.diameter / 4);
      u.discs.value[i].set(axis.x, axis.y, axis.z, 2 * sine * sine);
      u.discRadiances.value[i].set(...disc.radiance);
      u.discDarkenings.value[i].set(...(disc.limbDarkening ?? ([0, 0, 0] as const)));
      if (disc.horizon) {
        const up = inEnvironment(disc.horizon.up);
        u.discHorizons.value[i].set(up.x, up.y, up.z, Math.sin(disc.horizon.elevation));
      } else u.discHorizons.value[i].set(0, 0, 0, -1);
    });
  }

  /**
   * A texture of floats with linear filters is incomplete, and so black, where the device cannot
   * filter floats. Filters do not matter here: the shader takes single texels.
   */
  private use(name: "environmentMap" | "environmentSky", texture: Texture | null): void {
    const copy = this.copies.get(name);
    if (copy && copy.texture.source === texture?.source) {
      if (copy.version !== texture.version) copy.texture.needsUpdate = true;
      copy.version = texture.version;
      this.uniforms[name].value = copy.texture;
      return;
    }
    copy?.texture.dispose();
    this.copies.delete(name);
    let shown = texture ?? this.none;
    if (texture?.type === FloatType && texture.magFilter !== NearestFilter) {
      const made = texture.clone();
      made.minFilter = made.magFilter = NearestFilter;
      made.generateMipmaps = false;
      made.needsUpdate = true;
      this.copies.set(name, { texture: made, version: texture.version });
      shown = made;
    }
    this.uniforms[name].value = shown;
  }

  dispose(): void {
    for (const { texture } of this.copies.values()) texture.dispose();
    this.none.dispose();
  }
}
