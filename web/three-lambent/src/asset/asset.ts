// A relit asset in a three scene: its light, its switches, its resources.

import {
  Object3D,
  Quaternion,
  Vector3,
  type Camera,
  type Mesh,
  type Scene,
  type Texture,
  type WebGLRenderer,
} from "three";
import { FullScreenPass } from "../gpu/full-screen-pass.js";
import { checkRenderer, isNodeRenderer, type AnyRenderer } from "../gpu/renderer.js";
import { checkLight } from "../light/check.js";
import type { Disc, LambentLight, QuaternionLike, Rgb } from "../light/light.js";
import { hasGrain } from "../materials/coverage.js";
import { checkEnvironment, type Environment } from "../materials/environment.js";
import type { AirMode } from "../materials/surroundings.js";
import type { AerialPerspective } from "../sky/air.js";
import { bandOf } from "../sh/basis.js";
import { HarmonicRotation, matrixOfQuaternion } from "../sh/rotation.js";
import { leastSofteningWindow } from "../sh/window.js";
import { infoOf, kindsOf, type AssetInfo, type AssetKind } from "./info.js";
import { adviseOnDrawing, adviseOnPlace, type Drawn } from "./advice.js";
import type { AirOptions, AssetAir } from "./asset-air.js";
import type { AssetSource } from "./asset-source.js";
import { checkTransfer, offers, type TransferChoice } from "./choices.js";
import { stateOfAsset, takeFrom, type Followed, type Given } from "./given.js";
import type { Mirrors } from "./mirrors.js";
import { RelitMesh, type Choices, type Lights } from "./relit-mesh.js";
import { kindWithoutBounces, SharpSun, sunNotes } from "./sharp-sun.js";

const assets = new WeakMap<Object3D, LambentAsset>();

/**
 * An asset with transfer: by {@link lambentOf} after loading, or by {@link LambentAsset.of}.
 *
 * All of its meshes move together with `root`, rigidly or scaled evenly: move that, not the meshes.
 * Set light and switches whenever you like, and call {@link update} once a frame before drawing.
 * `root.clone()` is lit as this asset is, wherever it is turned to, by this asset's `update`;
 * {@link instantiate} makes one whose light and switches are its own.
 */
export class LambentAsset {
  /** gltf.scene, or the copy of it that this instance is. */
  readonly root: Object3D;
  readonly info: AssetInfo;
  readonly kinds: ReadonlySet<AssetKind>;
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
  /**
   * Radiance of lines, a pixel and a half wide, along which pieces of a patch meet on a surface with
   * meso-structure: to see how it was laid. Shown with {@link filter}. Default null: none.
   */
  seams: Rgb | null = null;
  /** The base colour alone, which costs what any unlit mesh costs. Default false. */
  unlit = false;
  /** Pictures of a pixel that the caller adds up: filters are as much narrower. Default 1. */
  samples = 1;
  /** Which of them the next one is, from 0: each sees the Sun from a point of its own. Default 0. */
  sample = 0;

  private readonly source: AssetSource;
  private readonly relit: RelitMesh[];
  /** @internal Of the first air that was set. */
  air: AssetAir | null = null;
  private readonly screen = new FullScreenPass();
  private choice: TransferChoice = "best";
  /** @internal */
  readonly given: Given = {};
  /** Of a clone: what it last took from what it was cloned from. */
  private followed: Followed | null = null;
  private clones = new Set<WeakRef<LambentAsset>>();
  private readonly drawn: Drawn;
  private disposed = false;
  private readonly rotation: HarmonicRotation;
  private readonly assetLight: Float64Array;
  private readonly sunShare: Float64Array;
  private readonly sun: SharpSun;
  private readonly mirrors: Mirrors | null;
  private done = "";
  private lost: { canvas: EventTarget; listener: () => void } | null = null;

