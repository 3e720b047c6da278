// Depth buffers of renderers that reverse them: there clip space is 0 … 1, three turns comparisons
// and the cleared depth around, and a camera's projection has 1 at its near plane.

import { Matrix4, type Camera, type WebGLRenderer } from "three";

/** Whether a renderer has `reversedDepthBuffer` (before three 0.179 `reverseDepthBuffer`). */
export function reversesDepth(renderer: WebGLRenderer): boolean {
  const { reversedDepthBuffer, reverseDepthBuffer } = renderer.capabilities as {
    reversedDepthBuffer?: boolean;
    reverseDepthBuffer?: boolean;
  };
  return Boolean(reversedDepthBuffer || reverseDepthBuffer);
}

const fromReversed = new Matrix4().set(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, 1, 0, 0, 0, 1);

/** A camera's projection as in an ordinary clip space: −1 at its near plane, 1 at its far plane. */
export function ordinaryProjection(camera: Camera): Matrix4 {
  const projection = camera.projectionMatrix.clone();
  return (camera as { reversedDepth?: boolean }).reversedDepth
    ? projection.premultiply(fromReversed)
    : projection;
}
