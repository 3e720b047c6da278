// A relit asset in a three scene: its light, its switches, its resources.

import {
  Quaternion,
  Texture,
  Vector3,
  type Camera,
  type Material,
  type Mesh,
  type Object3D,
  type WebGLRenderer,
} from "three";
import type { AssetDescription } from "../format/description.js";
import { FullScreenPass } from "../gpu/full-screen-pass.js";
import { canCapture } from "../gpu/local-capture.js";
import { RttTexture } from "../gpu/rtt-texture.js";
import type { Disc, LambentLight, QuaternionLike } from "../light/light.js";
import type { AirMode } from "../materials/air-source.js";
import { hasGrain, type Coverage } from "../materials/coverage.js";
import { EnvironmentUniforms, type Environment } from "../materials/environment-uniforms.js";
import type { AerialPerspective } from "../sky/air.js";
import { bandOf } from "../sh/basis.js";
import { HarmonicRotation, matrixOfQuaternion } from "../sh/rotation.js";
import { leastSofteningWindow } from "../sh/window.js";
import { infoOf, kindsOf, type AssetInfo, type AssetKind } from "./info.js";
import { AssetAir, type AirOptions } from "./asset-air.js";
import { offers, type TransferChoice } from "./choices.js";
import { capturedUniforms, Mirrors } from "./mirrors.js";
import type { Reflectance } from "./reflectance.js";
import { RelitMesh, type Choices, type IncidentMode, type Lights } from "./relit-mesh.js";
import { kindWithoutBounces, SharpSun, sunNotes } from "./sharp-sun.js";

/** A mesh as the loader made it, with what the file says of it. */
export interface MeshEntry {
  mesh: Mesh;
  /** Of "MESH/PRIMITIVE" in the document. */
  key: string;
  reflectance: Reflectance;
  coverage: Coverage;
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
  /**
   * Few bands cannot hold a narrow lobe, nor a small light: both ring. On: glossy lobes, and the light
   * that reaches them, are softened by the least that leaves neither negative, so that polished
   * surfaces show no dark or coloured rings. Off: as the harmonics have them, for comparison with other
   * renderers. Diffuse surfaces are the same either way.
   */
  softLobes = true;
  /**
   * Texels of a side of the cube maps in which mirrors see the asset itself; 0: they show the
   * environment alone, as they do on devices that cannot draw into half floats. Default 256.
   */
  mirrorSize = 256;
  /** The base colour alone, which costs what any unlit mesh costs. Default false. */
  unlit = false;
  /** Pictures of a pixel that the caller adds up: filters are as much narrower. Default 1. */
  samples = 1;
  /** Which of them the next one is, from 0: each sees the Sun from a point of its own. Default 0. */
  sample = 0;

  private readonly description: AssetDescription;
  private readonly relit: RelitMesh[];
  private readonly environment = new EnvironmentUniforms();
  /** @internal */
  readonly air = new AssetAir();
  private readonly screen = new FullScreenPass();
  private readonly rtts = new Map<number, RttTexture>();
  private light: LambentLight | null = null;
  private readonly rotation: HarmonicRotation;
  private readonly assetLight: Float64Array;
  private readonly sunShare: Float64Array;
  private readonly sun: SharpSun;
  private readonly mirrors: Mirrors;
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
    this.sunShare = new Float64Array(3 * description.bands ** 2);
    const captured = capturedUniforms();
    const shared = {
      description,
      incident,
      environment: this.environment,
      air: this.air.uniforms,
      captured,
      rtt: (index: number) => this.rtt(index),
    };
    this.relit = entries.map(
      ({ mesh, key, reflectance, coverage }, number) =>
        new RelitMesh(
          mesh,
          description.primitives.get(key) ?? null,
          reflectance,
          shared,
          coverage,
          number,
        ),
    );
    this.sun = new SharpSun(this.relit);
    for (const mesh of this.relit) mesh.sunUniforms = this.sun.uniforms;
    this.mirrors = new Mirrors(this.relit, this.sun.map.bounds, captured);
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

