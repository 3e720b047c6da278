// Which renderers can draw relit assets.

import type { WebGLRenderer } from "three";

/** @throws TypeError for what is no renderer by WebGL 2 */
export function checkRenderer(renderer: WebGLRenderer): void {
  const given = renderer as Partial<WebGLRenderer> & { isWebGPURenderer?: boolean };
  if (given?.isWebGPURenderer)
    throw new TypeError(
      "three-lambent: WebGPURenderer cannot draw relit assets, whose shaders are GLSL: use " +
        "THREE.WebGLRenderer",
    );
  if (!given?.capabilities?.maxTextureSize)
    throw new TypeError("three-lambent: update(renderer) wants a THREE.WebGLRenderer");
  if ((given.capabilities as { isWebGL2?: boolean }).isWebGL2 === false)
    throw new TypeError("three-lambent: relit assets need WebGL 2, and this renderer has WebGL 1");
}
