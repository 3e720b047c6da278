// Results of transfer, [receiver][row] RGB, as a picture of floats that a pass draws and vertices or
// fragments fetch from.

import {
  FloatType,
  NearestFilter,
  NoColorSpace,
  RGBAFormat,
  WebGLRenderTarget,
  type WebGLRenderer,
} from "three";

const kUsualWidth = 2048;

export class LitTexture {
  readonly target: WebGLRenderTarget;
  /** Receivers side by side in a line. */
  readonly receiversALine: number;

  /**
   * @param rows texels of a receiver
   * @throws Error if the device's textures are too small, or it cannot draw floats
   */
  constructor(
    renderer: WebGLRenderer,
    readonly receivers: number,
    readonly rows: number,
    what: string,
  ) {
    if (!renderer.extensions.has("EXT_color_buffer_float"))
      throw new Error(
        "three-lambent: this device cannot draw into textures of floats (EXT_color_buffer_float), " +
          "which relighting on the GPU needs",
      );
    const most = renderer.capabilities.maxTextureSize;
    let aLine = Math.max(1, Math.min(Math.floor(kUsualWidth / rows), receivers));
    if (Math.ceil(receivers / aLine) > most) aLine = Math.floor(most / rows);
    const height = Math.ceil(receivers / aLine);
    if (aLine * rows > most || height > most)
      throw new Error(
        `three-lambent: ${what}: ${receivers} receivers × ${rows} results do not fit into this ` +
          `device's textures of ${most} texels a side: bake fewer receivers or bands`,
      );
    this.receiversALine = aLine;
    this.target = new WebGLRenderTarget(aLine * rows, height, {
      format: RGBAFormat,
      type: FloatType,
      minFilter: NearestFilter,
      magFilter: NearestFilter,
      colorSpace: NoColorSpace,
      generateMipmaps: false,
      depthBuffer: false,
      stencilBuffer: false,
    });
  }

  dispose(): void {
    this.target.dispose();
  }
}