  /**
   * The Sun of setLight's light whose shadows are to be sharp: a disc of at most 5° that the light
   * holds, in the world (`sky.sun.disc`, or what {@link sunOf} finds). Diffuse surfaces then show
   * M L without what shadowed transfer makes of the disc's harmonics, and the disc itself through a
   * map of what hides it: what the asset shows shadowed or unshadowed, or holds shadowed beside
   * interreflected ({@link sunNotes} says where it does not). Only the asset's own meshes throw
   * shadows, and onto each other. null: all light is as the harmonics have it, as it is by default.
   *
   * @param weights what every band of the light was multiplied with: `light.windowWeights()`
   * @throws RangeError for a larger disc
   */
  setSun(sun: Disc | null, weights: ArrayLike<number> = []): void {
    this.sun.set(sun, weights);
    this.done = "";
  }

  /** Whether any surface can show a sharp Sun, whatever is chosen. */
  get offersSharpSun(): boolean {
    return this.relit.some(
      ({ transfer }) => transfer && kindWithoutBounces(this.description, transfer, "best"),
    );
  }

  /** What of the asset a sharp Sun does not reach as it is shown, in words with the remedy. */
  sunNotes(): string[] {
    return sunNotes(this.description, this.relit, this.transfer);
  }

  /**
   * The air that the asset is seen through by perspective cameras; null: none, as it is by default.
   * What else is in the scene is not seen through it.
   *
   * @throws RangeError for metres that are none
   */
  setAir(air: AerialPerspective | null, options: AirOptions = {}): void {
    this.air.set(air, options);
  }

  /** What mirrors show behind the asset itself ({@link mirrorSize}); null: black. */
  setEnvironment(environment: Environment | null): void {
    this.environment.set(environment);
  }

  /** The same: a latitude-longitude map, turned by worldFromEnvironment. */
  setEnvironmentTexture(texture: Texture | null, rotation?: QuaternionLike): void {
    this.setEnvironment(texture && { texture, rotation });
  }

  /**
   * Relights, if the light, a choice or the root's rotation has changed since the last call: turns
   * the light's coefficients into the asset's frame, and applies the transfer to them on the GPU.
   * No CPU time that grows with the asset, once a choice has been uploaded. Under a sharp Sun it
   * also draws the map of its shadows, if that is not there yet.
   *
   * @param camera what will be drawn with: the map of the Sun's shadows then covers what it sees
   *   alone, and is as much finer. Without it all of the asset.
   * @returns whether something was relit
   * @throws Error if the asset is too large for the device's textures
   */
  update(renderer: WebGLRenderer, camera?: Camera): boolean {
    this.follow(renderer);
    const choices: Choices = {
      transfer: this.transfer,
      macro: this.macro,
      viewDependent: this.viewDependent,
      filter: this.filter,
      lobeExponent: this.lobeExponent,
      softLobes: this.softLobes,
      unlit: this.unlit,
      samples: this.samples,
      sample: this.sample,
      sun: this.sun.shines,
      air: this.airMode,
      captured: this.captureSize(renderer) > 0,
    };
    let due = false;
    for (const mesh of this.relit) due = mesh.prepare(renderer, choices) || due;
    this.root.updateWorldMatrix(true, false);
    if (this.unlit) return false;
    this.sun.aim(this.root, this.sample, this.samples);
    this.air.look(this.root);
    const relit = this.relight(renderer, due);
    this.showMirrors(renderer, choices);
    this.look(renderer, camera);
    return relit;
  }

  private relight(renderer: WebGLRenderer, due: boolean): boolean {
    this.root.matrixWorld.decompose(translation, rotation, scale);
    const { light } = this;
    const state = [
      light?.version ?? "dark",
      this.lobeExponent,
      this.softLobes,
      rotation.x,
      rotation.y,
      rotation.z,
      rotation.w,
    ].join();
    if (!due && state === this.done) return false;
    const lights = this.turnLight(light, rotation.invert());
    for (const mesh of this.relit) mesh.relight(renderer, this.screen, lights, this);
    this.done = state;
    return true;
  }

