// What draws relit assets by three's WebGPURenderer, on both of its back ends. It is handed to the
// loader plugin, for it takes three/webgpu and three/tsl along, which a page with a WebGLRenderer has
// no use for.

import type { IUniform } from "three";
import type { RelitNodes } from "../materials/relit-material.js";
import type { SurfaceShape } from "../materials/relit-shaders.js";
import type { LitTexture } from "./lit-texture.js";
import type { NodeRenderer } from "./renderer.js";
import type { LightPass, MatrixShape, TransferRows } from "./transfer-pass.js";

/** `nodes` of three-lambent/webgpu. */
export interface LambentNodes {
  /**
   * @internal
   * @throws TypeError, Error if the renderer, or this three, cannot draw by them
   */
  check(renderer: NodeRenderer): void;
  /**
   * @internal
   * @param wanted what of an asset, or of its switches, is to be drawn
   * @throws Error that names what of it has no nodes
   */
  checkWanted(wanted: { mirrors: boolean; patches: boolean; sun: boolean; air: boolean }): void;
  /** @internal Texels of a side. */
  maxTextureSize(renderer: NodeRenderer): number;
  /** @internal As TransferPass. */
  pass(
    stored: TransferRows,
    shape: MatrixShape,
    lit: LitTexture,
    reflectance: readonly [number, number, number],
  ): LightPass;
  /** @internal As surfaceShaders. */
  surface(shape: SurfaceShape, uniforms: Record<string, IUniform>): RelitNodes;
}
