// M L on the GPU: one pass for each block of transfer, drawn when the light changed.

import {
  GLSL3,
  NoBlending,
  RawShaderMaterial,
  Vector3,
  type DataArrayTexture,
  type WebGLRenderer,
} from "three";
import type { Numbers } from "../format/description.js";
import { pack } from "../generated/pack.js";
import { passMain } from "../generated/passMain.js";
import { passVert } from "../generated/passVert.js";
import { rowPlace } from "../generated/rowPlace.js";
import { transferFrag } from "../generated/transferFrag.js";
import type { FullScreenPass } from "./full-screen-pass.js";
import type { LitTexture } from "./lit-texture.js";
import { layoutUniform, textureOfRows, type RowLayout } from "./row-texture.js";

const kHeader = `precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp usampler2D;
`;

/** Of a pass that draws results. */
export function passMaterial(
  fragment: string,
  uniforms: Record<string, { value: unknown }>,
): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: kHeader + passVert,
    fragmentShader: kHeader + fragment,
    uniforms,
    depthTest: false,
    depthWrite: false,
    blending: NoBlending,
  });
}

/** [coefficient][3] → for each channel its columns, filled up with zeros to whole groups of four. */
function lightColumns(light: ArrayLike<number>, columns: number, out: Float32Array): void {
  const stride = out.length / 3;
  const count = Math.min(columns, light.length / 3);
  out.fill(0);
  for (let c = 0; c < 3; ++c)
    for (let i = 0; i < count; ++i) out[c * stride + i] = light[3 * i + c];
}

/** What makes the results of one block of transfer. */
export interface LightPass {
  /**
   * @param light [coefficient][3], in the asset's frame
   * @param factors one for each row of the result
   */
  run(
    renderer: WebGLRenderer,
    screen: FullScreenPass,
    light: ArrayLike<number>,
    factors: Float32Array,
  ): void;
  dispose(): void;
}

export interface MatrixShape {
  /** Of a stored matrix; 1 for vectors. */
  rows: number;
  columns: number;
  channels: 1 | 3;
  /** One matrix serves all receivers. */
  shared?: boolean;
}

/** Stored vectors or matrices on the GPU. */
export class TransferRows {
  readonly numbers: { texture: DataArrayTexture; layout: RowLayout };
  readonly scales: { texture: DataArrayTexture; layout: RowLayout } | null;

  /** @param columns of a row */
  constructor({ data, scales }: Numbers, columns: number, what: string) {
    this.numbers = textureOfRows(data, columns, what);
    this.scales = scales && textureOfRows(scales, 1, what);
  }

  dispose(): void {
    this.numbers.texture.dispose();
    this.scales?.texture.dispose();
  }
}

/** Results of stored vectors or matrices. */
export class TransferPass implements LightPass {
  private readonly material: RawShaderMaterial;
  private readonly light: Float32Array;

  /** @param stored what it reads; others may read it too */
  constructor(
    stored: TransferRows,
    private readonly shape: MatrixShape,
    private readonly lit: LitTexture,
    reflectance: readonly [number, number, number],
  ) {
    const { rows, columns, channels } = shape;
    const { numbers, scales } = stored;
    const quads = Math.ceil(columns / 4);
    this.light = new Float32Array(12 * quads);
    const uniforms: Record<string, { value: unknown }> = {
      numbers: { value: numbers.texture },
      numbersRows: { value: layoutUniform(numbers.layout) },
      light: { value: this.light },
      factors: { value: null },
      reflectance: { value: new Vector3(...reflectance) },
      receivers: { value: lit.receivers },
      receiversALine: { value: lit.receiversALine },
      step_: { value: shape.shared ? 0 : 1 },
    };
    if (scales) {
      uniforms.scales = { value: scales.texture };
      uniforms.scalesRows = { value: layoutUniform(scales.layout) };
    }
    this.material = passMaterial(
      `#define LAMBENT_ROWS ${lit.rows}
#define LAMBENT_TEXELS ${lit.texels}
#define LAMBENT_STORED_ROWS ${rows}
#define LAMBENT_QUADS ${quads}
#define LAMBENT_CHANNELS ${channels}
#define LAMBENT_SCALED ${scales ? 1 : 0}
${rowPlace}${transferFrag}${pack}${passMain}`,
      uniforms,
    );
  }

  run(
    renderer: WebGLRenderer,
    screen: FullScreenPass,
    light: ArrayLike<number>,
    factors: Float32Array,
  ): void {
    lightColumns(light, this.shape.columns, this.light);
    this.material.uniforms.factors.value = factors;
    screen.render(renderer, this.material, this.lit.target);
  }

  dispose(): void {
    this.material.dispose();
  }
}
