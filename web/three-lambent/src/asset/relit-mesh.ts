// One mesh of one instance of an asset: its lit transfer on the GPU, its material, and which of
// both a choice wants.

import {
  Vector3,
  Vector4,
  type CubeTexture,
  type IUniform,
  type Mesh,
  type Object3D,
  type Scene,
  type Texture,
  type WebGLRenderer,
} from "three";
import type { AssetDescription, Numbers, PrimitiveTransfer } from "../format/description.js";
import type { FullScreenPass } from "../gpu/full-screen-pass.js";
import type { LambentNodes } from "../gpu/nodes.js";
import { isNodeRenderer, type NodeRenderer } from "../gpu/renderer.js";
import { LitTexture } from "../gpu/lit-texture.js";
import { Lease } from "../gpu/shared.js";
import {
  TransferPass,
  TransferRows,
  type LightPass,
  type MatrixShape,
} from "../gpu/transfer-pass.js";
import type { Rgb } from "../light/light.js";
import { coverageUniforms, hasGaps, type Coverage } from "../materials/coverage.js";
import { incidentGroups } from "../materials/group-macros.js";
import { RelitMaterial, type RelitNodes, type RelitShaders } from "../materials/relit-material.js";
import { surfaceShaders, type SurfaceShape } from "../materials/relit-shaders.js";
import { kNoAir, type AirMode, type Surroundings } from "../materials/surroundings.js";
import { bandOf } from "../sh/basis.js";
import { shownLobe } from "../sh/lobe.js";
import type { AssetAir } from "./asset-air.js";
import type { AssetSource } from "./asset-source.js";
import { kindOf, type TransferChoice } from "./choices.js";
import type { MeshSource } from "./mesh-source.js";
import type { Mirrors } from "./mirrors.js";
import { kindWithoutBounces } from "./sharp-sun.js";

/** What somebody wants to see. */
export interface Choices {
  transfer: TransferChoice;
  macro: boolean;
  viewDependent: boolean;
  filter: boolean;
  lobeExponent: number | null;
  softLobes: boolean;
  unlit: boolean;
  /** Radiance of the lines where pieces of a patch meet. */
  seams: Rgb | null;
  samples: number;
  sample: number;
  /** There is a Sun whose shadows are sharp. */
  sun: boolean;
  air: AirMode;
  /** Mirrors see the asset. */
  captured: boolean;
}

/**
 * [coefficient][3], in the asset's frame: of all light, of a sharp Sun's share, of the rest, and of what
 * lobes see.
 */
export interface Lights {
  whole: Float64Array;
  sun: Float64Array;
  withoutSun: Float64Array;
  lobes: Float64Array;
}

/** What all meshes of an instance share. */
export interface Shared {
  source: AssetSource;
  mirrors: Mirrors | null;
  /** null: there never was any. */
  air(): AssetAir | null;
  /** Of the Sun. */
  sun: Record<string, IUniform>;
  /** Before a mesh, or another one with its material, is drawn. */
  drawn(mesh: RelitMesh, scene: Scene, object: Object3D): void;
  /** After somebody else disposed of a material. */
  disposed(): void;
}

// Besides the light: position and u, normal and v, colour or tangent, diffuse radiance, depths.
const kOtherVaryings = 6;

/** Results, and what makes them. */
export interface Lit {
  texture: LitTexture;
  pass: LightPass;
  /** The lobe's moments apply. */
  glossy: boolean;
  /** For each row, besides the lobe's. */
  scales: Float32Array | null;
  light: keyof Lights;
}

export class RelitMesh {
  readonly material: RelitMaterial;
  private built = "";
  /** @internal */
  lits: Lit[] = [];
  /** @internal What of the asset it uses. */
  lease: Lease | null = null;
  /** Of the renderer that it is prepared for, if that draws by nodes. */
  private nodes: LambentNodes | null = null;
  /** Of shaders/local_capture.glsl. */
  private readonly captureUniforms = {
    capture: { value: null as CubeTexture | null },
    captureFrom: { value: new Vector3() },
    hasCapture: { value: false },
  };
  /** Of shaders/lobe.glsl. */
  private readonly lobeGain = { value: new Vector4() };
  private lobeHasHorizon = true;
  /** Whether something hides a sharp Sun from what is shown. */
  needsSunMap = false;

