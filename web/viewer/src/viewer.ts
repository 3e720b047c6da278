// What is shown and how it changes: the view, and what is opened for it.
import { Vector3 } from "three";
import { kMostDiscs } from "three-lambent";
import { azimuthElevationOf, kRadians } from "./directions";
import { loadEnvironment, type LoadedEnvironment, type ReadFile } from "./environments";
import { Frames } from "./frames";
import { listen } from "./gestures";
import { Library, type Opened } from "./library";
import { freeAsset, loadAsset } from "./load_asset";
import { LoadingBar, messageOf, Messages } from "./messages";
import { orbit, pan, turnEnvironment, turnObject, zoom, type Grip } from "./orbit";
import { kNoOverlays, kOverlays, type MakeMarks, type Overlay } from "./overlays";
import { progressiveRead } from "./read_url";
import { SkyLight } from "./sky_light";
import { Stage } from "./stage";
import {
  defaultView, parseView, type DiscState, type LookAt, type Triple, type ViewState,
} from "./view_state";

const kRadiansPerPixel = 0.008;
const kGoRound = 0.35; // radians a second
/** Width over height that the manifest's views leave nothing out at. */
const kViewsMadeFor = 1.15;

export class Viewer {
  readonly messages = new Messages();
  readonly loading = new LoadingBar();
  readonly library = new Library((address) => progressiveRead(address, this.loading));
  readonly sky = new SkyLight(this);
  view: ViewState = defaultView();
  asset = -1;
  disc = -1;
  grip: Grip = "camera";
  playing = false;
  unlit = false;
  /** What is shown of how a patch lies. */
  overlays = kNoOverlays;
  /** What draws them; null: seams alone are shown. */
  makeMarks: MakeMarks | null = null;
  /** Called after anything changed that controls show. */
  changed: () => void = () => {};
  /** Called after each frame; as {@link Picture.drawn} says. */
  readonly framed = new Set<(now: number, work: number | null) => void>();

  private stage: Stage;
  private readonly frames = new Frames({
    ready: () => !this.lost && this.stage.loaded !== null,
    advance: (seconds) => {
      if (this.playing) this.turnLight(kGoRound * seconds, 0);
      return this.playing;
    },
    drawMoving: () => {
      this.stage.apply(this.view, this.unlit, this.overlays, this.makeMarks);
      this.stage.drawMoving(this.camera());
    },
    refine: () => this.stage.refine(this.camera(), this.view.samples),
    drawn: (now, work) => this.framed.forEach((each) => each(now, work)),
  });
  private readonly ended = new AbortController();
  private opening = 0;
  private lost = false;

