// Draws a scene of the package's own into a target, and leaves the renderer as it was.

import type { Camera, Scene, WebGLRenderer, WebGLRenderTarget } from "three";

/** @param clearDepth before anything is drawn; nothing else is cleared */
export function renderInto(
  renderer: WebGLRenderer,
  scene: Scene,
  camera: Camera,
  target: WebGLRenderTarget | null,
  clearDepth = false,
): void {
  const before = {
    target: renderer.getRenderTarget(),
    face: renderer.getActiveCubeFace(),
    level: renderer.getActiveMipmapLevel(),
    autoClear: renderer.autoClear,
    xr: renderer.xr.enabled,
    shadows: renderer.shadowMap.autoUpdate,
  };
  renderer.autoClear = false;
  renderer.xr.enabled = false;
  renderer.shadowMap.autoUpdate = false;
  renderer.setRenderTarget(target);
  if (clearDepth) renderer.clear(false, true, false);
  renderer.render(scene, camera);
  renderer.setRenderTarget(before.target, before.face, before.level);
  renderer.autoClear = before.autoClear;
  renderer.xr.enabled = before.xr;
  renderer.shadowMap.autoUpdate = before.shadows;
}
