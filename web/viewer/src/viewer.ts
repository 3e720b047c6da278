// What is shown and how it changes: the view, the files behind it, and the frames that show it.
import { Vector3 } from "three";
import { kMostDiscs } from "three-lambent";
import { azimuthElevationOf, kRadians } from "./directions";
import { loadEnvironment, type LoadedEnvironment, type ReadFile } from "./environments";
import { FrameGraph } from "./frame_graph";
import { listen } from "./gestures";
import { loadAsset } from "./load_asset";
import type { AssetEntry, EnvironmentEntry } from "./manifest";
import { LoadingBar, Messages } from "./messages";
import { orbit, pan, turnEnvironment, turnObject, zoom, type Grip } from "./orbit";
import { SkyMap } from "./sky_map";
import { skySource, type SkySettings } from "./sky_source";
import { airs } from "./skies";
import { Stage } from "./stage";
import {
  defaultView,
  parseView,
  type AirShown,
  type DiscState,
  type LookAt,
  type Rotation,
  type Triple,
  type ViewState,
} from "./view_state";

/** A file by its name: on the server, or dropped by a person. */
export interface Opened {
  name: string;
  read: ReadFile;
  view?: Record<string, unknown>;
}

const kRadiansPerPixel = 0.008;
const kGoRound = 0.35; // radians a second
/** Width over height that the manifest's views leave nothing out at. */
const kViewsMadeFor = 1.15;
const kSkyMean = 0.45; // what the mean radiance of a sky is exposed to
const kStillAfter = 120; // milliseconds without a change until a picture is refined

export class Viewer {
  readonly messages = new Messages();
  readonly loading = new LoadingBar();
  readonly graph = new FrameGraph();
  readonly sky: SkyMap;
  view: ViewState = defaultView();
  readonly assets: Opened[] = [];
  readonly environments: EnvironmentEntry[] = [];
  asset = -1;
  disc = -1;
  grip: Grip = "camera";
  playing = false;
  unlit = false;
  /** Whether the exposure follows the sky, and why the last one that was wanted is not shown. */
  follows = true;
  skyProblem: string | null = null;
  /** Called after anything changed that controls show. */
  changed: () => void = () => {};

  private stage: Stage;
  private readonly files = new Map<string, ReadFile>();
  private scheduled = false;
  private moved = true;
  private done = false;
  private lastChange = 0;
  private lastFrame = 0;
  private waiting: (() => void)[] = [];
  private drawing: (() => void)[] = [];
  private lost = false;
  private opening = 0;
  private skiesWanted = 0;
  private lastAir: AirShown = { metresPerUnit: 1, shafts: false };
  private beforeSky: { source: string; rotation: Rotation; exposure: number } | null = null;

  /** Throws where the browser gives no WebGL 2. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas);
    this.sky = new SkyMap({
      choose: (disc) => this.chooseDisc(disc),
      move: (disc, azimuth, elevation) =>
        this.change((view) => Object.assign(view.discs[disc]!, { azimuth, elevation })),
      turn: (radians) => this.turnLight(radians, 0),
    });
    new ResizeObserver(() => this.resize()).observe(canvas);
    listen(canvas, {
      grip: () => this.grip,
      drag: (grip, x, y) => this.drag(grip, kRadiansPerPixel * x, kRadiansPerPixel * y),
      pan: (x, y) => this.pan(x, y),
      zoom: (factor) => this.zoom(factor),
      click: () => {},
      doubleClick: () => this.frame(),
    });
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.lost = true;
      this.messages.error(
        "The browser took the graphics context away; the picture comes back when it returns it.",
      );
    });
    canvas.addEventListener("webglcontextrestored", () => void this.restore());
  }

  // What the view says ----------------------------------------------------------------------------

  /** Changes the view, and shows it. */
  change(what: (view: ViewState) => void): void {
    what(this.view);
    this.touch();
  }
  /** The camera as it stands, chosen by the asset if the view names none. */
  camera(): LookAt {
    return this.view.camera ?? this.stage.standardCamera();
  }
  private touch(): void {
    this.moved = true;
    this.done = false;
    this.lastChange = performance.now();
    this.schedule();
    this.changed();
  }

