// All that a viewer shows, as values, and its JSON: the same as lambent/view/view_state.h, so that
// a view set up here can be shown by the native viewer, by `lambent render --view` and by the path
// tracer.
import type { ToneCurve, TransferChoice, WindowName } from "three-lambent";

export type Triple = [number, number, number];
/** x, y, z, w; of length 1. */
export type Rotation = [number, number, number, number];

export interface LookAt {
  position: Triple;
  target: Triple;
  up: Triple;
  /** Degrees; not used if orthographic. */
  verticalFov: number;
  /** Metres; null: a perspective. */
  orthographicHalfHeight: number | null;
}

/** A disc of light, in the world: it does not turn with the environment. */
export interface DiscState {
  /** Degrees from +x towards +z. */
  azimuth: number;
  /** Degrees above the horizon. */
  elevation: number;
  /** Degrees. */
  diameter: number;
  /** Linear, W m⁻² sr⁻¹. */
  radiance: Triple;
}

/** The air of the environment's sky, before what is seen. */
export interface AirShown {
  /** Metres in one unit of the world. */
  metresPerUnit: number;
  /** Of light, under a Sun whose shadows are sharp. */
  shafts: boolean;
}

export interface ViewState {
  /** null: the file's first camera, or one that frames everything. */
  camera: LookAt | null;
  object: { rotation: Rotation; translation: Triple };
  environment: { source: string; rotation: Rotation };
  discs: DiscState[];
  /** auto: glossy lobes are softened, not the light. Without a width: as many bands as it has. */
  window: WindowName | "auto" | "hann" | "lanczos";
  transfer: TransferChoice;
  /** Of the light's Sun, if it has one: on diffuse surfaces. */
  sunShadow: "sharp" | "soft";
  /** null: nothing lies between camera and things. */
  air: AirShown | null;
  macro: boolean;
  viewDependent: boolean;
  /** Exponent of glossy lobes; null: the materials'. */
  lobe: number | null;
  /** EV. */
  exposure: number;
  tone: ToneCurve;
  background: boolean;
  /** Per pixel, once nothing moves. */
  samples: number;
}

export const kTransfers: readonly TransferChoice[] = [
  "best",
  "unshadowed",
  "shadowed",
  "interreflected",
];

export function defaultView(): ViewState {
  return {
    camera: null,
    object: { rotation: [0, 0, 0, 1], translation: [0, 0, 0] },
    environment: { source: "uniform:1", rotation: [0, 0, 0, 1] },
    discs: [],
    window: "auto",
    transfer: "best",
    sunShadow: "sharp",
    air: null,
    macro: true,
    viewDependent: true,
    lobe: null,
    exposure: 0,
    tone: "filmic",
    background: true,
    samples: 16,
  };
}

export function viewToJson(view: ViewState): string {
  return JSON.stringify({ lambent: "view", version: 1, ...view }, null, 2) + "\n";
}

/** Reads members one by one; the first that is wrong is an Error that names it. */
class Reader {
  constructor(private readonly name: string) {}

