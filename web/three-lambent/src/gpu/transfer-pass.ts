// M L on the GPU: one pass for each block of transfer, drawn when the light changed.

import {
  FloatType,
  GLSL3,
  DataTexture,
  NearestFilter,
  NoBlending,
  RawShaderMaterial,
  RGBAFormat,
  Vector3,
  type DataArrayTexture,
  type WebGLRenderer,
} from "three";
import type { Numbers } from "../format/description.js";
import {
  pack,
  passMain,
  passVert,
  rowPlace,
  sh,
  tangentFrame,
  transferFrag,
  turnFrag,
} from "../generated/shaders.js";
import type { FullScreenPass } from "./full-screen-pass.js";
import type { LitTexture } from "./lit-texture.js";
import { layoutUniform, textureOfRows } from "./row-texture.js";
import { turnSamples } from "./turn-samples.js";

const kHeader = `precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp usampler2D;
`;

function passMaterial(
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

/** Results of stored vectors or matrices. */
export class TransferPass implements LightPass {
  private readonly textures: DataArrayTexture[] = [];
  private readonly material: RawShaderMaterial;
  private readonly light: Float32Array;

  constructor(
    numbers: Numbers,
    private readonly shape: MatrixShape,
    private readonly lit: LitTexture,
    reflectance: readonly [number, number, number],
    what: string,
  ) {
    const { rows, columns, channels } = shape;
    const quads = Math.ceil(columns / 4);
    this.light = new Float32Array(12 * quads);
    const stored = textureOfRows(numbers.data, columns, what);
    this.textures.push(stored.texture);
    const uniforms: Record<string, { value: unknown }> = {
      numbers: { value: stored.texture },
      numbersRows: { value: layoutUniform(stored.layout) },
      light: { value: this.light },
      factors: { value: null },
      reflectance: { value: new Vector3(...reflectance) },
      receivers: { value: lit.receivers },
      receiversALine: { value: lit.receiversALine },
      step_: { value: shape.shared ? 0 : 1 },
    };
    if (numbers.scales) {
      const scales = textureOfRows(numbers.scales, 1, what);
      this.textures.push(scales.texture);
      uniforms.scales = { value: scales.texture };
      uniforms.scalesRows = { value: layoutUniform(scales.layout) };
    }
    this.material = passMaterial(
      `#define LAMBENT_ROWS ${lit.rows}
#define LAMBENT_TEXELS ${lit.texels}
#define LAMBENT_STORED_ROWS ${rows}
#define LAMBENT_QUADS ${quads}
#define LAMBENT_CHANNELS ${channels}
#define LAMBENT_SCALED ${numbers.scales ? 1 : 0}
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
    for (const texture of this.textures) texture.dispose();
    this.material.dispose();
  }
}

/** Light turned into the tangent frames of vertices, which nothing hides it from. */
export class TurnPass implements LightPass {
  private readonly textures: (DataArrayTexture | DataTexture)[] = [];
  private readonly material: RawShaderMaterial;
  private readonly light: Float32Array;

  /** @param bands of the light; more of them are cut */
  constructor(
    normals: Float32Array,
    tangents: Float32Array,
    bands: number,
    private readonly lit: LitTexture,
    what: string,
  ) {
    this.light = new Float32Array(3 * bands * bands);
    const samples = turnSamples(bands);
    const frames = [normals, tangents].map((data) => textureOfRows(data, 3, what));
    const turn = new DataTexture(
      samples.texels as Float32Array<ArrayBuffer>,
      samples.width,
      bands * bands,
      RGBAFormat,
      FloatType,
    );
    turn.minFilter = turn.magFilter = NearestFilter;
    turn.needsUpdate = true;
    this.textures.push(frames[0].texture, frames[1].texture, turn);
    this.material = passMaterial(
      `#define LAMBENT_ROWS ${lit.rows}
#define LAMBENT_TEXELS ${lit.texels}
#define LAMBENT_BANDS ${bands}
${sh}${rowPlace}${tangentFrame}${turnFrag}${pack}${passMain}`,
      {
        normals: { value: frames[0].texture },
        tangents: { value: frames[1].texture },
        frameRows: { value: layoutUniform(frames[0].layout) },
        samples: { value: turn },
        light: { value: this.light },
        factors: { value: null },
        receivers: { value: lit.receivers },
        receiversALine: { value: lit.receiversALine },
      },
    );
  }

  run(
    renderer: WebGLRenderer,
    screen: FullScreenPass,
    light: ArrayLike<number>,
    factors: Float32Array,
  ): void {
    for (let i = 0; i < this.light.length; ++i) this.light[i] = i < light.length ? light[i] : 0;
    this.material.uniforms.factors.value = factors;
    screen.render(renderer, this.material, this.lit.target);
  }

  dispose(): void {
    for (const texture of this.textures) texture.dispose();
    this.material.dispose();
  }
}
