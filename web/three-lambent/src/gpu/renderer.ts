// Which renderers can draw relit assets.

import type { WebGLRenderer } from "three";
import type { LambentNodes } from "./nodes.js";

/** Three's WebGPURenderer, which draws by `nodes` of three-lambent/webgpu. */
export interface NodeRenderer {
  readonly isWebGPURenderer: true;
}

export type AnyRenderer = WebGLRenderer | NodeRenderer;

/** @throws TypeError for what is no renderer by WebGL 2, nor one that there are nodes for */
export function checkRenderer(
  renderer: AnyRenderer,
  nodes: LambentNodes | null,
): asserts renderer is WebGLRenderer {
  if (isNodeRenderer(renderer)) {
    if (nodes) return nodes.check(renderer);
    throw new TypeError(
      "three-lambent: WebGPURenderer cannot draw relit assets without their nodes: import `nodes` of " +
        "three-lambent/webgpu and load by new LambentLoaderPlugin(parser, { nodes }), or use " +
        "THREE.WebGLRenderer",
    );
  }
  const given = renderer as Partial<WebGLRenderer>;
  if (!given?.capabilities?.maxTextureSize)
    throw new TypeError("three-lambent: update(renderer) wants a THREE.WebGLRenderer");
  if ((given.capabilities as { isWebGL2?: boolean }).isWebGL2 === false)
    throw new TypeError("three-lambent: relit assets need WebGL 2, and this renderer has WebGL 1");
}

export function isNodeRenderer(renderer: AnyRenderer): renderer is NodeRenderer {
  return (renderer as Partial<NodeRenderer> | undefined)?.isWebGPURenderer === true;
}