  drag(grip: Grip, x: number, y: number): void {
    if (grip === "camera") this.change((view) => (view.camera = orbit(this.camera(), x, y)));
    else if (grip === "light") this.turnLight(x, y);
    else this.turnObject(x, y);
  }
  turnObject(x: number, y: number): void {
    const { centre } = this.stage.extent();
    this.change((view) => (view.object = turnObject(view.object, this.camera(), centre, x, y)));
  }
  turnLight(x: number, y: number): void {
    this.change((view) => {
      view.environment.rotation = turnEnvironment(view.environment.rotation, this.camera(), x, y);
    });
  }
  pan(x: number, y: number): void {
    const height = this.canvas.clientHeight;
    this.change((view) => (view.camera = pan(this.camera(), x, y, height)));
  }
  zoom(factor: number): void {
    const { diagonal } = this.stage.extent();
    this.change((view) => (view.camera = zoom(this.camera(), factor, diagonal)));
  }
  /** The whole object, from where it is framed best; turned and moved as it is. */
  frame(): void {
    this.change((view) => (view.camera = null));
  }
  /** As the asset was first shown. */
  reset(): void {
    const own = this.assets[this.asset]?.view;
    const { source } = this.view.environment;
    this.view = this.viewOf(own);
    this.view.environment.source = source;
    this.disc = -1;
    this.unlit = false;
    this.exposeSky();
    this.play(false);
  }
  play(on: boolean): void {
    this.playing = on;
    this.lastFrame = performance.now();
    this.touch();
  }
  /** Base colours instead of light: to see what the light does. */
  setUnlit(on: boolean): void {
    this.unlit = on;
    this.touch();
  }
  addDisc(): void {
    if (this.view.discs.length >= kMostDiscs)
      return this.messages.note(`There can be ${kMostDiscs} discs: mirrors can show no more.`);
    const { position, target } = this.camera();
    const back = new Vector3(...position).sub(new Vector3(...target));
    const azimuth = azimuthElevationOf(back).azimuth / kRadians;
    const turned = azimuth + 50 + 65 * this.view.discs.length;
    const disc: DiscState = {
      azimuth: Math.round(turned - 360 * Math.round(turned / 360)),
      elevation: 35,
      diameter: 18,
      radiance: [16, 14, 11],
    };
    this.disc = this.view.discs.length;
    this.change((view) => view.discs.push(disc));
  }
  removeDisc(index: number): void {
    if (this.view.discs[index] === undefined) return;
    this.change((view) => view.discs.splice(index, 1));
    this.chooseDisc(Math.min(index, this.view.discs.length - 1));
  }
  chooseDisc(index: number): void {
    this.disc = index;
    this.touch();
  }

  // The sky ---------------------------------------------------------------------------------------

