// A camera of passes whose shaders know where things stand.

import { Camera } from "three";

export class PassCamera extends Camera {
  /** Renderers with a reversed depth buffer ask every camera for it. */
  updateProjectionMatrix(): void {}
}
