// A relit asset in a three scene: its light, its switches, its resources.

import {
  Quaternion,
  Texture,
  Vector3,
  type Material,
  type Mesh,
  type Object3D,
  type WebGLRenderer,
} from "three";
import type { AssetDescription } from "../format/description.js";
import { FullScreenPass } from "../gpu/full-screen-pass.js";
import { RttTexture } from "../gpu/rtt-texture.js";
import type { LambentLight, QuaternionLike } from "../light/light.js";
import { EnvironmentUniforms, type Environment } from "../materials/environment-uniforms.js";
import { HarmonicRotation, matrixOfQuaternion } from "../sh/rotation.js";
import { offers, type TransferChoice } from "./choices.js";
import type { Reflectance } from "./reflectance.js";
import { RelitMesh, type Choices, type IncidentMode } from "./relit-mesh.js";

/** Kinds of surfaces that an asset may have. */
export type AssetKind = "diffuse" | "glossy" | "texels" | "mirror" | "bi-scale";

/** What an asset says about itself. */
export interface AssetInfo {
  /** Of the format. */
  version: string;
  generator: string;
  /** What was simulated: "unshadowed", "shadowed" or "interreflected". */
  transfer: string;
  /** Bands of light that relight it. */
  bands: number;
  directions: number;
  bounces: number;
  vertices: number;
  triangles: number;
  receivers: number;
  /** Bytes of transfer, RTTs and id maps in the file. */
  transferBytes: number;
}

/** A mesh as the loader made it, with what the file says of it. */
export interface MeshEntry {
  mesh: Mesh;
  /** Of "MESH/PRIMITIVE" in the document. */
  key: string;
  reflectance: Reflectance;
}

const assets = new WeakMap<Object3D, LambentAsset>();

/**
 * An asset with transfer: at `gltf.userData.lambent` after loading, or by {@link LambentAsset.of}.
 *
 * All of its meshes move together with `root`, rigidly or scaled evenly: move that, not the meshes.
 * Set light and switches whenever you like, and call {@link update} once a frame before drawing.
 */
export class LambentAsset {
  /** gltf.scene. */
  readonly root: Object3D;
  readonly info: AssetInfo;
  readonly kinds: ReadonlySet<AssetKind>;
  /** Which part of the transport relights. Default "best". */
  transfer: TransferChoice = "best";
  /** Off: meso-structure takes the light as if nothing had hidden it on its way. Default true. */
  macro = true;
  /** Off: meso-structure everywhere as seen from straight above. Default true. */
  viewDependent = true;
  /** Average meso-structure over what a pixel covers. Off: the nearest position. Default true. */
  filter = true;
  /** Exponent of glossy lobes, ≥ 0; null: the materials' own. Default null. */
  lobeExponent: number | null = null;
  /** The base colour alone, which costs what any unlit mesh costs. Default false. */
  unlit = false;
  /** Pictures of a pixel that the caller adds up: filters are as much narrower. Default 1. */
  samples = 1;

  private readonly description: AssetDescription;
  private readonly relit: RelitMesh[];
  private readonly environment = new EnvironmentUniforms();
  private readonly screen = new FullScreenPass();
  private readonly rtts = new Map<number, RttTexture>();
  private light: LambentLight | null = null;
  private readonly rotation: HarmonicRotation;
  private readonly assetLight: Float64Array;
  private done = "";
  private lost: { canvas: EventTarget; listener: () => void } | null = null;

  /** @internal Made by LambentLoaderPlugin. */
  constructor(
    root: Object3D,
    description: AssetDescription,
    entries: readonly MeshEntry[],
    incident: IncidentMode,
  ) {
    this.root = root;
    this.description = description;
    this.rotation = new HarmonicRotation(description.bands);
    this.assetLight = new Float64Array(3 * description.bands ** 2);
    const shared = {
      description,
      incident,
      environment: this.environment,
      rtt: (index: number) => this.rtt(index),
    };
    this.relit = entries.map(
      ({ mesh, key, reflectance }) =>
        new RelitMesh(mesh, description.primitives.get(key) ?? null, reflectance, shared),
    );
    this.kinds = kindsOf(this.relit);
    this.info = infoOf(description, this.relit);
    assets.set(root, this);
  }

  /** The asset whose root is this object, or the nearest above it. */
  static of(object: Object3D | null): LambentAsset | undefined {
    for (let at = object; at; at = at.parent) {
      const asset = assets.get(at);
      if (asset) return asset;
    }
    return undefined;
  }

  get meshes(): Mesh[] {
    return this.relit.map(({ mesh }) => mesh);
  }

  /** Whether every mesh holds what a choice asks for; "best" and "unshadowed" always. */
  offers(choice: TransferChoice): boolean {
    return offers(this.description, choice);
  }

  /**
   * Light in the world, one for the whole asset. It is held, not copied: what is done to it later is
   * followed by the next update(). null: darkness.
   */
  setLight(light: LambentLight | null): void {
    this.light = light;
    this.done = "";
  }

  /** What mirrors show; null: black. */
  setEnvironment(environment: Environment | null): void {
    this.environment.set(environment);
  }

  /** What mirrors show: a latitude-longitude map, turned by worldFromEnvironment. */
  setEnvironmentTexture(texture: Texture | null, rotation?: QuaternionLike): void {
    this.setEnvironment(texture && { texture, rotation });
  }

