// Light in the tangent frames of vertices, where meso-structure takes it and nothing was baked that
// hides it on its way.

import {
  DataTexture,
  FloatType,
  NearestFilter,
  RGBAFormat,
  type DataArrayTexture,
  type RawShaderMaterial,
  type WebGLRenderer,
} from "three";
import { pack } from "../generated/pack.js";
import { passMain } from "../generated/passMain.js";
import { rowPlace } from "../generated/rowPlace.js";
import { sh } from "../generated/sh.js";
import { tangentFrame } from "../generated/tangentFrame.js";
import { turnFrag } from "../generated/turnFrag.js";
import type { FullScreenPass } from "./full-screen-pass.js";
import type { LitTexture } from "./lit-texture.js";
import { layoutUniform, textureOfRows, type RowLayout } from "./row-texture.js";
import { passMaterial, type LightPass } from "./transfer-pass.js";
import { turnSamples } from "./turn-samples.js";

/** Tangent frames of vertices on the GPU, and what turns light into them. */
export class TurnFrames {
  readonly normals: DataArrayTexture;
  readonly tangents: DataArrayTexture;
  readonly layout: RowLayout;
  readonly samples: DataTexture;

  /** @param bands of the light; more of them are cut */
  constructor(
    normals: Float32Array,
    tangents: Float32Array,
    readonly bands: number,
    what: string,
  ) {
    const [first, second] = [normals, tangents].map((data) => textureOfRows(data, 3, what));
    this.normals = first.texture;
    this.tangents = second.texture;
    this.layout = first.layout;
    const { texels, width } = turnSamples(bands);
    this.samples = new DataTexture(
      texels as Float32Array<ArrayBuffer>,
      width,
      bands * bands,
      RGBAFormat,
      FloatType,
    );
    this.samples.minFilter = this.samples.magFilter = NearestFilter;
    this.samples.needsUpdate = true;
  }

  dispose(): void {
    for (const texture of [this.normals, this.tangents, this.samples]) texture.dispose();
  }
}

/** Light turned into the tangent frames of vertices, which nothing hides it from. */
export class TurnPass implements LightPass {
  private readonly material: RawShaderMaterial;
  private readonly light: Float32Array;

  /** @param frames what it reads; others may read it too */
  constructor(
    frames: TurnFrames,
    private readonly lit: LitTexture,
  ) {
    const { bands } = frames;
    this.light = new Float32Array(3 * bands * bands);
    this.material = passMaterial(
      `#define LAMBENT_ROWS ${lit.rows}
#define LAMBENT_TEXELS ${lit.texels}
#define LAMBENT_BANDS ${bands}
${sh}${rowPlace}${tangentFrame}${turnFrag}${pack}${passMain}`,
      {
        normals: { value: frames.normals },
        tangents: { value: frames.tangents },
        frameRows: { value: layoutUniform(frames.layout) },
        samples: { value: frames.samples },
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
    this.material.dispose();
  }
}
