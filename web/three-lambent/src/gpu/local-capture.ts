// A cube map of what stands around a place of an asset, with distances: shaders/local_capture.glsl.

import {
  HalfFloatType,
  NearestFilter,
  NoColorSpace,
  PerspectiveCamera,
  RGBAFormat,
  Vector3,
  WebGLCubeRenderTarget,
  type CubeTexture,
  type Scene,
  type WebGLRenderer,
} from "three";
import { renderInto } from "./render-into.js";

// As GL looks faces up: a face's first row is the lowest of its picture, its columns run to the right.
type Triple = readonly [number, number, number];
const kFaces: readonly { forward: Triple; up: Triple }[] = [
  { forward: [1, 0, 0], up: [0, -1, 0] },
  { forward: [-1, 0, 0], up: [0, -1, 0] },
  { forward: [0, 1, 0], up: [0, 0, 1] },
  { forward: [0, -1, 0], up: [0, 0, -1] },
  { forward: [0, 0, 1], up: [0, -1, 0] },
  { forward: [0, 0, -1], up: [0, -1, 0] },
];

/** Whether the device draws into halves. */
export function canCapture(renderer: WebGLRenderer): boolean {
  const { extensions } = renderer;
  return extensions.has("EXT_color_buffer_float") || extensions.has("EXT_color_buffer_half_float");
}

export class LocalCapture {
  private target: WebGLCubeRenderTarget | null = null;
  private readonly camera = new PerspectiveCamera(90, 1);

  /**
   * @param from the place
   * @param near of what is drawn; nothing of it is nearer
   * @param far nothing is farther away
   */
  constructor(
    readonly from: Vector3,
    near: number,
    far: number,
  ) {
    this.camera.position.copy(from);
    this.camera.near = near;
    this.camera.far = far;
    this.camera.updateProjectionMatrix();
  }

  /** null until it is drawn. */
  get texture(): CubeTexture | null {
    return this.target?.texture ?? null;
  }

  /** @param size texels of a side */
  draw(renderer: WebGLRenderer, scene: Scene, size: number): void {
    if (this.target?.width !== size) {
      this.dispose();
      this.target = new WebGLCubeRenderTarget(size, {
        format: RGBAFormat,
        type: HalfFloatType,
        colorSpace: NoColorSpace,
        minFilter: NearestFilter,
        magFilter: NearestFilter,
        generateMipmaps: false,
      });
    }
    for (const [face, { forward, up }] of kFaces.entries()) {
      this.camera.up.set(...up);
      this.camera.lookAt(target.set(...forward).add(this.from));
      renderInto(renderer, scene, this.camera, this.target, "all", face);
    }
  }

  dispose(): void {
    this.target?.dispose();
    this.target = null;
  }
}

const target = new Vector3();