  /** @param mesh what is drawn: it takes geometry and material from here */
  constructor(
    readonly mesh: Mesh,
    readonly source: MeshSource,
    private readonly shared: Shared,
  ) {
    this.material = RelitMaterial.of(source.original, source.culled);
    this.material.drawn = (scene, object) => shared.drawn(this, scene, object);
    this.material.disposed = () => {
      this.forget();
      shared.disposed();
    };
    mesh.geometry = source.geometry;
    mesh.material = this.material;
    if (!source.layer) return;
    // After what it lies on, which is as deep, and after layers below it; before what is blended.
    mesh.renderOrder = 1 + source.number;
    this.material.transparent = false;
  }

  get transfer(): PrimitiveTransfer | null {
    return this.source.transfer;
  }

  get coverage(): Coverage {
    return this.source.coverage;
  }

  get isMirror(): boolean {
    return this.source.isMirror;
  }

  /** Whether anything of it is on the GPU. */
  get isBuilt(): boolean {
    return this.built !== "";
  }

  /** @internal */
  get description(): AssetDescription {
    return this.shared.source.description;
  }

  /** Makes what the choices need, if it is not there. @returns whether light is due again */
  prepare(renderer: WebGLRenderer, choices: Choices): boolean {
    this.nodes = isNodeRenderer(renderer) ? this.shared.source.nodes : null;
    const { transfer, description } = this;
    const kind = transfer ? kindOf(description, transfer, choices.transfer) : "";
    const patch = transfer?.biScale ? `${choices.macro} ${choices.filter}` : "";
    const key = choices.unlit
      ? "unlit"
      : `${kind} ${patch} ${choices.sun} ${choices.air} ${choices.captured}`;
    const fresh = key !== this.built;
    if (fresh) {
      // What is still wanted is not made again.
      const before = this.lease;
      this.freeLits();
      this.lease = new Lease(this.shared.source.thingsOn(renderer));
      try {
        this.material.wear(this.build(renderer, choices));
      } finally {
        before?.release();
      }
      this.built = key;
    }
    const { viewDependent, seams, veil } = this.material.uniforms;
    this.material.shaders!.samples = choices.samples;
    if (viewDependent) viewDependent.value = choices.viewDependent;
    if (seams) seams.value.set(...(choices.seams ?? [0, 0, 0]), choices.seams ? 1 : 0);
    if (veil) veil.value[1] = choices.sample;
    return fresh;
  }

  private surface(
    shape: SurfaceShape,
    uniforms: Record<string, IUniform>,
  ): RelitShaders | RelitNodes {
    return this.nodes ? this.nodes.surface(shape, uniforms) : surfaceShaders(shape, uniforms);
  }

  private build(renderer: WebGLRenderer, choices: Choices): RelitShaders | RelitNodes {
    const { source, transfer, shared } = this;
    const { reflectance, map, colored, uv } = source;
    const gaps = hasGaps(source.coverage);
    const plain = { map, colored, uv, gaps };
    const covered = gaps ? coverageUniforms(source.coverage, source.number) : {};
    if (choices.unlit) {
      const uniforms = { ...covered, reflectance: { value: new Vector3(...reflectance.base) } };
      return this.surface({ kind: "unlit", ...plain }, uniforms);
    }
    if (transfer?.biScale && !source.isMirror)
      return shared.source.extras.patches!.buildPatch(this, renderer, choices);
    const [surroundings, around] = this.surroundings(choices);
    const all = { ...covered, ...around };
    if (source.isMirror) {
      const mirrors = shared.mirrors!;
      const uniforms = {
        ...all,
        ...mirrors.environment.uniforms,
        ...this.captureUniforms,
        reflectance: { value: new Vector3(...reflectance.mirror) },
      };
      const shown = mirrors.source(choices);
      return this.surface({ kind: "mirror", ...plain, surroundings, shown }, uniforms);
    }
    if (transfer && (transfer.vectors || transfer.matrices))
      return this.buildSurface(renderer, transfer, choices, surroundings, all);
    return this.surface({ kind: "black", ...plain, surroundings }, all);
  }

