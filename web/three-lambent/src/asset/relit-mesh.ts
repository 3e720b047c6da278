// One mesh of an asset: its transfer on the GPU, its material, and which of both a choice wants.

import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  FrontSide,
  NearestFilter,
  RGIntegerFormat,
  UnsignedShortType,
  Vector3,
  type CubeTexture,
  type IUniform,
  type Material,
  type Mesh,
  type Texture,
  type WebGLRenderer,
} from "three";
import type {
  AssetDescription,
  Numbers,
  PrimitiveTransfer,
  Vectors,
} from "../format/description.js";
import type { FullScreenPass } from "../gpu/full-screen-pass.js";
import { LitTexture } from "../gpu/lit-texture.js";
import { kGroupsAFetch, kNumbersOf, type RttTexture } from "../gpu/rtt-texture.js";
import { TransferPass, TurnPass, type LightPass } from "../gpu/transfer-pass.js";
import type { AirMode } from "../materials/air-source.js";
import type { EnvironmentUniforms } from "../materials/environment-uniforms.js";
import { coverageUniforms, hasGaps, type Coverage } from "../materials/coverage.js";
import { incidentGroups } from "../materials/group-macros.js";
import {
  makePatchMaterial,
  makeSurfaceMaterial,
  type RelitMaterial,
} from "../materials/relit-material.js";
import { bandOf, evaluateHarmonics } from "../sh/basis.js";
import { leastSofteningOfZonal } from "../sh/window.js";
import { clampedCosineMoments, phongLobeMoments } from "../sh/zonal.js";
import { kindOf, macroOf, type TransferChoice } from "./choices.js";
import type { Reflectance } from "./reflectance.js";
import { kindWithoutBounces } from "./sharp-sun.js";
import { hasBacks } from "./two-sides.js";

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

/** How incident light comes to the fragments: interpolated, or fetched at the triangle's corners. */
export type IncidentMode = "auto" | "varyings" | "fetch";

/** What all meshes of an asset share. */
export interface Shared {
  description: AssetDescription;
  environment: EnvironmentUniforms;
  air: Record<string, IUniform>;
  captured: Record<string, IUniform>;
  incident: IncidentMode;
  /** On the GPU when first asked for. */
  rtt(index: number): RttTexture;
}