  /**
   * Shows a sky in place of the environment: once its data is there, in the next frame. null: shows
   * again what was there before.
   */
  async showSky(settings: SkySettings | null): Promise<void> {
    const ticket = ++this.skiesWanted;
    const before = this.beforeSky;
    const wanted = settings === null ? null : skySource(settings);
    try {
      const source = wanted ?? before?.source ?? this.environments[0]?.source ?? "uniform:1";
      const loaded = await loadEnvironment(source, this.files, this.stage.floatTextures);
      if (ticket !== this.skiesWanted) return loaded.dispose();
      const shown = this.view.environment;
      const enters = wanted !== null && !shown.source.startsWith("sky:");
      if (enters)
        this.beforeSky = structuredClone({ ...shown, exposure: this.view.exposure });
      this.stage.setEnvironment(loaded);
      this.skyProblem = null;
      this.change((view) => {
        view.environment.source = source;
        if (enters) view.environment.rotation = [0, 0, 0, 1]; // north is north
        if (wanted === null && before !== null) {
          view.environment.rotation = before.rotation;
          view.exposure = before.exposure;
        }
      });
      this.exposeSky();
    } catch (error) {
      if (ticket !== this.skiesWanted) return;
      const text = error instanceof Error ? error.message : String(error);
      this.skyProblem = text.replace(/^LambentSky: /, "");
      this.changed();
    }
  }
  /** Things are seen through the air of the sky, or not; with what has changed of how. */
  async showAir(on: boolean, part: Partial<AirShown> = {}): Promise<void> {
    const air = { ...this.lastAir, ...this.view.air, ...part };
    this.lastAir = air;
    this.change((view) => (view.air = on ? { ...air } : null));
    await this.fetchAir();
  }
  /** What the air of a view is made with: it is there once it is wanted. */
  private async fetchAir(): Promise<void> {
    if (this.view.air === null || this.stage.air !== null) return;
    try {
      this.stage.air = await airs();
      this.touch();
    } catch (error) {
      this.messages.error(error instanceof Error ? error.message : String(error));
    }
  }
  /** Says so where a view that was opened has air that cannot be shown. */
  private noteAir(): void {
    if (this.view.air === null) return;
    if (!this.stage.environment?.sky)
      this.messages.note("The air of this view is not shown: it is that of a sky, which its light is not.");
    else if (this.camera().orthographicHalfHeight !== null)
      this.messages.note("The air of this view is not shown: an orthographic camera sees no distance.");
  }
  followSky(on: boolean): void {
    this.follows = on;
    this.exposeSky();
    this.touch();
  }
  private exposeSky(): void {
    const exposure = this.skyExposure();
    if (this.follows && exposure !== null) this.change((view) => (view.exposure = exposure));
  }
  /** EV by which the mean radiance from everywhere becomes a middle tone; null: there is no sky. */
  private skyExposure(): number | null {
    const sky = this.stage.environment?.sky;
    if (!sky) return null;
    const [r, g, b] = sky.light(1).radiance({ x: 0, y: 1, z: 0 });
    const mean = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    return Math.round(100 * Math.log2(kSkyMean / mean)) / 100;
  }

  // Files -----------------------------------------------------------------------------------------

  addEnvironments(entries: readonly EnvironmentEntry[], read: (url: string) => ReadFile): void {
    for (const entry of entries) {
      this.environments.push(entry);
      for (const [name, url] of Object.entries(entry.files)) this.files.set(name, read(url));
    }
  }
  addAssets(entries: readonly AssetEntry[], read: (url: string) => ReadFile): void {
    for (const entry of entries)
      this.assets.push({ name: entry.name, read: read(entry.file), view: entry.view });
  }

