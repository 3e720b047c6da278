// One mesh of one instance of an asset: its lit transfer on the GPU, its material, and which of
// both a choice wants.

import {
  BufferAttribute,
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
import { kGroupsAFetch, kNumbersOf, RttTexture } from "../gpu/rtt-texture.js";
import { Lease } from "../gpu/shared.js";
import {
  TransferPass,
  TransferRows,
  TurnFrames,
  TurnPass,
  type LightPass,
  type MatrixShape,
} from "../gpu/transfer-pass.js";
import type { AirMode } from "../materials/air-source.js";
import { coverageUniforms, hasGaps, type Coverage } from "../materials/coverage.js";
import type { EnvironmentUniforms } from "../materials/environment-uniforms.js";
import { incidentGroups } from "../materials/group-macros.js";
import { RelitMaterial, type RelitNodes, type RelitShaders } from "../materials/relit-material.js";
import { patchShaders, surfaceShaders, type SurfaceShape } from "../materials/relit-shaders.js";
import { bandOf } from "../sh/basis.js";
import { shownLobe } from "../sh/lobe.js";
import type { AssetSource } from "./asset-source.js";
import { kindOf, macroOf, type TransferChoice } from "./choices.js";
import type { MeshSource } from "./mesh-source.js";
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
  environment: EnvironmentUniforms;
  air: Record<string, IUniform>;
  captured: Record<string, IUniform>;
  /** Of the Sun. */
  sun: Record<string, IUniform>;
  /** Before a mesh, or another one with its material, is drawn. */
  drawn(mesh: RelitMesh, scene: Scene, object: Object3D): void;
  /** After somebody else disposed of a material. */
  disposed(): void;
}

// Besides the light: position and u, normal and v, colour or tangent, diffuse radiance, depths.
const kOtherVaryings = 6;

interface Lit {
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
  private lits: Lit[] = [];
  private lease: Lease | null = null;
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

  private get description(): AssetDescription {
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
    const { viewDependent, veil } = this.material.uniforms;
    this.material.shaders!.samples = choices.samples;
    if (viewDependent) viewDependent.value = choices.viewDependent;
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
    const { air, captured } = choices;
    const covered = gaps ? coverageUniforms(source.coverage, source.number) : {};
    const around = { ...covered, ...this.surroundings(choices) };
    if (choices.unlit) {
      const uniforms = { ...covered, reflectance: { value: new Vector3(...reflectance.base) } };
      return this.surface({ kind: "unlit", ...plain }, uniforms);
    }
    if (source.isMirror) {
      const uniforms = {
        ...around,
        ...shared.environment.uniforms,
        ...this.captureUniforms,
        reflectance: { value: new Vector3(...reflectance.mirror) },
      };
      return this.surface({ kind: "mirror", ...plain, air, captured }, uniforms);
    }
    if (transfer?.biScale) return this.buildPatch(renderer, choices);
    if (transfer && (transfer.vectors || transfer.matrices))
      return this.buildSurface(renderer, transfer, choices, around);
    return this.surface({ kind: "black", ...plain, air, captured }, around);
  }

  /** Of what the asset is seen through, and by. */
  private surroundings({ air, captured }: Choices): Record<string, IUniform> {
    return {
      ...(air !== "none" && this.shared.air),
      ...(captured && this.shared.captured),
    };
  }

  /** What a mirror shows of the asset; `from` times captureScale. null: nothing. */
  lookInto(capture: { texture: CubeTexture; from: Vector3 } | null): void {
    const { captureUniforms: u } = this;
    u.capture.value = capture?.texture ?? null;
    u.hasCapture.value = capture !== null;
    if (capture) u.captureFrom.value.copy(capture.from);
  }

  /** Stored numbers, which all instances read, and what a pass makes of them here. */
  private add(
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
      air: choices.air,
      captured: choices.captured,
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

  private buildPatch(renderer: WebGLRenderer, choices: Choices): RelitShaders {
    const { description, source } = this;
    const lease = this.lease!;
    const transfer = this.transfer!;
    const biScale = transfer.biScale!;
    const rtt = description.rtts[biScale.rtt];
    const rttTexture = lease.take(`rtt ${biScale.rtt}`, () => new RttTexture(rtt));
    const rows = rtt.bands ** 2;
    const scales = rttTexture.scales();
    const macro = macroOf(description, transfer, choices.transfer, choices.macro);
    let texture: LitTexture;
    if (macro) {
      const columns = biScale.bands ** 2;
      const shape = { rows: columns, columns, channels: macro.channels };
      const name = macro === biScale.shadowed ? "shadowed macro" : "macro";
      texture = this.add(renderer, { name, numbers: () => macro.numbers, shape, rows }, { scales });
    } else {
      texture = new LitTexture(renderer.capabilities, transfer.receivers, rows, source.what);
      const frames = lease.take(
        `${source.key} frames`,
        () => new TurnFrames(source.normals(), biScale.tangents, rtt.bands, source.what),
      );
      const pass = new TurnPass(frames, texture);
      this.lits.push({ texture, pass, glossy: false, scales, light: "whole" });
    }

    const fetch = this.mustFetch(renderer, rows);
    if (!source.geometry.hasAttribute("lambentTangent"))
      source.geometry.setAttribute("lambentTangent", new BufferAttribute(biScale.tangents, 3));
    this.mesh.geometry = fetch ? source.expanded() : source.geometry;
    const uniforms: Record<string, IUniform> = {
      incidentLit: { value: texture.target.texture },
      incidentALine: { value: texture.receiversALine },
      rtt: { value: rttTexture.texture },
      rttRows: { value: rttTexture.rows },
      views: { value: rtt.views },
      viewDependent: { value: choices.viewDependent },
      levelCount: { value: rttTexture.levelCount },
      levels: { value: rttTexture.levels },
    };
    if (biScale.idMap) {
      const idMap = lease.take(`${source.key} ids`, () => source.idMapTexture(renderer));
      uniforms.idMap = { value: idMap };
      const each = rtt.size.map((size) => 1 / (size * biScale.scale));
      uniforms.periodsPerMetre = { value: Float32Array.from(each) };
    } else {
      uniforms.tiles = { value: Float32Array.from(biScale.tiles) };
    }
    const { encoding } = rtt.numbers;
    const shape = {
      bands: rtt.bands,
      numbers: kNumbersOf[encoding],
      groupsAFetch: kGroupsAFetch[encoding],
      fetch,
      filter: choices.filter,
      idMap: biScale.idMap !== null,
      air: choices.air,
      captured: choices.captured,
    };
    return patchShaders(shape, { ...uniforms, ...this.surroundings(choices) });
  }

  private mustFetch(renderer: WebGLRenderer, coefficients: number): boolean {
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
