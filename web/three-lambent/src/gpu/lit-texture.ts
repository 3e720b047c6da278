// Results of transfer, receiver after receiver, as a picture that a pass draws and vertices or
// fragments fetch from: the bits of floats, four numbers in a texel (of one RGB value three). Texels
// of integers can be drawn on every WebGL2 device, those of floats not; nodes (three's WebGPURenderer)
// write floats alone.
//
// Halves, eight in a texel, would be half as many bytes; but a software renderer took 1.5 times as
// long for a frame of 100,000 vertices, for their unpacking.

import {
  FloatType,
  NearestFilter,
  NoColorSpace,
  RGBAFormat,
  RGBAIntegerFormat,
  UnsignedIntType,
  WebGLRenderTarget,
} from "three";

const kUsualWidth = 2048;

export class LitTexture {
  readonly target: WebGLRenderTarget;
  /** Of a receiver. */
  readonly texels: number;
  /** Receivers side by side in a line. */
  readonly receiversALine: number;

  /**
   * @param rows RGB values of a receiver
   * @throws Error if the device's textures are too small
   */
  constructor(
    { maxTextureSize: most, floats = false }: { maxTextureSize: number; floats?: boolean },
    readonly receivers: number,
    readonly rows: number,
    what: string,
  ) {
    this.texels = Math.ceil((3 * rows) / 4);
    let aLine = Math.max(1, Math.min(Math.floor(kUsualWidth / this.texels), receivers));
    if (Math.ceil(receivers / aLine) > most) aLine = Math.floor(most / this.texels);
    const height = Math.ceil(receivers / aLine);
    if (aLine * this.texels > most || height > most)
      throw new Error(
        `three-lambent: ${what}: ${receivers} receivers × ${rows} results do not fit into this ` +
          `device's textures of ${most} texels a side: bake fewer receivers or bands`,
      );
    this.receiversALine = aLine;
    this.target = new WebGLRenderTarget(aLine * this.texels, height, {
      format: floats ? RGBAFormat : RGBAIntegerFormat,
      type: floats ? FloatType : UnsignedIntType,
      ...(!floats && { internalFormat: "RGBA32UI" }),
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