// Besides the light: position and u, normal and v, colour or tangent, diffuse radiance.
const kOtherVaryings = 5;

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
  private built = "";
  private lits: Lit[] = [];
  private material: RelitMaterial | null = null;
  private idMap: DataTexture | null = null;
  private expanded: BufferGeometry | null = null;
  private readonly geometry: BufferGeometry;
  private readonly map: Texture | null;
  private readonly backs: boolean;
  /** What the loader gave the mesh. */
  readonly original: Material;
  /** Of the asset's Sun. */
  sunUniforms: Record<string, IUniform> = {};
  /** Of shaders/local_capture.glsl. */
  private readonly captureUniforms = {
    capture: { value: null as CubeTexture | null },
    captureFrom: { value: new Vector3() },
    hasCapture: { value: false },
  };
  /** Whether something hides a sharp Sun from what is shown. */
  needsSunMap = false;

  constructor(
    readonly mesh: Mesh,
    readonly transfer: PrimitiveTransfer | null,
    private readonly reflectance: Reflectance,
    private readonly shared: Shared,
    readonly coverage: Coverage,
    private readonly number: number,
  ) {
    this.geometry = mesh.geometry;
    this.original = mesh.material as Material;
    this.backs = hasBacks(mesh.geometry);
    this.map = (this.original as { map?: Texture | null }).map ?? null;
    mesh.onBeforeRender = (renderer, _scene, camera, _geometry, material) => {
      if (material === this.material) this.material.look(renderer, camera, mesh);
    };
    mesh.material = this.black();
  }

  /** Its triangles, as the loader made them. */
  get plain(): BufferGeometry {
    return this.geometry;
  }

  get texture(): Texture | null {
    return this.uv ? this.map : null;
  }

  get isMirror(): boolean {
    return Math.max(...this.reflectance.mirror) > 0;
  }

  /** Until the first update() there is no light. */
  private black(): RelitMaterial {
    this.material = makeSurfaceMaterial(
      { kind: "black", map: null, colored: false, uv: false },
      {},
    );
    return this.material;
  }

  private get colored(): boolean {
    return this.geometry.hasAttribute("color");
  }

  private get uv(): boolean {
    return this.geometry.hasAttribute("uv");
  }

  /** Makes what the choices need, if it is not there. @returns whether light is due again */
  prepare(renderer: WebGLRenderer, choices: Choices): boolean {
    const { transfer, shared } = this;
    const kind = transfer ? kindOf(shared.description, transfer, choices.transfer) : "";
    const patch = transfer?.biScale ? `${choices.macro} ${choices.filter}` : "";
    const key = choices.unlit
      ? "unlit"
      : `${kind} ${patch} ${choices.sun} ${choices.air} ${choices.captured}`;
    const fresh = key !== this.built;
    if (fresh) {
      this.release();
      this.build(renderer, choices);
      this.built = key;
    }
    const material = this.material!;
    material.samples = choices.samples;
    material.sample = choices.sample;
    if (material.uniforms.viewDependent)
      material.uniforms.viewDependent.value = choices.viewDependent;
    return fresh;
  }

  private build(renderer: WebGLRenderer, choices: Choices): void {
    const { transfer, reflectance, map, colored, uv, shared } = this;
    const gaps = hasGaps(this.coverage);
    const plain = { map, colored, uv, gaps };
    const { air, captured } = choices;
    const covered = gaps ? coverageUniforms(this.coverage, this.number) : {};
    const uniforms = { ...covered, ...this.surroundings(choices) };
    if (choices.unlit) {
      this.show(makeSurfaceMaterial({ kind: "unlit", ...plain }, covered));
      this.material!.uniforms.reflectance.value.set(...reflectance.base);
    } else if (this.isMirror) {
      Object.assign(uniforms, shared.environment.uniforms, this.captureUniforms);
      this.show(makeSurfaceMaterial({ kind: "mirror", ...plain, air, captured }, uniforms));
      this.material!.uniforms.reflectance.value.set(...reflectance.mirror);
    } else if (transfer?.biScale) {
      this.buildPatch(renderer, choices);
    } else if (transfer && (transfer.vectors || transfer.matrices)) {
      this.buildSurface(renderer, transfer, choices);
    } else {
      this.show(makeSurfaceMaterial({ kind: "black", ...plain, air, captured }, uniforms));
    }
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

  private show(material: RelitMaterial): void {
    this.material?.dispose();
    this.material = material;
    material.name = this.original.name;
    if (this.backs) material.side = FrontSide;
    this.mesh.material = material;
  }

  private get what(): string {
    return `mesh "${this.mesh.name}"`;
  }

  private buildSurface(
    renderer: WebGLRenderer,
    transfer: PrimitiveTransfer,
    choices: Choices,
  ): void {
    const { description } = this.shared;
    const kind = kindOf(description, transfer, choices.transfer);
    const unshadowed = kind === "unshadowed" && description.transfer !== "unshadowed";
    const from =
      kind === "shadowed" && description.transfer !== kind ? transfer.shadowed : transfer;
    const gaps = hasGaps(this.coverage);
    const uniforms: Record<string, IUniform> = gaps
      ? coverageUniforms(this.coverage, this.number)
      : {};
    const direct = choices.sun ? kindWithoutBounces(description, transfer, choices.transfer) : null;
    const { receivers, grid } = transfer;
    let albedoOutside = false;
    if (transfer.vectors && from?.vectors) {
      const vectors = unshadowed
        ? this.unshadowedVectors(transfer, transfer.vectors)
        : from.vectors;
      albedoOutside = vectors.albedoOutside;
      const texture = new LitTexture(renderer, receivers, 1, this.what);
      const shape = { rows: 1, columns: vectors.bands ** 2, channels: vectors.channels };
      const pass = new TransferPass(vectors.numbers, shape, texture, [1, 1, 1], this.what);
      const light = direct === kind ? "withoutSun" : "whole";
      this.lits.push({ texture, pass, glossy: false, scales: null, light });
      uniforms.diffuseLit = { value: texture.target.texture };
      uniforms.diffuseALine = { value: texture.receiversALine };
    }
    if (direct) {
      Object.assign(uniforms, this.sunUniforms, {
        sunReflectance: { value: new Vector3(...this.reflectance.diffuse) },
      });
      this.needsSunMap = direct !== "unshadowed";
    }
    const apart = direct && direct !== kind;
    if (apart) uniforms.sunLit = { value: this.buildSunShare(renderer, transfer) };
    let lobeBands = 0;
    if (transfer.matrices && from?.matrices) {
      const { matrices } = from;
      lobeBands = matrices.outBands;
      const rows = lobeBands ** 2;
      const columns = matrices.inBands ** 2;
      const texture = new LitTexture(renderer, receivers, rows, this.what);
      const numbers = unshadowed ? identity(rows, columns) : matrices.numbers;
      const channels = unshadowed ? 1 : matrices.channels;
      const shape = { rows, columns, channels, shared: unshadowed };
      const pass = new TransferPass(numbers, shape, texture, matrices.glossy, this.what);
      this.lits.push({ texture, pass, glossy: true, scales: null, light: "lobes" });
      uniforms.incidentLit = { value: texture.target.texture };
      uniforms.incidentALine = { value: texture.receiversALine };
    }
    Object.assign(uniforms, this.surroundings(choices));
    if (grid) uniforms.grid = { value: Int32Array.of(grid.width, grid.height) };
    const fetch = !grid && lobeBands > 0 && this.mustFetch(renderer, lobeBands ** 2);
    this.mesh.geometry = fetch ? this.expand() : this.geometry;
    const { map, colored, uv } = this;
    const shape = {
      kind: transfer.layout,
      diffuse: uniforms.diffuseLit !== undefined,
      sun: direct && (direct === "unshadowed" ? ("open" as const) : ("hidden" as const)),
      sunShare: apart !== null && apart,
      air: choices.air,
      captured: choices.captured,
      ...{ albedoOutside, lobeBands, fetch, map, colored, uv, gaps },
      texelUv: grid?.texCoord === 1,
    };
    this.show(makeSurfaceMaterial(shape, uniforms));
  }

  /** What shadowed transfer, which is held beside what is shown, makes of the Sun's harmonics. */
  private buildSunShare(renderer: WebGLRenderer, transfer: PrimitiveTransfer): Texture {
    const { numbers, bands, channels } = transfer.shadowed!.vectors!;
    const texture = new LitTexture(renderer, transfer.receivers, 1, this.what);
    const shape = { rows: 1, columns: bands ** 2, channels };
    const pass = new TransferPass(numbers, shape, texture, [1, 1, 1], this.what);
    this.lits.push({ texture, pass, glossy: false, scales: null, light: "sun" });
    return texture.target.texture;
  }

  private buildPatch(renderer: WebGLRenderer, choices: Choices): void {
    const { description, rtt: rttOf } = this.shared;
    const transfer = this.transfer!;
    const biScale = transfer.biScale!;
    const rtt = description.rtts[biScale.rtt];
    const rttTexture = rttOf(biScale.rtt);
    const rows = rtt.bands ** 2;
    const texture = new LitTexture(renderer, transfer.receivers, rows, this.what);
    const macro = macroOf(description, transfer, choices.transfer, choices.macro);
    let pass: LightPass;
    if (macro) {
      const columns = biScale.bands ** 2;
      const shape = { rows: columns, columns, channels: macro.channels };
      pass = new TransferPass(macro.numbers, shape, texture, [1, 1, 1], this.what);
    } else {
      pass = new TurnPass(this.normals(), biScale.tangents, rtt.bands, texture, this.what);
    }
    this.lits.push({
      ...{ texture, pass, glossy: false, scales: rttTexture.scales() },
      light: "whole",
    });

    const fetch = this.mustFetch(renderer, rows);
    if (!this.geometry.hasAttribute("lambentTangent"))
      this.geometry.setAttribute("lambentTangent", new BufferAttribute(biScale.tangents, 3));
    this.mesh.geometry = fetch ? this.expand() : this.geometry;
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
      this.idMap = idMapTexture(biScale.idMap, renderer, this.what);
      uniforms.idMap = { value: this.idMap };
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
    Object.assign(uniforms, this.surroundings(choices));
    this.show(makePatchMaterial(shape, uniforms));
  }

  private mustFetch(renderer: WebGLRenderer, coefficients: number): boolean {
    const { incident } = this.shared;
    if (incident !== "auto") return incident === "fetch";
    return incidentGroups(coefficients) + kOtherVaryings > renderer.capabilities.maxVaryings;
  }

  /**
   * Three vertices for each triangle, which know the numbers of all three: fragment shaders of
   * WebGL2 are not told their triangle.
   */
  private expand(): BufferGeometry {
    if (this.expanded) return this.expanded;
    const { index } = this.geometry;
    const expanded = index ? this.geometry.toNonIndexed() : this.geometry.clone();
    const count = expanded.getAttribute("position").count;
    const corners = new Uint32Array(3 * count);
    for (let i = 0; i < count; ++i) {
      const first = i - (i % 3);
      for (let k = 0; k < 3; ++k) corners[3 * i + k] = index ? index.getX(first + k) : first + k;
    }
    expanded.setAttribute("lambentCorners", new BufferAttribute(corners, 3));
    expanded.boundingBox = this.geometry.boundingBox;
    expanded.boundingSphere = this.geometry.boundingSphere;
    this.expanded = expanded;
    return expanded;
  }

  private normals(): Float32Array {
    const normal = this.geometry.getAttribute("normal");
    const normals = new Float32Array(3 * normal.count);
    for (let i = 0; i < normal.count; ++i)
      normals.set([normal.getX(i), normal.getY(i), normal.getZ(i)], 3 * i);
    return normals;
  }

  /**
   * ρ/π Â_l y_i(N). Of a base colour that was baked in, COLOR_0 at vertices is kept inside; where a
   * texture takes part it is multiplied per pixel.
   */
  private unshadowedVectors(transfer: PrimitiveTransfer, stored: Vectors): Vectors {
    const { bands } = stored;
    const n = bands * bands;
    const normals = transfer.grid ? transfer.grid.normals : this.normals();
    const textured = this.map !== null && this.uv;
    const color =
      !stored.albedoOutside && !transfer.grid && !textured && this.colored
        ? this.geometry.getAttribute("color")
        : null;
    const cosine = clampedCosineMoments(bands);
    const y = new Float64Array(n);
    const data = new Float32Array(transfer.receivers * 3 * n);
    const rho = new Vector3();
    for (let p = 0; p < transfer.receivers; ++p) {
      const [nx, ny, nz] = normals.subarray(3 * p, 3 * p + 3);
      const length = Math.hypot(nx, ny, nz) || 1;
      evaluateHarmonics(bands, nx / length, ny / length, nz / length, y);
      rho.set(...this.reflectance.diffuse);
      if (color) rho.multiply(new Vector3(color.getX(p), color.getY(p), color.getZ(p)));
      for (let c = 0; c < 3; ++c) {
        const factor = rho.getComponent(c) / Math.PI;
        const to = (3 * p + c) * n;
        for (let i = 0; i < n; ++i) data[to + i] = factor * cosine[bandOf(i)] * y[i];
      }
    }
    const numbers: Numbers = { encoding: "float32", data, scales: null, run: 0 };
    return { numbers, bands, channels: 3, albedoOutside: color === null };
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
        const moments = phongLobeMoments(Math.sqrt(texture.rows), exponent);
        const window = softLobes ? leastSofteningOfZonal(moments) : moments.map(() => 1);
        for (let i = 0; i < texture.rows; ++i)
          factors[i] = window[bandOf(i)] * moments[bandOf(i)];
      }
      scales?.forEach((scale, i) => (factors[i] *= scale));
      pass.run(renderer, screen, lights[light], factors);
    }
  }

  /** What the choices made; not the mesh itself. */
  private release(): void {
    for (const { texture, pass } of this.lits) {
      texture.dispose();
      pass.dispose();
    }
    this.lits = [];
    this.needsSunMap = false;
    this.idMap?.dispose();
    this.idMap = null;
  }

  /** All of it is to be made again: the GPU has lost it. */
  forget(): void {
    this.release();
    this.built = "";
  }

  dispose(): void {
    this.release();
    this.material?.dispose();
    this.geometry.dispose();
    this.expanded?.dispose();
  }
}

function identity(rows: number, columns: number): Numbers {
  const data = new Float32Array(rows * columns);
  for (let i = 0; i < Math.min(rows, columns); ++i) data[i * columns + i] = 1;
  return { encoding: "float32", data, scales: null, run: 0 };
}

function idMapTexture(
  map: { width: number; height: number; ids: Uint16Array },
  renderer: WebGLRenderer,
  what: string,
): DataTexture {
  const most = renderer.capabilities.maxTextureSize;
  if (map.width > most || map.height > most)
    throw new Error(
      `three-lambent: ${what}: an id map of ${map.width}×${map.height} texels, but this device ` +
        `takes ${most} a side: make it smaller`,
    );
  const texture = new DataTexture(
    map.ids as Uint16Array<ArrayBuffer>,
    map.width,
    map.height,
    RGIntegerFormat,
    UnsignedShortType,
  );
  texture.internalFormat = "RG16UI";
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
