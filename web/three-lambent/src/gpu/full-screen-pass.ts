// Draws one triangle over a whole render target, and leaves the renderer as it was.

import {
  BufferGeometry,
  Float32BufferAttribute,
  Mesh,
  Scene,
  type Material,
  type WebGLRenderer,
  type WebGLRenderTarget,
} from "three";
import { PassCamera } from "./pass-camera.js";
import { renderInto } from "./render-into.js";

export class FullScreenPass {
  private readonly geometry = new BufferGeometry();
  private readonly scene = new Scene();
  private readonly camera = new PassCamera();
  private readonly mesh = new Mesh(this.geometry);

  constructor() {
    const corners = [-1, -1, 0, 3, -1, 0, -1, 3, 0];
    this.geometry.setAttribute("position", new Float32BufferAttribute(corners, 3));
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
    this.scene.matrixWorldAutoUpdate = false;
  }

  render(renderer: WebGLRenderer, material: Material, target: WebGLRenderTarget | null): void {
    this.mesh.material = material;
    renderInto(renderer, this.scene, this.camera, target);
  }

  dispose(): void {
    this.geometry.dispose();
  }
}
