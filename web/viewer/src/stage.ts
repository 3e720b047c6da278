// The picture: an asset, its light and its surroundings, drawn when something changed and refined
// while nothing does.
import {
  Box3,
  Object3D,
  OrthographicCamera,
  PerspectiveCamera,
  Quaternion,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
  type Camera,
} from "three";
import {
  EnvironmentBackground,
  LambentLight,
  ToneMapper,
  type AerialPerspective,
  type LambentAir,
  type Sky,
  fitClipping,
  frameAutomatically,
  kMostDiscs,
  subpixelPositions,
  sunOf,
  type DirectionLike,
  type Disc,
  type Environment,
} from "three-lambent";
import { Accumulator } from "./accumulator";
import { directionFromAzimuthElevation, kRadians } from "./directions";
import type { LoadedEnvironment } from "./environments";
import type { LoadedAsset } from "./load_asset";
import {
  anyOf, kNoOverlays, kSeamColor, type MakeMarks, type Marks, type Overlays,
} from "./overlays";
import type { LookAt, Triple, ViewState } from "./view_state";

/** Frames of a new picture that are added up before they take the place of the last one. */
const kFirstShown = 4;

export class Stage {
  readonly renderer: WebGLRenderer;
  /** Whether 32-bit textures can be filtered. */
  readonly floatTextures: boolean;
  loaded: LoadedAsset | null = null;
  environment: LoadedEnvironment | null = null;
  /** What air is made with; null: the page has not fetched it. */
  air: LambentAir | null = null;

  private readonly scene = new Scene();
  /** Of how the asset's patch lies; null: nobody has asked for any. */
  marks: Marks | null = null;
  private overlays = kNoOverlays;
  /** Of a colour that the picture is to show as it is. */
  private brightness = 1;
  private readonly perspective = new PerspectiveCamera();
  private readonly orthographic = new OrthographicCamera();
  private readonly background = new EnvironmentBackground();
  private readonly tone = new ToneMapper();
  private readonly accumulator: Accumulator;
  private size = new Vector2(1, 1);
  private light = new LambentLight(1);
  private shownAir: { sky: Sky; air: AerialPerspective } | null = null;
  // Found by a look at every vertex: once for an asset, not once a frame.
  private measured: { diagonal: number; centre: Vector3 } | null = null;
  private framed: { aspect: number; camera: LookAt } | null = null;

