// From a linear picture to the screen, as the tool's PNG pictures and its viewer.

import {
  GLSL3,
  NoBlending,
  RawShaderMaterial,
  type Texture,
  type WebGLRenderer,
  type WebGLRenderTarget,
} from "three";
import { outputFrag } from "../generated/outputFrag.js";
import { passVert } from "../generated/passVert.js";
import { FullScreenPass } from "../gpu/full-screen-pass.js";
import { isNodeRenderer } from "../gpu/renderer.js";
import { toneGlsl, type ToneCurve } from "./tone.js";

/**
 * Draws a linear picture, exposed, through the tone curve and sRGB-coded: bytes equal the tool's to
 * 1/255. Use it in place of three's tone mapping: render the scene into a target of floats or half
 * floats (where three leaves radiance linear), then this onto the canvas.
 */
export class ToneMapper {
  /** EV: a factor of 2^exposure. */
  exposure = 0;
  curve: ToneCurve = "filmic";
  private readonly screen = new FullScreenPass();
  private readonly material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: `precision highp float;\n${passVert}`,
    fragmentShader: `precision highp float;\nprecision highp sampler2D;\n${toneGlsl}${outputFrag}`,
    uniforms: { picture: { value: null }, factor: { value: 1 }, isFilmic: { value: true } },
    depthTest: false,
    depthWrite: false,
    blending: NoBlending,
    toneMapped: false,
  });

  /**
   * @param picture as large as the target, pixel for pixel; linear
   * @param target null: the canvas
   * @param count how many pictures were added up in it, of which the mean is shown
   * @throws TypeError for a WebGPURenderer
   */
  render(
    renderer: WebGLRenderer,
    picture: Texture,
    target: WebGLRenderTarget | null = null,
    count = 1,
  ): void {
    if (isNodeRenderer(renderer))
      throw new TypeError(
        "three-lambent: ToneMapper cannot draw by WebGPURenderer: use its own toneMapping, or " +
          "THREE.WebGLRenderer",
      );
    const { uniforms } = this.material;
    uniforms.picture.value = picture;
    uniforms.factor.value = 2 ** this.exposure / count;
    uniforms.isFilmic.value = this.curve === "filmic";
    this.screen.render(renderer, this.material, target);
  }

  dispose(): void {
    this.screen.dispose();
    this.material.dispose();
  }
}