  /** Shows an asset of the list. What cannot be shown says why, and the old one stays. */
  async openAsset(index: number, view?: ViewState): Promise<boolean> {
    const opened = this.assets[index]!;
    return this.attempt(`Loading ${opened.name}`, async (current) => {
      const next = view ?? this.viewOf(opened.view, this.asset < 0 ? undefined : this.view);
      const reading = async () => {
        const bytes = await opened.read();
        this.loading.show(`Reading ${opened.name}`, null);
        return loadAsset(bytes, opened.name);
      };
      const [asset, light] = await Promise.allSettled([
        reading(),
        this.readEnvironment(next.environment.source),
      ]);
      if (asset.status === "rejected" || light.status === "rejected" || !current()) {
        if (asset.status === "fulfilled") asset.value.asset.dispose();
        if (light.status === "fulfilled") light.value?.dispose();
        for (const each of [asset, light]) if (each.status === "rejected") throw each.reason;
        return;
      }
      const loaded = asset.value;
      if (light.value !== null) this.stage.setEnvironment(light.value);
      this.stage.setAsset(loaded);
      this.asset = index;
      this.view = next;
      this.disc = Math.min(this.disc, next.discs.length - 1);
      this.touch();
      await this.fetchAir();
      await this.drawn();
      const errors = this.stage.shaderErrors();
      if (errors !== null)
        throw new Error(`The graphics driver cannot draw ${opened.name}: ${errors}`);
    });
  }
  /** Shows an environment of the list. */
  async openEnvironment(index: number): Promise<boolean> {
    const { name, source } = this.environments[index]!;
    return this.attempt(`Loading ${name}`, async () => {
      ++this.skiesWanted; // what a sky that is still on its way would undo
      await this.useEnvironment(source);
      this.change((view) => {
        if (view.environment.source.startsWith("sky:") && this.beforeSky !== null)
          view.exposure = this.beforeSky.exposure;
        view.environment.source = source;
      });
    });
  }
  /** Shows a saved view. */
  async openView(json: unknown, name: string): Promise<boolean> {
    return this.attempt(`Reading ${name}`, async () => {
      const view = parseView(json, name);
      if (view.discs.length > kMostDiscs)
        this.messages.note(`Mirrors and the background show the first ${kMostDiscs} discs alone.`);
      ++this.skiesWanted;
      await this.useEnvironment(view.environment.source);
      this.view = view;
      this.skyProblem = null;
      this.follows = [null, view.exposure].includes(this.skyExposure());
      this.disc = -1;
      this.touch();
      this.noteAir();
      await this.fetchAir();
    });
  }
  /** Dropped or picked: an asset, a light, or a saved view, by the file's name and content. */
  async openFile(file: File): Promise<boolean> {
    const read = () => file.arrayBuffer();
    if (/\.(glb|gltf)$/i.test(file.name)) {
      if (/\.gltf$/i.test(file.name))
        return this.fail(`${file.name}: the page opens .glb, which holds everything in one file.`);
      const known = this.assets.findIndex((each) => each.name === file.name);
      const index = known < 0 ? this.assets.length : known;
      const before = this.assets[index];
      this.assets[index] = { name: file.name, read };
      if (await this.openAsset(index)) return true;
      if (before === undefined) this.assets.splice(index, 1);
      else this.assets[index] = before;
      this.changed();
      return false;
    }
    if (/\.json$/i.test(file.name)) {
      let json: unknown;
      try {
        json = JSON.parse(await file.text());
      } catch {
        return this.fail(`${file.name}: not JSON. The page reads saved views and lights.`);
      }
      if ((json as { lambent?: unknown } | null)?.lambent === "view")
        return this.openView(json, file.name);
    } else if (!/\.(hdr|exr|png|jpe?g)$/i.test(file.name)) {
      return this.fail(
        `${file.name}: the page opens .glb, .hdr, .exr, .png, and saved views and lights as .json.`,
      );
    }
    return this.openLight(file.name, read);
  }
  private async openLight(name: string, read: ReadFile): Promise<boolean> {
    const before = this.files.get(name);
    this.files.set(name, read);
    const shown = await this.attempt(`Reading ${name}`, async () => {
      await this.useEnvironment(name, true);
      if (!this.environments.some((each) => each.source === name))
        this.environments.push({ name, source: name, files: {} });
      this.change((view) => (view.environment.source = name));
    });
    if (!shown && before === undefined) this.files.delete(name);
    else if (!shown) this.files.set(name, before!);
    return shown;
  }