  /**
   * Relights, if the light, a choice or the root's rotation has changed since the last call: turns
   * the light's coefficients into the asset's frame, and applies the transfer to them on the GPU.
   * No CPU time that grows with the asset, once a choice has been uploaded.
   *
   * @returns whether something was relit
   * @throws Error if the asset is too large for the device's textures
   */
  update(renderer: WebGLRenderer): boolean {
    this.follow(renderer);
    const choices: Choices = {
      transfer: this.transfer,
      macro: this.macro,
      viewDependent: this.viewDependent,
      filter: this.filter,
      lobeExponent: this.lobeExponent,
      unlit: this.unlit,
      samples: this.samples,
    };
    let due = false;
    for (const mesh of this.relit) due = mesh.prepare(renderer, choices) || due;
    this.root.updateWorldMatrix(true, false);
    this.root.matrixWorld.decompose(translation, rotation, scale);
    const { light } = this;
    const state = [
      light?.version ?? "dark",
      this.lobeExponent,
      rotation.x,
      rotation.y,
      rotation.z,
      rotation.w,
    ].join();
    if (this.unlit || (!due && state === this.done)) return false;
    this.assetLight.fill(0);
    if (light) {
      const bands = Math.min(light.bands, this.description.bands);
      this.rotation
        .set(matrixOfQuaternion(rotation.invert()))
        .apply(light.coefficients, this.assetLight, bands, 3);
    }
    for (const mesh of this.relit)
      mesh.relight(renderer, this.screen, this.assetLight, this.lobeExponent);
    this.done = state;
    return true;
  }

  private rtt(index: number): RttTexture {
    let rtt = this.rtts.get(index);
    if (!rtt) {
      rtt = new RttTexture(this.description.rtts[index]);
      this.rtts.set(index, rtt);
    }
    return rtt;
  }

  /** What a lost context took along, or another renderer has, is made again from the file's bytes. */
  private follow(renderer: WebGLRenderer): void {
    const canvas = renderer.domElement as EventTarget;
    if (this.lost?.canvas === canvas) return;
    const listener = () => {
      for (const mesh of this.relit) mesh.forget();
      for (const rtt of this.rtts.values()) rtt.dispose();
      this.rtts.clear();
      this.done = "";
    };
    if (this.lost) {
      this.lost.canvas.removeEventListener("webglcontextrestored", this.lost.listener);
      listener();
    }
    canvas.addEventListener("webglcontextrestored", listener);
    this.lost = { canvas, listener };
  }

  /** Frees all geometries, materials, textures and targets, and takes the root out of its scene. */
  dispose(): void {
    this.lost?.canvas.removeEventListener("webglcontextrestored", this.lost.listener);
    this.lost = null;
    for (const mesh of this.relit) {
      mesh.dispose();
      disposeMaterial(mesh.original);
    }
    for (const rtt of this.rtts.values()) rtt.dispose();
    this.rtts.clear();
    this.environment.dispose();
    this.screen.dispose();
    this.root.removeFromParent();
    assets.delete(this.root);
  }
}

const translation = new Vector3();
const rotation = new Quaternion();
const scale = new Vector3();

/** A loaded material with its textures; pictures that the browser decoded are closed. */
function disposeMaterial(material: Material): void {
  for (const value of Object.values(material)) {
    if (!(value instanceof Texture)) continue;
    value.dispose();
    const image = value.image as { close?: () => void } | null;
    image?.close?.();
  }
  material.dispose();
}

function kindsOf(meshes: readonly RelitMesh[]): Set<AssetKind> {
  const kinds = new Set<AssetKind>();
  for (const { transfer, isMirror } of meshes) {
    if (isMirror) kinds.add("mirror");
    else if (transfer?.biScale) kinds.add("bi-scale");
    if (transfer?.vectors) kinds.add("diffuse");
    if (transfer?.matrices) kinds.add("glossy");
    if (transfer?.grid) kinds.add("texels");
  }
  return kinds;
}

function infoOf(description: AssetDescription, meshes: readonly RelitMesh[]): AssetInfo {
  let [vertices, triangles, receivers, transferBytes] = [0, 0, 0, 0];
  for (const { mesh, transfer } of meshes) {
    const { index } = mesh.geometry;
    const { count } = mesh.geometry.getAttribute("position");
    vertices += count;
    triangles += (index ? index.count : count) / 3;
    receivers += transfer?.receivers ?? 0;
    const blocks = [
      transfer?.vectors?.numbers,
      transfer?.matrices?.numbers,
      transfer?.shadowed?.vectors?.numbers,
      transfer?.shadowed?.matrices?.numbers,
      transfer?.biScale?.shadowed?.numbers,
      transfer?.biScale?.interreflected?.numbers,
    ];
    for (const numbers of blocks) transferBytes += numbers?.data.byteLength ?? 0;
    transferBytes += transfer?.biScale?.idMap?.ids.byteLength ?? 0;
  }
  for (const { numbers } of description.rtts) transferBytes += numbers.data.byteLength;
  const { version, generator, transfer, bands, directions, bounces } = description;
  return {
    ...{ version, generator, transfer, bands, directions, bounces },
    ...{ vertices, triangles, receivers, transferBytes },
  };
}