  /**
   * @internal Made by LambentLoaderPlugin.
   *
   * @param meshes what is drawn of each mesh of the source; undefined: nothing
   */
  constructor(root: Object3D, source: AssetSource, meshes: readonly (Mesh | undefined)[]) {
    const { description } = source;
    this.root = root;
    this.source = source;
    source.retain();
    this.rotation = new HarmonicRotation(description.bands);
    this.assetLight = new Float64Array(3 * description.bands ** 2);
    this.sunShare = new Float64Array(3 * description.bands ** 2);
    const { mirrors } = source.extras;
    this.mirrors = mirrors && new mirrors.Mirrors();
    this.sun = new SharpSun(source.meshes);
    const shared = {
      source,
      mirrors: this.mirrors,
      air: () => this.air,
      sun: this.sun.uniforms,
      drawn: (mesh: RelitMesh, scene: Scene, object: Object3D) =>
        adviseOnDrawing(this.drawn, mesh, scene, object),
      disposed: () => this.freeRest(),
    };
    this.relit = source.meshes.flatMap((each, i) => {
      const mesh = meshes[i];
      return mesh ? [new RelitMesh(mesh, each, shared)] : [];
    });
    this.mirrors?.place(this.relit, this.sun.map.bounds);
    this.kinds = kindsOf(this.relit);
    this.info = infoOf(description, this.relit);
    const { said } = source;
    const diagonal = this.sun.map.bounds.getSize(new Vector3()).length();
    const [lightGiven, environmentGiven] = [false, false];
    this.drawn = {
      ...{ root, diagonal, said, lightGiven, environmentGiven },
      ...{ updated: false, unlit: false },
    };
    root.clone = (recursive = true) =>
      recursive ? this.makeClone().root : Object3D.prototype.clone.call(root, false);
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

  /**
   * Which part of the transport relights. Default "best".
   *
   * @throws RangeError for another name
   */
  get transfer(): TransferChoice {
    return this.choice;
  }
  set transfer(choice: TransferChoice) {
    this.choice = checkTransfer(choice);
  }

  /**
   * Another one of the same, with a root of its own that stands where this one's does, below
   * nothing, and the light and switches that this one has now. From then on they are its own: turn
   * it, light it, `update` and dispose of it by itself. Geometries, textures and stored transfer
   * are shared; the last instance that is disposed of frees them. What is lit takes 16 bytes for
   * each diffuse receiver, and for each glossy one as many times that as it has groups of four
   * numbers.
   */
  instantiate(): LambentAsset {
    const root = Object3D.prototype.clone.call(this.root, true);
    const copies = new Map<Object3D, Object3D>();
    const pair = (from: Object3D, to: Object3D) => {
      copies.set(from, to);
      from.children.forEach((child, i) => pair(child, to.children[i]));
    };
    pair(this.root, root);
    const meshes = this.source.meshes.map((source) => {
      const relit = this.relit.find((each) => each.source === source);
      return relit && (copies.get(relit.mesh) as Mesh | undefined);
    });
    const made = new LambentAsset(root, this.source, meshes);
    takeFrom(made, this, null);
    return made;
  }

  /** What root.clone() is the root of. */
  private makeClone(): LambentAsset {
    const made = this.instantiate();
    made.followed = stateOfAsset(made);
    this.clones.add(new WeakRef(made));
    return made;
  }

  /** Whether every mesh holds what a choice asks for; "best" and "unshadowed" always. */
  offers(choice: TransferChoice): boolean {
    return offers(this.source.description, choice);
  }

  /**
   * Light in the world, one for the whole asset. It is held, not copied: what is done to it later is
   * followed by the next update(). null: darkness.
   *
   * @throws TypeError for anything else, such as one of three's own lights
   */
  setLight(light: LambentLight | null): void {
    this.given.light = checkLight(light);
    this.drawn.lightGiven = true;
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
    this.given.sun = { disc: sun, weights };
    this.done = "";
  }

  /** Whether any surface can show a sharp Sun, whatever is chosen. */
  get offersSharpSun(): boolean {
    return this.relit.some(
      ({ transfer }) => transfer && kindWithoutBounces(this.source.description, transfer, "best"),
    );
  }

  /** What of the asset a sharp Sun does not reach as it is shown, in words with the remedy. */
  sunNotes(): string[] {
    return sunNotes(this.source.description, this.relit, this.transfer);
  }

  /**
   * The air that the asset is seen through by perspective cameras; null: none, as it is by default.
   * What else is in the scene is not seen through it.
   *
   * @throws RangeError for metres that are none
   */
  setAir(air: AerialPerspective | null, options: AirOptions = {}): void {
    this.air ??= air && air.forAsset();
    this.air?.set(air, options);
    this.given.air = { air, options };
  }

  /** What mirrors show behind the asset itself ({@link mirrorSize}); null: black. */
  setEnvironment(environment: Environment | null): void {
    checkEnvironment(environment);
    this.mirrors?.environment.set(environment);
    this.given.environment = environment;
    this.drawn.environmentGiven = true;
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
   * @throws Error if the asset is too large for the device's textures, the light has a number that
   *   is not finite, or the renderer is neither a WebGLRenderer with WebGL 2 nor an initialised
   *   WebGPURenderer whose nodes the loader was given and can draw all of the asset
   */
  update(renderer: AnyRenderer, camera?: Camera): boolean {
    const { nodes } = this.source;
    checkRenderer(renderer, nodes);
    if (isNodeRenderer(renderer))
      nodes?.checkWanted({
        mirrors: this.kinds.has("mirror") && !this.unlit,
        patches: this.kinds.has("bi-scale") && !this.unlit,
        sun: this.sun.shines,
        air: this.air?.wanted ?? false,
      });
    if (this.disposed)
      throw new Error("three-lambent: update() of an asset that was disposed of: load it again");
    let relit = this.updateOne(renderer, camera);
    for (const each of this.clones) {
      const clone = each.deref();
      if (!clone || clone.disposed) this.clones.delete(each);
      else {
        clone.followed = takeFrom(clone, this, clone.followed);
        relit = clone.update(renderer, camera) || relit;
      }
    }
    return relit;
  }

  private updateOne(renderer: WebGLRenderer, camera: Camera | undefined): boolean {
    this.follow(renderer);
    const choices: Choices = {
      transfer: this.transfer,
      macro: this.macro,
      viewDependent: this.viewDependent,
      filter: this.filter,
      lobeExponent: this.lobeExponent,
      softLobes: this.softLobes,
      seams: this.seams,
      unlit: this.unlit,
      samples: this.samples,
      sample: this.sample,
      sun: this.sun.shines,
      air: this.airMode,
      captured: (this.mirrors?.sizeOn(renderer, this.mirrorSize) ?? 0) > 0,
    };
    let due = false;
    for (const mesh of this.relit) due = mesh.prepare(renderer, choices) || due;
    this.root.updateWorldMatrix(true, false);
    this.drawn.updated = true;
    this.drawn.unlit = this.unlit;
    if (this.unlit) return false;
    adviseOnPlace(this.drawn);
    this.sun.aim(this.root, this.sample, this.samples);
    this.air?.look(this.root);
    const relit = this.relight(renderer, due);
    this.showMirrors(renderer, choices);
    this.look(renderer, camera);
    return relit;
  }

  private relight(renderer: WebGLRenderer, due: boolean): boolean {
    this.root.matrixWorld.decompose(translation, rotation, scale);
    const { light = null } = this.given;
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
      const bands = Math.min(light.bands, this.source.description.bands);
      if (!light.coefficients.every(Number.isFinite))
        throw new Error("three-lambent: the light has a coefficient that is not a finite number");
      this.rotation.set(matrixOfQuaternion(assetFromWorld));
      this.rotation.apply(light.coefficients, whole, bands, 3);
      if (this.sun.shines) this.rotation.apply(this.sun.share(bands).coefficients, sun, bands, 3);
    }
    const lobes = whole.slice();
    if (this.softLobes && this.hasLobes) {
      const weights = leastSofteningWindow(whole, this.source.description.bands);
      lobes.forEach((value, i) => (lobes[i] = weights[bandOf(Math.floor(i / 3))] * value));
    }
    return { whole, sun, withoutSun: whole.map((value, i) => value - sun[i]), lobes };
  }

  private get hasLobes(): boolean {
    return this.relit.some(({ transfer }) => transfer?.matrices);
  }

  /** @internal Shafts of light only where there is a Sun to throw them. */
  get airMode(): AirMode {
    if (!this.air?.wanted) return "none";
    return this.air.shafts && this.sun.shines ? "shafts" : "air";
  }

  /** Captures what mirrors see, if that has changed. */
  private showMirrors(renderer: WebGLRenderer, choices: Choices): void {
    const { mirrors } = this;
    if (!mirrors) return;
    const size = mirrors.sizeOn(renderer, this.mirrorSize);
    if (!(size > 0)) return mirrors.forget();
    const { samples, sample, ...rest } = choices;
    const { matrixWorld } = this.root;
    const air = choices.air === "none" ? null : this.air;
    // What mirrors in captures show of the world.
    const around = mirrors.seeEachOther && [
      mirrors.environment.state,
      matrixWorld.elements.slice(0, 12), // not where the asset stands
      air?.uniforms.airGround.value,
    ];
    const state = [
      JSON.stringify([size, rest, around, this.relit.map(({ mesh }) => mesh.visible)]),
      this.assetLight.join(),
      this.sun.state,
      air?.state ?? "",
      // Grain is another one in each of the pictures that are added up.
      this.relit.some(({ coverage }) => hasGrain(coverage)) ? sample % samples : "",
    ].join(" ");
    if (!mirrors.due(state)) return;
    // Mirrors see what no camera does.
    if (this.needsSunMap) this.sun.drawMap(renderer, this.root, undefined);
    this.air?.lookWithoutShafts();
    mirrors.draw(renderer, state, matrixWorld, size, meanRadiance(this.assetLight));
  }

  private get needsSunMap(): boolean {
    return this.relit.some((mesh) => mesh.needsSunMap);
  }

  private look(renderer: WebGLRenderer, camera: Camera | undefined): void {
    const shafts = this.airMode === "shafts";
    if (shafts || this.needsSunMap) this.sun.drawMap(renderer, this.root, camera);
    if (shafts) this.air!.lookForShafts(this.root, camera, this.sun.map.bounds, this.sun.map);
  }

  /** What a lost context took along, or another renderer has, is made again from the file's bytes. */
  private follow(renderer: WebGLRenderer): void {
    const canvas = renderer.domElement as EventTarget;
    if (this.lost?.canvas === canvas) return;
    const listener = () => {
      this.source.forget(renderer);
      for (const mesh of this.relit) mesh.forget();
      this.sun.map.forget();
      this.mirrors?.forget();
      this.done = "";
    };
    if (this.lost) {
      this.lost.canvas.removeEventListener("webglcontextrestored", this.lost.listener);
      listener();
    }
    canvas.addEventListener("webglcontextrestored", listener);
    this.lost = { canvas, listener };
  }

  /**
   * Frees materials, textures and targets, and takes the root out of its scene; the last instance
   * of an asset also its geometries, textures and stored transfer.
   */
  dispose(): void {
    if (this.disposed) return;
    this.disposed = true;
    for (const mesh of this.relit) mesh.dispose();
    this.freeOwn();
    this.source.release();
    this.root.removeFromParent();
    delete (this.root as Partial<Object3D>).clone;
    assets.delete(this.root);
  }

  /** Once somebody has disposed of all materials; what is used again comes back. */
  private freeRest(): void {
    if (this.relit.some((mesh) => mesh.isBuilt)) return;
    this.freeOwn();
    for (const { source } of this.relit) source.freeGeometries();
    this.done = "";
  }

  private freeOwn(): void {
    this.lost?.canvas.removeEventListener("webglcontextrestored", this.lost.listener);
    this.lost = null;
    this.mirrors?.dispose();
    this.sun.map.dispose();
    this.screen.dispose();
  }
}

const translation = new Vector3();
const rotation = new Quaternion();
const scale = new Vector3();

/** The largest of the channels' means over all directions. */
const meanRadiance = (light: ArrayLike<number>) =>
  Math.max(Math.abs(light[0]), Math.abs(light[1]), Math.abs(light[2])) / Math.sqrt(4 * Math.PI);
