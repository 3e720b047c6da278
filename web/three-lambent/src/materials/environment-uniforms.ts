// What mirrors and the background show.

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
  type Texture,
} from "three";
import { environment, environmentMap, kMostDiscs } from "../generated/shaders.js";
import type { Disc, QuaternionLike, Rgb } from "../light/light.js";

export { kMostDiscs };

/** `vec3 environmentRadiance(vec3 worldDirection)`. */
export const environmentGlsl = environment + environmentMap;

/** The environment as mirrors and {@link EnvironmentBackground} show it. */
export interface Environment {
  /**
   * Latitude-longitude, in the layout of three's EquirectangularReflectionMapping. Looked up
   * without mipmaps, bilinear, whatever its own filters are. null: no map.
   */
  texture: Texture | null;
  /** worldFromEnvironment: how the map is turned. The discs stand in the world. */
  rotation?: QuaternionLike;
  /** Times the texture's values. Default 1. */
  intensity?: number;
  /** At most {@link kMostDiscs}. */
  discs?: readonly Disc[];
  /** Radiance from everywhere, beside the rest. */
  uniform?: Rgb;
}

/** The uniforms of environmentGlsl, shared by all materials that show one environment. */
export class EnvironmentUniforms {
  private readonly none: DataTexture;
  private copy: Texture | null = null;
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
    };
  }

  /** @throws RangeError for more discs than can be shown */
  set(environment: Environment | null): void {
    const { texture = null, rotation, intensity = 1, discs = [], uniform } = environment ?? {};
    if (discs.length > kMostDiscs)
      throw new RangeError(
        `three-lambent: ${discs.length} discs, where ${kMostDiscs} can be shown`,
      );
    const u = this.uniforms;
    this.use(texture);
    u.hasEnvironmentMap.value = texture !== null;
    u.environmentIntensity.value = intensity;
    u.everywhere.value.set(...(uniform ?? ([0, 0, 0] as const)));
    const q = rotation ?? { x: 0, y: 0, z: 0, w: 1 };
    const turned = new Quaternion(q.x, q.y, q.z, q.w).normalize().invert();
    u.environmentFromWorld.value.setFromMatrix4(new Matrix4().makeRotationFromQuaternion(turned));
    u.discCount.value = discs.length;
    discs.forEach((disc, i) => {
      const { x, y, z } = disc.direction;
      const axis = new Vector3(x, y, z).normalize().applyQuaternion(turned);
      const sine = Math.sin(disc.diameter / 4);
      u.discs.value[i].set(axis.x, axis.y, axis.z, 2 * sine * sine);
      u.discRadiances.value[i].set(...disc.radiance);
    });
  }

  /**
   * A texture of floats with linear filters is incomplete, and so black, where the device cannot
   * filter floats. Filters do not matter here: the shader takes single texels.
   */
  private use(texture: Texture | null): void {
    if (this.copy?.source === texture?.source && this.copy) {
      this.uniforms.environmentMap.value = this.copy;
      return;
    }
    this.copy?.dispose();
    this.copy = null;
    let shown = texture ?? this.none;
    if (texture?.type === FloatType && texture.magFilter !== NearestFilter) {
      this.copy = texture.clone();
      this.copy.minFilter = this.copy.magFilter = NearestFilter;
      this.copy.generateMipmaps = false;
      this.copy.needsUpdate = true;
      shown = this.copy;
    }
    this.uniforms.environmentMap.value = shown;
  }

  dispose(): void {
    this.copy?.dispose();
    this.none.dispose();
  }
}