  fail(member: string, what: string): never {
    throw new Error(`${this.name}: "${member}" ${what}`);
  }
  object(value: unknown, member: string): Record<string, unknown> {
    if (typeof value !== "object" || value === null || Array.isArray(value))
      this.fail(member, "is not an object {…}");
    return value as Record<string, unknown>;
  }
  number(value: unknown, member: string, least = -1e30, most = 1e30): number {
    if (typeof value !== "number" || !Number.isFinite(value)) this.fail(member, "is not a number");
    if (value < least || value > most)
      this.fail(member, `is ${value}; it must be from ${least} to ${most}`);
    return value;
  }
  numbers(value: unknown, member: string, count: number, least = -1e30): number[] {
    if (!Array.isArray(value) || value.length !== count)
      this.fail(member, `is not a list of ${count} numbers`);
    return value.map((each, i) => this.number(each, `${member}[${i}]`, least));
  }
  triple(value: unknown, member: string, least = -1e30): Triple {
    return this.numbers(value, member, 3, least) as Triple;
  }
  rotation(value: unknown, member: string): Rotation {
    const q = this.numbers(value, member, 4);
    const length = Math.hypot(...q);
    if (!(Math.abs(length - 1) <= 0.01))
      this.fail(member, `has length ${length.toPrecision(4)}; a rotation is a quaternion ` +
        "[x, y, z, w] of length 1");
    return q.map((each) => each / length) as Rotation;
  }
  flag(value: unknown, member: string): boolean {
    if (typeof value !== "boolean") this.fail(member, "is not true or false");
    return value;
  }
  word<T extends string>(value: unknown, member: string, words: readonly T[]): T {
    if (!words.includes(value as T))
      this.fail(member, `must be one of ${words.map((word) => `"${word}"`).join(", ")}`);
    return value as T;
  }
  window(value: unknown): ViewState["window"] {
    const match = typeof value === "string" && /^(auto|none|minimal|(hann|lanczos)(:(.+))?)$/.exec(value);
    if (!match || (match[4] !== undefined && !(Number(match[4]) > 0)))
      this.fail("window", "must be auto, none, minimal, hann:WIDTH or lanczos:WIDTH");
    return value as ViewState["window"];
  }
  camera(value: unknown): LookAt | null {
    if (value === null) return null;
    const json = this.object(value, "camera");
    const look: LookAt = {
      position: [0, 0, 3],
      target: [0, 0, 0],
      up: [0, 1, 0],
      verticalFov: 40,
      orthographicHalfHeight: null,
    };
    for (const key of ["position", "target", "up"] as const)
      if (json[key] !== undefined) look[key] = this.triple(json[key], `camera.${key}`);
    if (json.verticalFov !== undefined)
      look.verticalFov = this.number(json.verticalFov, "camera.verticalFov", 0.01, 179);
    const half = json.orthographicHalfHeight;
    if (half !== undefined && half !== null)
      look.orthographicHalfHeight = this.number(half, "camera.orthographicHalfHeight", 1e-12);
    const sight = look.target.map((each, i) => each - look.position[i]!) as Triple;
    const length = Math.hypot(...sight);
    if (!(length > 0)) this.fail("camera.target", "is where the camera is: it looks nowhere");
    const [a, b] = [sight, look.up];
    const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
      a[0] * b[1] - a[1] * b[0]);
    if (!(cross > 1e-6 * length * Math.hypot(...look.up)))
      this.fail("camera.up", "is zero or lies along the line of sight: choose another");
    return look;
  }
  air(value: unknown): AirShown | null {
    if (value === null) return null;
    const json = this.object(value, "air");
    const { metresPerUnit = 1, shafts = false } = json;
    return {
      metresPerUnit: this.number(metresPerUnit, "air.metresPerUnit", 1e-6, 1e6),
      shafts: this.flag(shafts, "air.shafts"),
    };
  }
  disc(value: unknown, member: string): DiscState {
    const json = this.object(value, member);
    const given = (key: string, standard: number, least: number, most: number) =>
      json[key] === undefined ? standard : this.number(json[key], `${member}.${key}`, least, most);
    return {
      azimuth: given("azimuth", 0, -36000, 36000),
      elevation: given("elevation", 45, -90, 90),
      diameter: given("diameter", 20, 1e-6, 360),
      radiance:
        json.radiance === undefined
          ? [1, 1, 1]
          : this.triple(json.radiance, `${member}.radiance`, 0),
    };
  }
}

/**
 * A view from JSON. A member that is missing has the value it has in `base`; one that is unknown is
 * passed over. Throws an Error that names the member.
 */
export function parseView(json: unknown, name: string, base = defaultView()): ViewState {
  const reader = new Reader(name);
  if (typeof json !== "object" || json === null || (json as { lambent?: unknown }).lambent !== "view")
    throw new Error(`${name}: JSON, but not a saved view: "lambent": "view" is missing`);
  const from = json as Record<string, unknown>;
  if (from.version !== undefined && from.version !== 1)
    reader.fail("version", `is ${String(from.version)}; this page reads version 1`);

  const view = structuredClone(base);
  if (from.camera !== undefined) view.camera = reader.camera(from.camera);
  if (from.object !== undefined) {
    const object = reader.object(from.object, "object");
    if (object.rotation !== undefined)
      view.object.rotation = reader.rotation(object.rotation, "object.rotation");
    if (object.translation !== undefined)
      view.object.translation = reader.triple(object.translation, "object.translation");
  }
  if (from.environment !== undefined) {
    const environment = reader.object(from.environment, "environment");
    if (environment.source !== undefined) {
      const { source } = environment;
      if (typeof source !== "string" || source === "")
        return reader.fail("environment.source", "is not text");
      view.environment.source = source;
    }
    if (environment.rotation !== undefined)
      view.environment.rotation = reader.rotation(environment.rotation, "environment.rotation");
  }
  if (from.discs !== undefined) {
    if (!Array.isArray(from.discs)) return reader.fail("discs", "is not a list");
    view.discs = from.discs.map((disc, i) => reader.disc(disc, `discs[${i}]`));
  }
  if (from.window !== undefined) view.window = reader.window(from.window);
  if (from.transfer !== undefined)
    view.transfer = reader.word(from.transfer, "transfer", kTransfers);
  if (from.sunShadow !== undefined)
    view.sunShadow = reader.word(from.sunShadow, "sunShadow", ["sharp", "soft"] as const);
  if (from.air !== undefined) view.air = reader.air(from.air);
  if (from.macro !== undefined) view.macro = reader.flag(from.macro, "macro");
  if (from.viewDependent !== undefined)
    view.viewDependent = reader.flag(from.viewDependent, "viewDependent");
  if (from.lobe !== undefined)
    view.lobe = from.lobe === null ? null : reader.number(from.lobe, "lobe", 0, 1e5);
  if (from.exposure !== undefined)
    view.exposure = reader.number(from.exposure, "exposure", -60, 60);
  if (from.tone !== undefined)
    view.tone = reader.word(from.tone, "tone", ["filmic", "linear"] as const);
  if (from.background !== undefined) view.background = reader.flag(from.background, "background");
  if (from.samples !== undefined) {
    view.samples = reader.number(from.samples, "samples", 1, 4096);
    if (!Number.isInteger(view.samples)) reader.fail("samples", "must be a whole number");
  }
  return view;
}