  /** Throws where the browser gives no WebGL 2. */
  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: false,
      alpha: false,
      depth: false,
      stencil: false,
      powerPreference: "high-performance",
    });
    // Asking each program for its errors would make the driver compile one after the other;
    // shaderErrors() asks once all are on their way.
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.setClearColor(0x000000, 0);
    const extensions = this.renderer.getContext();
    this.floatTextures = extensions.getExtension("OES_texture_float_linear") !== null;
    const float32 = extensions.getExtension("EXT_color_buffer_float") !== null;
    this.accumulator = new Accumulator(1, 1, float32);
    this.scene.add(this.background);
  }

  /** Pixels of the canvas itself. */
  setSize(width: number, height: number): void {
    this.size.set(width, height);
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.accumulator.setSize(width, height);
  }
  get aspect(): number {
    return this.size.x / this.size.y;
  }

  setAsset(loaded: LoadedAsset | null): void {
    if (this.loaded !== null) {
      this.background.setAsset(null);
      this.scene.remove(this.loaded.root);
      if (this.marks) this.scene.remove(this.marks.object);
      this.marks?.dispose();
      this.marks = null;
      this.loaded.asset?.dispose();
      this.loaded.plain?.dispose(this.scene);
    }
    this.loaded = loaded;
    this.measured = this.framed = null;
    if (loaded !== null) this.scene.add(loaded.root);
  }
  setEnvironment(environment: LoadedEnvironment | null): void {
    if (this.environment !== environment) this.environment?.dispose();
    this.environment = environment;
    if (this.shownAir && this.shownAir.sky !== environment?.sky) this.dropAir();
  }

  /** Length of the asset's bounding box's diagonal, metres, and its middle in its own frame. */
  extent(): { diagonal: number; centre: Vector3 } {
    if (this.loaded === null) return { diagonal: 1, centre: new Vector3() };
    if (this.measured === null) {
      const box = this.inOwnFrame((root) => new Box3().setFromObject(root));
      this.measured = {
        diagonal: Math.max(box.getSize(new Vector3()).length(), 1e-6),
        centre: box.getCenter(new Vector3()),
      };
    }
    return this.measured;
  }

  /** The camera of a view that names none: the file's first, or one that frames the asset. */
  standardCamera(): LookAt {
    if (this.framed?.aspect === this.aspect) return this.framed.camera;
    const { centre } = this.extent();
    let camera: Camera | undefined = this.loaded?.cameras[0];
    if (camera === undefined) {
      const automatic = new PerspectiveCamera();
      if (this.loaded !== null)
        this.inOwnFrame((root) => frameAutomatically(root, automatic, this.aspect));
      else automatic.position.set(0, 0, 3);
      camera = automatic;
    }
    this.framed = { aspect: this.aspect, camera: lookAtOf(camera, centre) };
    return this.framed.camera;
  }

  private inOwnFrame<T>(work: (root: Object3D) => T): T {
    const { root } = this.loaded!;
    const [position, rotation] = [root.position.clone(), root.quaternion.clone()];
    root.position.set(0, 0, 0);
    root.quaternion.identity();
    root.updateWorldMatrix(true, true);
    try {
      return work(root);
    } finally {
      root.position.copy(position);
      root.quaternion.copy(rotation);
      root.updateWorldMatrix(true, true);
    }
  }

  /** What a view says about the object and its light. Costs no time that grows with the asset. */
  apply(
    view: ViewState,
    unlit = false,
    overlays: Overlays = kNoOverlays,
    makeMarks: MakeMarks | null = null,
  ): void {
    this.overlays = overlays;
    this.brightness = 2 ** -view.exposure;
    this.tone.exposure = view.exposure;
    this.tone.curve = view.tone;
    const discs: Disc[] = view.discs.map((disc) => ({
      direction: directionFromAzimuthElevation(disc.azimuth * kRadians, disc.elevation * kRadians),
      diameter: disc.diameter * kRadians,
      radiance: disc.radiance,
    }));
    const turn = new Quaternion(...view.environment.rotation);
    const bands = this.loaded?.asset?.info.bands ?? 5;
    this.light =
      this.environment?.light(bands).clone().rotate(turn) ?? new LambentLight(bands);
    for (const disc of discs) this.light.addDisc(disc);
    const { window } = view;
    const weights = this.light.windowWeights(
      window === "auto" ? "none" : window === "hann" || window === "lanczos" ? `${window}:${bands}` : window,
    );
    this.light.attenuate(weights);

    const turned = ({ x, y, z }: DirectionLike) => new Vector3(x, y, z).applyQuaternion(turn);
    const dome = this.environment?.sky?.dome;
    const allDiscs = [
      ...(this.environment?.discs ?? []).map((disc) => ({
        ...disc,
        direction: turned(disc.direction),
        ...(disc.horizon && { horizon: { ...disc.horizon, up: turned(disc.horizon.up) } }),
      })),
      ...discs,
    ];
    const seen: Environment = {
      texture: this.environment?.texture ?? null,
      rotation: turn,
      uniform: this.environment?.uniform ?? [0, 0, 0],
      discs: allDiscs.slice(0, kMostDiscs),
      sky: dome
        ? { ...dome, rotation: turn.clone().multiply(new Quaternion().copy(dome.rotation as Quaternion)) }
        : null,
    };
    this.background.setEnvironment(seen);
    this.background.visible = view.background;

    if (this.loaded === null) return;
    const { asset, plain, root } = this.loaded;
    root.position.set(...view.object.translation);
    root.quaternion.set(...view.object.rotation);
    plain?.light(this.renderer, this.scene, seen, this.environment);
    if (asset === null) return;
    asset.transfer = view.transfer;
    asset.macro = view.macro;
    asset.viewDependent = view.viewDependent;
    asset.lobeExponent = view.lobe;
    asset.softLobes = window === "auto";
    asset.unlit = unlit;
    const [red, green, blue] = kSeamColor.map((each) => each * this.brightness) as Triple;
    asset.seams = overlays.seams ? [red, green, blue] : null;
    asset.setLight(this.light);
    asset.setSun(view.sunShadow === "sharp" ? sunOf(allDiscs) : null, weights);
    asset.setEnvironment(seen);
    asset.setAir(view.air && this.airOfSky(), { ...view.air, rotation: turn });
    this.background.setAsset(asset);
    if (this.marks || !makeMarks || !anyOf(overlays) || !asset.kinds.has("bi-scale")) return;
    this.marks = makeMarks(asset);
    this.scene.add(this.marks.object);
  }

  private airOfSky(): AerialPerspective | null {
    const sky = this.environment?.sky;
    if (!sky || !this.air) return null;
    this.shownAir ??= { sky, air: this.air.under(sky) };
    return this.shownAir.air;
  }
  private dropAir(): void {
    this.loaded?.asset?.setAir(null);
    this.shownAir?.air.dispose();
    this.shownAir = null;
  }

  private cameraOf(look: LookAt): PerspectiveCamera | OrthographicCamera {
    const half = look.orthographicHalfHeight;
    const camera = half === null ? this.perspective : this.orthographic;
    camera.position.set(...look.position);
    camera.up.set(...look.up);
    camera.lookAt(new Vector3(...look.target));
    if (half === null) {
      this.perspective.fov = look.verticalFov;
      this.perspective.aspect = this.aspect;
    } else {
      [this.orthographic.top, this.orthographic.bottom] = [half, -half];
      [this.orthographic.right, this.orthographic.left] = [half * this.aspect, -half * this.aspect];
    }
    fitClipping(camera, this.loaded?.root ?? new Object3D());
    return camera;
  }

  private draw(look: LookAt, place: readonly [number, number], samples: number): void {
    const { x: width, y: height } = this.size;
    const camera = this.cameraOf(look);
    camera.setViewOffset(width, height, place[0] - 0.5, place[1] - 0.5, width, height);
    const asset = this.loaded?.asset;
    if (asset) {
      asset.samples = samples;
      asset.sample = this.accumulator.count;
      asset.update(this.renderer, camera);
      this.marks?.show(this.overlays, this.brightness, width, height);
    }
    this.renderer.setRenderTarget(this.accumulator.frame);
    this.renderer.clear();
    this.renderer.render(this.scene, camera);
    this.accumulator.add(this.renderer);
  }

  /** One frame of something that moves, onto the canvas. */
  drawMoving(look: LookAt): void {
    this.accumulator.reset();
    this.draw(look, [0.5, 0.5], 1);
    this.tone.render(this.renderer, this.accumulator.mean);
    this.accumulator.reset();
  }

  /** What the driver has against the shaders in use; null: nothing. */
  shaderErrors(): string | null {
    const gl = this.renderer.getContext();
    if (gl.isContextLost()) return null;
    for (const { program, name } of this.renderer.info.programs ?? [])
      if (program && !gl.getProgramParameter(program as WebGLProgram, gl.LINK_STATUS))
        return `${name}: ${gl.getProgramInfoLog(program as WebGLProgram) ?? "no reason given"}`;
    return null;
  }

  /** One more sample of a still picture; true once it has all of them. */
  refine(look: LookAt, samples: number): boolean {
    const done = this.accumulator.count;
    if (done >= samples) return true;
    this.draw(look, subpixelPositions(samples)[done]!, samples);
    if (done + 1 >= Math.min(kFirstShown, samples))
      this.tone.render(this.renderer, this.accumulator.mean);
    return done + 1 >= samples;
  }

  /** Shows what is there again, after exposure or tone changed. */
  show(): void {
    this.tone.render(this.renderer, this.accumulator.mean);
  }

  dispose(): void {
    this.background.setAsset(null);
    this.setAsset(null);
    this.setEnvironment(null);
    this.background.dispose();
    this.accumulator.dispose();
    this.tone.dispose();
    this.renderer.dispose();
  }
  /** Gives the canvas's context back as well: browsers have a few alone. Nothing is drawn again. */
  end(): void {
    this.dispose();
    this.renderer.forceContextLoss();
  }
}

/** A camera as a place and a target: on its axis, nearest to `centre`. */
function lookAtOf(camera: Camera, centre: Vector3): LookAt {
  camera.updateWorldMatrix(true, false);
  const position = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  const forward = new Vector3(0, 0, -1).transformDirection(camera.matrixWorld);
  const up = new Vector3(0, 1, 0).transformDirection(camera.matrixWorld);
  const away = Math.max(centre.clone().sub(position).dot(forward), 1e-3);
  const target = position.clone().addScaledVector(forward, away);
  // What is level stays level when it is orbited.
  const level = Math.abs(forward.clone().cross(new Vector3(0, 1, 0)).dot(up)) < 1e-6 && up.y > 0;
  return {
    position: position.toArray() as Triple,
    target: target.toArray() as Triple,
    up: level && Math.abs(forward.y) < 0.999 ? [0, 1, 0] : (up.toArray() as Triple),
    verticalFov: camera instanceof PerspectiveCamera ? camera.fov : 40,
    orthographicHalfHeight: camera instanceof OrthographicCamera ? camera.top : null,
  };
}