  /** Throws where the browser gives no WebGL 2. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas);
    const sizes = new ResizeObserver(() => this.resize());
    sizes.observe(canvas);
    const unlisten = listen(canvas, {
      grip: () => this.grip,
      drag: (grip, x, y) => this.drag(grip, kRadiansPerPixel * x, kRadiansPerPixel * y),
      pan: (x, y) => this.pan(x, y),
      zoom: (factor) => this.zoom(factor),
      click: () => {},
      doubleClick: () => this.frame(),
    });
    const { signal } = this.ended;
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.lost = true;
      this.messages.error(
        "The browser took the graphics context away; the picture comes back when it returns it.",
      );
    }, { signal });
    canvas.addEventListener("webglcontextrestored", () => void this.restore(), { signal });
    signal.addEventListener("abort", () => (sizes.disconnect(), unlisten()));
  }
  /** Nothing is shown any more; the GPU holds nothing of it. */
  end(): void {
    ++this.opening;
    this.ended.abort();
    this.frames.stop();
    this.stage.end();
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
  /** Shows again what may have changed. */
  touch(): void {
    this.frames.touch();
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
    const own = this.library.assets[this.asset]?.view;
    const { source } = this.view.environment;
    this.view = this.viewOf(own);
    this.view.environment.source = source;
    this.disc = -1;
    this.unlit = false;
    this.overlays = kNoOverlays;
    this.sky.expose(this.view);
    this.play(false);
  }
  /** Lets the light go round, or stops it. */
  play(on: boolean): void {
    if (on && stillness().matches) {
      this.messages.note(
        "The light stays where it is: this browser asks for reduced motion. " +
          "Shift + drag turns it.");
      on = false;
    }
    this.playing = on;
    this.frames.begin();
    this.changed();
  }
  /** Base colours instead of light: to see what the light does. */
  setUnlit(on: boolean): void {
    this.unlit = on;
    this.touch();
  }
  /** Shows how a patch lies, in one of the ways there are; all at once, or none, if none is named. */
  setOverlay(which: Overlay | null, on: boolean): void {
    const changed = (which === null ? kOverlays : [which]).map((each) => [each, on]);
    this.overlays = { ...this.overlays, ...Object.fromEntries(changed) };
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

  // What is opened --------------------------------------------------------------------------------

  /**
   * Shows an asset of the library, or one that comes to it. What cannot be shown says why, and the
   * old one stays. `view`: what is shown of it; else what suits it, and the light that there is.
   */
  async open(opened: Opened, view?: ViewState): Promise<boolean> {
    return this.attempt(`Loading ${opened.name}`, async (current) => {
      const next = view ?? this.viewOf(opened.view, this.asset < 0 ? undefined : this.view);
      const { stage } = this;
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
        if (asset.status === "fulfilled") freeAsset(asset.value);
        if (light.status === "fulfilled") light.value?.dispose();
        for (const each of [asset, light]) if (each.status === "rejected") throw each.reason;
        return;
      }
      if (light.value !== null) stage.setEnvironment(light.value);
      stage.setAsset(asset.value);
      this.asset = this.library.indexOf(opened);
      if (this.asset < 0) this.asset = this.library.assets.push(opened) - 1;
      this.view = next;
      if (view !== undefined) this.sky.opened();
      this.disc = Math.min(this.disc, next.discs.length - 1);
      this.touch();
      await this.sky.fetchAir();
      await this.frames.drawn();
      const errors = stage.shaderErrors();
      if (errors !== null)
        throw new Error(`The graphics driver cannot draw ${opened.name}: ${errors}`);
    });
  }
  openAsset(index: number, view?: ViewState): Promise<boolean> {
    return this.open(this.library.assets[index]!, view);
  }
  /** Shows a SOURCE in place of the light there is; `name` is what it is called while it loads. */
  async openSource(source: string, name = source): Promise<boolean> {
    return this.attempt(`Loading ${name}`, async () => {
      this.sky.giveUp();
      await this.useEnvironment(source);
      this.change((view) => {
        this.sky.leave(view);
        view.environment.source = source;
      });
    });
  }
  /** Shows an environment of the library. */
  openEnvironment(index: number): Promise<boolean> {
    const { name, source } = this.library.environments[index]!;
    return this.openSource(source, name);
  }
  /** Shows a saved view. */
  async openView(json: unknown, name: string): Promise<boolean> {
    return this.attempt(`Reading ${name}`, async () => {
      const view = parseView(json, name);
      if (view.discs.length > kMostDiscs)
        this.messages.note(`Mirrors and the background show the first ${kMostDiscs} discs alone.`);
      await this.setView(view);
      this.sky.opened();
      this.disc = -1;
      this.touch();
      this.sky.noteAir();
    });
  }
  /** Shows an asset as a view has it; the one there is, if none is named. */
  show(view: ViewState, opened?: Opened): Promise<boolean> {
    const index = opened === undefined ? this.asset : this.library.indexOf(opened);
    if (index >= 0 && index !== this.asset) return this.openAsset(index, view);
    return this.attempt("Loading", () => this.setView(view));
  }
  private async setView(view: ViewState): Promise<void> {
    this.sky.giveUp();
    await this.useEnvironment(view.environment.source);
    this.view = view;
    this.disc = Math.min(this.disc, view.discs.length - 1);
    this.touch();
    await this.sky.fetchAir();
  }
  /** Dropped or picked: an asset, a light, or a saved view, by the file's name and content. */
  async openFile(file: File): Promise<boolean> {
    const { name } = file;
    const read = () => file.arrayBuffer();
    if (/\.gltf$/i.test(name))
      return this.fail(`${name}: the page opens .glb, which holds everything in one file.`);
    if (/\.glb$/i.test(name)) return this.openGiven({ name, read, origin: "file" });
    if (/\.json$/i.test(name)) {
      let json: unknown;
      try {
        json = JSON.parse(await file.text());
      } catch {
        return this.fail(`${name}: not JSON. The page reads saved views and lights.`);
      }
      if ((json as { lambent?: unknown } | null)?.lambent === "view")
        return this.openView(json, name);
    } else if (!/\.(hdr|exr|png|jpe?g)$/i.test(name)) {
      return this.fail(
        `${name}: the page opens .glb, .hdr, .exr, .png, and saved views and lights as .json.`,
      );
    }
    return this.openLight(name, read);
  }
  /** Takes the place of a file of the same name that was opened before. */
  private async openGiven(opened: Opened): Promise<boolean> {
    const { assets } = this.library;
    const index = assets.findIndex((each) => each.name === opened.name && each.origin === "file");
    if (index < 0) return this.open(opened);
    const before = assets[index]!;
    assets[index] = opened;
    if (await this.openAsset(index)) return true;
    assets[index] = before;
    this.changed();
    return false;
  }
  private openLight(name: string, read: ReadFile): Promise<boolean> {
    const { library } = this;
    return library.withLight(name, read, () =>
      this.attempt(`Reading ${name}`, async () => {
        await this.useEnvironment(name, true);
        if (!library.environments.some((each) => each.source === name))
          library.environments.push({ name, source: name, files: {} });
        this.change((view) => (view.environment.source = name));
      }));
  }

  /** As an asset is shown where nothing was shown before. */
  firstView(opened: Opened): ViewState {
    return this.viewOf(opened.view);
  }
  /** A view that suits an asset: what the manifest says of it, and of the last view what is not of
   * the old object. */
  private viewOf(members?: Record<string, unknown>, last?: ViewState): ViewState {
    const base = defaultView();
    if (last !== undefined)
      Object.assign(base, structuredClone(last), { camera: null, object: defaultView().object });
    else base.environment.source = this.library.firstSource();
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
    return loadEnvironment(source, this.library, this.stage.floatTextures);
  }
  private async useEnvironment(source: string, anew = false): Promise<void> {
    if (!anew && this.stage.environment?.source === source) return;
    const { stage } = this;
    const loaded = await loadEnvironment(source, this.library, stage.floatTextures);
    if (this.ended.signal.aborted) return loaded.dispose();
    this.stage.setEnvironment(loaded);
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
      // What came after has its own to say.
      if (ticket === this.opening) this.messages.clearErrors();
      return true;
    } catch (error) {
      return this.fail(messageOf(error));
    } finally {
      if (ticket === this.opening) this.loading.hide();
      this.changed();
    }
  }

  // The canvas ------------------------------------------------------------------------------------

  private resize(): void {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (this.lost || (width === this.canvas.width && height === this.canvas.height)) return;
    this.stage.setSize(width, height);
    this.touch();
    this.frames.render(performance.now()); // at once: a canvas of new size is empty
  }
  /** After the browser gave the context back: everything on the GPU is made anew. */
  private async restore(): Promise<void> {
    const environment = this.stage.environment?.source ?? this.view.environment.source;
    this.stage.dispose();
    const { air } = this.stage;
    this.stage = new Stage(this.canvas);
    this.stage.air = air;
    this.lost = false;
    this.stage.setSize(this.canvas.width, this.canvas.height);
    const view = structuredClone(this.view);
    view.environment.source = environment;
    if (this.asset >= 0) await this.openAsset(this.asset, view);
  }

  // For the controls and for tests ----------------------------------------------------------------

  get current(): Stage {
    return this.stage;
  }
  drawn(): Promise<void> {
    return this.frames.drawn();
  }
  settled(): Promise<void> {
    return this.frames.settled();
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
}

/** Whether nothing is to move by itself. */
export const stillness = (): MediaQueryList => matchMedia("(prefers-reduced-motion: reduce)");
