// What WebGPURenderer draws relit assets by, and which of them it cannot.

import { REVISION } from "three";
import type { LambentNodes } from "../gpu/nodes.js";
import type { NodeRenderer } from "../gpu/renderer.js";
import { NodePass } from "./node-pass.js";
import { surfaceNodes } from "./surface.js";

/**
 * The first release of three whose nodes these are: 0.kOldestThree.0. Before 0.184 its WebGL 2 back end,
 * before 0.182 both, cannot fetch a texel of an array texture (2026-11).
 */
export const kOldestThree = 184;

/** What there is of WebGPURenderer, once it is initialised. */
interface Initialised extends NodeRenderer {
  hasInitialized?(): boolean;
  backend: {
    device?: { limits: { maxTextureDimension2D: number } };
    gl?: WebGL2RenderingContext;
  };
}

const kInstead = "use THREE.WebGLRenderer for it";

function checkDevice({ backend: { gl } }: Initialised): void {
  if (gl && !gl.getExtension("EXT_color_buffer_float"))
    throw new Error(
      "three-lambent: WebGPURenderer lights assets in textures of floats, which this device's " +
        `WebGL 2 does not draw into: ${kInstead}`,
    );
}

/** For {@link LambentLoaderPlugin}: `new LambentLoaderPlugin(parser, { nodes })`. */
export const nodes: LambentNodes = {
  check(renderer) {
    if (!(Number.parseInt(REVISION, 10) >= kOldestThree))
      throw new Error(
        `three-lambent: three-lambent/webgpu needs three 0.${kOldestThree}.0 or later, and this is ` +
          `r${REVISION}: update three, or use THREE.WebGLRenderer`,
      );
    const given = renderer as Initialised;
    if (given.hasInitialized?.() === false)
      throw new Error(
        "three-lambent: update() before WebGPURenderer has a device: await renderer.init() first",
      );
    checkDevice(given);
  },

  checkWanted({ mirrors, patches, sun, air }) {
    const what = mirrors
      ? "mirrors"
      : patches
        ? "meso-structure"
        : sun
          ? "sharp Sun (setSun)"
          : air
            ? "air (setAir)"
            : null;
    if (what) throw new Error(`three-lambent: WebGPURenderer has no ${what} here: ${kInstead}`);
  },

  maxTextureSize(renderer) {
    const { device, gl } = (renderer as Initialised).backend;
    if (device) return device.limits.maxTextureDimension2D;
    return gl ? (gl.getParameter(gl.MAX_TEXTURE_SIZE) as number) : 2048;
  },

  pass: (stored, shape, lit, reflectance) => new NodePass(stored, shape, lit, reflectance),
  surface: surfaceNodes,
};