  /** @internal What the asset is seen through, and by. */
  surroundings({ air: mode, captured }: Choices): [Surroundings, Record<string, IUniform>] {
    const air = mode === "none" ? null : this.shared.air();
    const mirrors = captured ? this.shared.mirrors : null;
    return [
      { air: air?.source(mode) ?? kNoAir, captured: mirrors?.capturedSource ?? "" },
      { ...air?.uniforms, ...mirrors?.uniforms },
    ];
  }

  /** What a mirror shows of the asset; `from` times captureScale. null: nothing. */
  lookInto(capture: { texture: CubeTexture; from: Vector3 } | null): void {
    const { captureUniforms: u } = this;
    u.capture.value = capture?.texture ?? null;
    u.hasCapture.value = capture !== null;
    if (capture) u.captureFrom.value.copy(capture.from);
  }

  /** @internal Stored numbers, which all instances read, and what a pass makes of them here. */
  add(
    renderer: WebGLRenderer,
    what: { name: string; numbers: () => Numbers; shape: MatrixShape; rows: number },
    rest: Partial<Omit<Lit, "texture" | "pass">> = {},
    reflectance: readonly [number, number, number] = [1, 1, 1],
  ): LitTexture {
    const { key, what: mesh } = this.source;
    const { nodes } = this;
    const device = nodes
      ? { maxTextureSize: nodes.maxTextureSize(renderer as unknown as NodeRenderer), floats: true }
      : renderer.capabilities;
    const texture = new LitTexture(device, this.transfer!.receivers, what.rows, mesh);
    const stored = this.lease!.take(
      `${key} ${what.name}`,
      () => new TransferRows(what.numbers(), what.shape.columns, mesh),
    );
    const pass = nodes
      ? nodes.pass(stored, what.shape, texture, reflectance)
      : new TransferPass(stored, what.shape, texture, reflectance);
    this.lits.push({ texture, pass, glossy: false, scales: null, light: "whole", ...rest });
    return texture;
  }

  private buildSurface(
    renderer: WebGLRenderer,
    transfer: PrimitiveTransfer,
    choices: Choices,
    surroundings: Surroundings,
    uniforms: Record<string, IUniform>,
  ): RelitShaders | RelitNodes {
    const { description, source } = this;
    const { grid } = transfer;
    const kind = kindOf(description, transfer, choices.transfer);
    const unshadowed = kind === "unshadowed" && description.transfer !== "unshadowed";
    const kept = kind === "shadowed" && description.transfer !== kind;
    const from = kept ? transfer.shadowed : transfer;
    const name = unshadowed ? "unshadowed" : kept ? "shadowed" : "stored";
    const direct = choices.sun ? kindWithoutBounces(description, transfer, choices.transfer) : null;
    let albedoOutside = false;
    if (transfer.vectors && from?.vectors) {
      const stored = unshadowed ? transfer.vectors : from.vectors;
      albedoOutside = unshadowed ? source.unshadowedOutside(stored) : stored.albedoOutside;
      const channels = unshadowed ? 3 : stored.channels;
      const shape = { rows: 1, columns: stored.bands ** 2, channels };
      const numbers = () =>
        unshadowed ? source.unshadowedVectors(transfer, stored) : stored.numbers;
      const light = direct === kind ? "withoutSun" : "whole";
      const lit = this.add(
        renderer,
        { name: `${name} vectors`, numbers, shape, rows: 1 },
        { light },
      );
      uniforms.diffuseLit = { value: lit.target.texture };
      uniforms.diffuseALine = { value: lit.receiversALine };
    }
    if (direct) {
      Object.assign(uniforms, this.shared.sun, {
        sunReflectance: { value: new Vector3(...source.reflectance.diffuse) },
      });
      this.needsSunMap = direct !== "unshadowed";
    }
    const apart = direct !== null && direct !== kind;
    if (apart) uniforms.sunLit = { value: this.buildSunShare(renderer, transfer) };
    let lobeBands = 0;
    if (transfer.matrices && from?.matrices) {
      const { matrices } = from;
      lobeBands = matrices.outBands;
      const rows = lobeBands ** 2;
      const columns = matrices.inBands ** 2;
      const channels = unshadowed ? 1 : matrices.channels;
      const shape = { rows, columns, channels, shared: unshadowed };
      const numbers = () => (unshadowed ? identity(rows, columns) : matrices.numbers);
      const lit = this.add(
        renderer,
        { name: `${name} matrices`, numbers, shape, rows },
        { glossy: true, light: "lobes" },
        matrices.glossy,
      );
      uniforms.incidentLit = { value: lit.target.texture };
      uniforms.incidentALine = { value: lit.receiversALine };
      uniforms.lobeGain = this.lobeGain;
      this.lobeHasHorizon = kind !== "unshadowed";
    }
    if (grid) uniforms.grid = { value: Int32Array.of(grid.width, grid.height) };
    const fetch = !grid && lobeBands > 0 && this.mustFetch(renderer, lobeBands ** 2);
    this.mesh.geometry = fetch ? source.expanded() : source.geometry;
    const { map, colored, uv } = source;
    const shape = {
      kind: transfer.layout,
      diffuse: uniforms.diffuseLit !== undefined,
      sun: direct && (direct === "unshadowed" ? ("open" as const) : ("hidden" as const)),
      sunShare: apart,
      surroundings,
      ...{ albedoOutside, lobeBands, fetch, map, colored, uv },
      gaps: hasGaps(source.coverage),
      texelUv: grid?.texCoord === 1,
    };
    return this.surface(shape, uniforms);
  }

