// Draws a scene of the package's own into a target, and leaves the renderer as it was.

import { Color, type Camera, type Scene, type WebGLRenderer, type WebGLRenderTarget } from "three";

/** What is cleared before anything is drawn: its depth, or all of it to zeros. */
export type Cleared = "nothing" | "depth" | "all";

/** @param face of a cube map: +x, −x, +y, −y, +z, −z */
export function renderInto(
  renderer: WebGLRenderer,
  scene: Scene,
  camera: Camera,
  target: WebGLRenderTarget | null,
  cleared: Cleared = "nothing",
  face = 0,
): void {
  const before = {
    target: renderer.getRenderTarget(),
    face: renderer.getActiveCubeFace(),
    level: renderer.getActiveMipmapLevel(),
    color: renderer.getClearColor(new Color()),
    alpha: renderer.getClearAlpha(),
    autoClear: renderer.autoClear,
    planes: renderer.clippingPlanes,
    xr: renderer.xr.enabled,
    shadows: renderer.shadowMap.autoUpdate,
  };
  try {
    renderer.autoClear = false;
    renderer.clippingPlanes = [];
    renderer.xr.enabled = false;
    renderer.shadowMap.autoUpdate = false;
    renderer.setRenderTarget(target, face);
    if (cleared === "all") renderer.setClearColor(0x000000, 0);
    if (cleared !== "nothing") renderer.clear(cleared === "all", true, false);
    renderer.render(scene, camera);
  } finally {
    renderer.setRenderTarget(before.target, before.face, before.level);
    if (cleared === "all") renderer.setClearColor(before.color, before.alpha);
    renderer.autoClear = before.autoClear;
    renderer.clippingPlanes = before.planes;
    renderer.xr.enabled = before.xr;
    renderer.shadowMap.autoUpdate = before.shadows;
  }
}