  /** A view that suits an asset: what the manifest says of it, and of the last view what is not of
   * the old object. */
  private viewOf(members?: Record<string, unknown>, last?: ViewState): ViewState {
    const base = defaultView();
    if (last !== undefined)
      Object.assign(base, structuredClone(last), { camera: null, object: defaultView().object });
    else if (this.environments.length > 0) base.environment.source = this.environments[0]!.source;
    if (members === undefined) return base;
    const view = parseView({ lambent: "view", ...members }, "manifest.json", base);
    // Set up for a window that is wider than high: a phone steps back.
    const back = Math.min(1, this.stage.aspect / kViewsMadeFor);
    if (view.camera !== null) {
      const { position, target } = view.camera;
      view.camera.position = position.map(
        (each, i) => target[i]! + (each - target[i]!) / back) as Triple;
    }
    return view;
  }
  /** null: it is there already. */
  private async readEnvironment(source: string): Promise<LoadedEnvironment | null> {
    if (this.stage.environment?.source === source) return null;
    return loadEnvironment(source, this.files, this.stage.floatTextures);
  }
  private async useEnvironment(source: string, anew = false): Promise<void> {
    if (!anew && this.stage.environment?.source === source) return;
    this.stage.setEnvironment(
      await loadEnvironment(source, this.files, this.stage.floatTextures),
    );
  }
  private fail(message: string): false {
    this.messages.error(message);
    return false;
  }
  /** Runs what may fail at what a file holds; says so, and true if it did not. */
  private async attempt(
    what: string,
    work: (current: () => boolean) => Promise<void>,
  ): Promise<boolean> {
    const ticket = ++this.opening;
    this.loading.show(what, null);
    try {
      await work(() => ticket === this.opening);
      this.messages.clearErrors();
      return true;
    } catch (error) {
      return this.fail(error instanceof Error ? error.message : String(error));
    } finally {
      if (ticket === this.opening) this.loading.hide();
      this.changed();
    }
  }

  // Frames ----------------------------------------------------------------------------------------

  private resize(): void {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (width === this.canvas.width && height === this.canvas.height) return;
    this.stage.setSize(width, height);
    this.touch();
    this.render(performance.now()); // at once: a canvas of new size is empty
  }
  private schedule(): void {
    if (this.scheduled || this.lost) return;
    this.scheduled = true;
    requestAnimationFrame((now) => {
      this.scheduled = false;
      this.render(now);
    });
  }
  private render(now: number): void {
    if (this.lost || this.stage.loaded === null) return;
    if (this.playing) {
      this.turnLight(kGoRound * Math.min(0.1, (now - this.lastFrame) / 1000), 0);
      this.lastFrame = now;
    }
    const began = performance.now();
    if (this.moved) {
      this.moved = false;
      this.stage.apply(this.view, this.unlit);
      this.stage.drawMoving(this.camera());
      this.graph.add(now, performance.now() - began);
    } else if (!this.done && began - this.lastChange >= kStillAfter) {
      this.done = this.stage.refine(this.camera(), this.view.samples);
    }
    this.sky.show(this.view, this.stage.environment, this.disc);
    for (const resolve of this.drawing.splice(0)) requestAnimationFrame(() => resolve());
    if (!this.done || this.moved) return this.schedule();
    for (const resolve of this.waiting.splice(0)) resolve();
  }
  /** Resolves once the next frame is on the screen. */
  drawn(): Promise<void> {
    return new Promise((resolve) => {
      this.drawing.push(resolve);
      this.schedule();
    });
  }
  /** Resolves once all samples of a still picture are shown. */
  settled(): Promise<void> {
    if (this.done && !this.moved) return Promise.resolve();
    return new Promise((resolve) => {
      this.waiting.push(resolve);
      this.schedule();
    });
  }

  /** After the browser gave the context back: everything on the GPU is made anew. */
  private async restore(): Promise<void> {
    const environment = this.stage.environment?.source ?? this.view.environment.source;
    this.stage.dispose();
    const { air } = this.stage;
    this.stage = new Stage(this.canvas);
    this.stage.air = air;
    this.stage.setSize(this.canvas.width, this.canvas.height);
    this.lost = false;
    const view = structuredClone(this.view);
    view.environment.source = environment;
    if (this.asset >= 0) await this.openAsset(this.asset, view);
  }

  // For the controls and for tests ----------------------------------------------------------------

  get current(): Stage {
    return this.stage;
  }
  /** The picture as it is shown, once it is still. */
  async picture(): Promise<Blob> {
    this.play(false);
    await this.settled();
    this.stage.show(); // the canvas is read within the task that drew it
    return new Promise((resolve, reject) =>
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture")))),
    );
  }
  centre(): Vector3 {
    return this.stage.extent().centre;
  }
}