  /** What shadowed transfer, which is held beside what is shown, makes of the Sun's harmonics. */
  private buildSunShare(renderer: WebGLRenderer, transfer: PrimitiveTransfer): Texture {
    const { numbers, bands, channels } = transfer.shadowed!.vectors!;
    const shape = { rows: 1, columns: bands ** 2, channels };
    const what = { name: "shadowed vectors", numbers: () => numbers, shape, rows: 1 };
    return this.add(renderer, what, { light: "sun" }).target.texture;
  }

  /** @internal Whether fragments find so many coefficients by themselves. */
  mustFetch(renderer: WebGLRenderer, coefficients: number): boolean {
    const { incident } = this.shared.source;
    // Of WebGPU's devices many have no more than fifteen varyings of four numbers.
    if (this.nodes) return true;
    if (incident !== "auto") return incident === "fetch";
    return incidentGroups(coefficients) + kOtherVaryings > renderer.capabilities.maxVaryings;
  }

  relight(
    renderer: WebGLRenderer,
    screen: FullScreenPass,
    lights: Lights,
    { lobeExponent, softLobes }: Pick<Choices, "lobeExponent" | "softLobes">,
  ): void {
    for (const { texture, pass, glossy, scales, light } of this.lits) {
      const factors = new Float32Array(4 * Math.ceil(texture.rows / 4)).fill(1);
      if (glossy) {
        const exponent = lobeExponent ?? this.transfer!.matrices!.lobeExponent;
        const lobe = shownLobe(Math.sqrt(texture.rows), exponent, {
          soft: softLobes,
          horizon: this.lobeHasHorizon,
        });
        for (let i = 0; i < texture.rows; ++i) factors[i] = lobe.moments[bandOf(i)];
        this.lobeGain.value.fromArray(lobe.gain);
      }
      scales?.forEach((scale, i) => (factors[i] *= scale));
      pass.run(renderer, screen, lights[light], factors);
    }
  }

  private freeLits(): void {
    for (const { texture, pass } of this.lits) {
      texture.dispose();
      pass.dispose();
    }
    this.lits = [];
    this.needsSunMap = false;
  }

  /** All of it is to be made again: the GPU has lost it, or it is not wanted. */
  forget(): void {
    if (!this.isBuilt) return;
    this.freeLits();
    this.lease?.release();
    this.lease = null;
    this.built = "";
    this.material.wear(null);
  }

  dispose(): void {
    this.material.disposed = null;
    this.forget();
    this.material.dispose();
  }
}

function identity(rows: number, columns: number): Numbers {
  const data = new Float32Array(rows * columns);
  for (let i = 0; i < Math.min(rows, columns); ++i) data[i * columns + i] = 1;
  return { encoding: "float32", data, scales: null, run: 0 };
}
