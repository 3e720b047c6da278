// The typed API. (Bodies follow, module by module.)
import type {
  Camera, DataTexture, LightProbe, Material, Mesh, Object3D, Quaternion, Texture, Vector3,
  WebGLRenderer, WebGLRenderTarget, PerspectiveCamera,
} from "three";
import type { GLTFParser, GLTF } from "three/addons/loaders/GLTFLoader.js";

/** Which part of the simulated transport relights. */
export type TransferChoice = "best" | "unshadowed" | "shadowed" | "interreflected";
export type AssetKind = "diffuse" | "glossy" | "texels" | "mirror" | "bi-scale";
export type WindowSpec = "none" | "minimal" | `hann:${number}` | `lanczos:${number}`;
export type ToneCurve = "filmic" | "linear";

export interface Disc {
  /** Unit vector towards the disc, away from the scene. */
  direction: Vector3;
  /** Angular diameter, radians. */
  diameter: number;
  /** Linear radiance, [r, g, b]. */
  radiance: [number, number, number];
}

/** Pixels of a map in latitude and longitude. */
export interface EquirectangularImage {
  data: Float32Array | Uint16Array | Uint8Array | Uint8ClampedArray;
  width: number;
  height: number;
  /** Numbers of a pixel, of which the first three are R, G, B. */
  channels: 3 | 4;
  /** "float32", "float16" (bit patterns), or "srgb8". */
  encoding: "float32" | "float16" | "srgb8";
  /** Whether row 0 is the zenith's. */
  topRowFirst: boolean;
}

export interface AssetInfo {
  version: string; generator: string; transfer: string; bands: number; directions: number;
  bounces: number; vertices: number; triangles: number; receivers: number; transferBytes: number;
}

/** Light as spherical harmonics. Immutable in its parts; each method that changes it returns this. */
export declare class LambentLight {
  readonly bands: number;
  /** Grows with every change. */
  readonly version: number;
  constructor(bands?: number); // black; default 5
  /** [coefficient][r, g, b], bands² rows. */
  static fromCoefficients(coefficients: ArrayLike<ArrayLike<number>> | Float32Array): LambentLight;
  /** LIGHT.json as `lambent light` writes it. */
  static fromJson(json: unknown): LambentLight;
  static fromLightProbe(probe: LightProbe): LambentLight;
  static fromEquirectangular(map: Texture | EquirectangularImage, bands?: number): LambentLight;
  static uniform(radiance: [number, number, number], bands?: number): LambentLight;
  addDisc(disc: Disc): this;
  add(other: LambentLight): this;
  scale(factor: number): this;
  copy(other: LambentLight): this;
  clone(): LambentLight;
  /** Turns what is there now: what stood in direction s stands in q·s. */
  rotate(q: Quaternion): this;
  /** Against ringing: "hann:W", "lanczos:W", "minimal", "none". In place. */
  window(spec: WindowSpec): this;
  /** [coefficient][3] */
  readonly coefficients: Float64Array;
  /** Radiance that the harmonics give in a direction. */
  radiance(direction: Vector3): [number, number, number];
}

export declare class LambentLoaderPlugin {
  readonly name: "LAMBENT_radiance_transfer";
  constructor(parser: GLTFParser, options?: { incident?: "auto" | "varyings" | "fetch" });
  beforeRoot(): Promise<void> | null;
  afterRoot(gltf: GLTF): Promise<void> | null;
}

export interface Environment {
  /** Latitude-longitude, as three's EquirectangularReflectionMapping; null: none. */
  texture: Texture | null;
  /** worldFromEnvironment of the texture. */
  rotation?: Quaternion;
  /** Times the texture's values. */
  intensity?: number;
  /** Seen beside the texture, in the world. At most 8. */
  discs?: readonly Disc[];
  /** Radiance everywhere, beside the rest. */
  uniform?: [number, number, number];
}

export declare class LambentAsset {
  static of(object: Object3D): LambentAsset | undefined; // also at gltf.userData.lambent
  readonly root: Object3D;
  readonly meshes: readonly Mesh[];
  readonly info: AssetInfo;
  readonly kinds: ReadonlySet<AssetKind>;
  /** "best" to begin with. What an asset does not hold gives the nearest below that it does. */
  transfer: TransferChoice;
  macro: boolean; // default true; off: meso-structure takes the light as nothing hid it
  viewDependent: boolean; // default true
  filter: boolean; // default true
  lobeExponent: number | null; // default null: the materials'
  unlit: boolean; // default false: the base colour alone
  samples: number; // sub-samples of a pixel that the caller will add up; default 1
  /** Whether a choice shows something of its own. */
  offers(choice: TransferChoice): boolean;
  /** In the world. Held, not copied: later changes of it are followed by update(). */
  setLight(light: LambentLight | null): void;
  setEnvironment(environment: Environment | null): void;
  setEnvironmentTexture(texture: Texture | null, rotation?: Quaternion): void;
  /** Once a frame, before render(): relights if light, choices or the root's rotation changed. True if so. */
  update(renderer: WebGLRenderer): boolean;
  /** Frees geometries, materials, textures and targets. */
  dispose(): void;
}

/** The environment behind everything, looked up as mirrors do: add to the scene. */
export declare class EnvironmentBackground extends Object3DType {
  constructor(environment?: Environment);
  setEnvironment(environment: Environment | null): void;
  dispose(): void;
}
declare const Object3DType: typeof Mesh;

/** Linear float picture → exposure → curve → sRGB, onto `target` (null: the canvas). */
export declare class ToneMapper {
  exposure: number; // EV
  curve: ToneCurve;
  render(renderer: WebGLRenderer, linear: Texture, target?: WebGLRenderTarget | null): void;
  dispose(): void;
}
export declare function filmic(linear: number): number;
export declare const filmicGlsl: string;
export declare function srgbEncode(linear: number): number;
export declare function srgbDecode(encoded: number): number;

/** As the tool frames a scene that brings no camera. */
export declare function frameAutomatically(root: Object3D, camera: PerspectiveCamera, aspect: number): void;
/** Fits near and far to what is drawn, as the tool. */
export declare function fitClipping(camera: Camera, root: Object3D): void;
/** Places inside a pixel, as the tool's --samples N. */
export declare function subpixelPositions(count: number): [number, number][];
export type { DataTexture, Material };