  /** Into the asset's frame: all of the light, the Sun's share of it, the rest, what lobes see. */
  private turnLight(light: LambentLight | null, assetFromWorld: Quaternion): Lights {
    const { assetLight: whole, sunShare: sun } = this;
    whole.fill(0);
    sun.fill(0);
    if (light) {
      const bands = Math.min(light.bands, this.description.bands);
      this.rotation.set(matrixOfQuaternion(assetFromWorld));
      this.rotation.apply(light.coefficients, whole, bands, 3);
      if (this.sun.shines) this.rotation.apply(this.sun.share(bands).coefficients, sun, bands, 3);
    }
    const lobes = whole.slice();
    if (this.softLobes && this.hasLobes) {
      const weights = leastSofteningWindow(whole, this.description.bands);
      lobes.forEach((value, i) => (lobes[i] = weights[bandOf(Math.floor(i / 3))] * value));
    }
    return { whole, sun, withoutSun: whole.map((value, i) => value - sun[i]), lobes };
  }

  private get hasLobes(): boolean {
    return this.relit.some(({ transfer }) => transfer?.matrices);
  }

  /** @internal Shafts of light only where there is a Sun to throw them. */
  get airMode(): AirMode {
    if (!this.air.wanted) return "none";
    return this.air.shafts && this.sun.shines ? "shafts" : "air";
  }

  /** 0: mirrors see nothing of the asset. */
  private captureSize(renderer: WebGLRenderer): number {
    if (this.mirrors.count === 0 || !canCapture(renderer)) return 0;
    return Math.min(Math.floor(this.mirrorSize), renderer.capabilities.maxCubemapSize);
  }

  /** Captures what mirrors see, if that has changed. */
  private showMirrors(renderer: WebGLRenderer, choices: Choices): void {
    const size = this.captureSize(renderer);
    if (!(size > 0)) return this.mirrors.forget();
    const { samples, sample, ...rest } = choices;
    const { matrixWorld } = this.root;
    const air = choices.air !== "none";
    // What mirrors in captures show of the world.
    const around = this.mirrors.count > 1 && [
      this.environment.state,
      matrixWorld.elements.slice(0, 12), // not where the asset stands
      air && this.air.uniforms.airGround.value,
    ];
    const state = [
      JSON.stringify([size, rest, around, this.relit.map(({ mesh }) => mesh.visible)]),
      this.assetLight.join(),
      this.sun.state,
      air ? this.air.state : "",
      // Grain is another one in each of the pictures that are added up.
      this.relit.some(({ coverage }) => hasGrain(coverage)) ? sample % samples : "",
    ].join(" ");
    if (!this.mirrors.due(state)) return;
    // Mirrors see what no camera does.
    if (this.needsSunMap) this.sun.drawMap(renderer, this.root, undefined);
    this.air.lookWithoutShafts();
    this.mirrors.draw(renderer, state, matrixWorld, size, meanRadiance(this.assetLight));
  }

  private get needsSunMap(): boolean {
    return this.relit.some((mesh) => mesh.needsSunMap);
  }

  private look(renderer: WebGLRenderer, camera: Camera | undefined): void {
    const shafts = this.airMode === "shafts";
    if (shafts || this.needsSunMap) this.sun.drawMap(renderer, this.root, camera);
    if (shafts) this.air.lookForShafts(this.root, camera, this.sun.map.bounds, this.sun.map);
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
      this.sun.map.forget();
      this.mirrors.forget();
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
    this.sun.map.dispose();
    this.mirrors.forget();
    this.screen.dispose();
    this.root.removeFromParent();
    assets.delete(this.root);
  }
}

const translation = new Vector3();
const rotation = new Quaternion();
const scale = new Vector3();

/** The largest of the channels' means over all directions. */
const meanRadiance = (light: ArrayLike<number>) =>
  Math.max(Math.abs(light[0]), Math.abs(light[1]), Math.abs(light[2])) / Math.sqrt(4 * Math.PI);

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
