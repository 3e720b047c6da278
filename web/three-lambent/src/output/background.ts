// The environment behind an asset.

import {
  BufferGeometry,
  Float32BufferAttribute,
  Matrix4,
  Mesh,
  ShaderMaterial,
  Vector4,
} from "three";
import type { LambentAsset } from "../asset/asset.js";
import { backgroundFrag } from "../generated/backgroundFrag.js";
import { backgroundVert } from "../generated/backgroundVert.js";
import type { Environment } from "../materials/environment.js";
import { environmentGlsl, EnvironmentUniforms } from "../materials/environment-uniforms.js";
import { isNodeRenderer } from "../gpu/renderer.js";
import { kNoAir, type AirMode } from "../materials/surroundings.js";

/**
 * Shows an environment behind everything, looked up as mirrors look it up (three's own background
 * filters it otherwise, and knows no discs). Add it to the scene.
 */
export class EnvironmentBackground extends Mesh<BufferGeometry, ShaderMaterial> {
  private readonly shown = new EnvironmentUniforms();
  private asset: LambentAsset | null = null;
  private air: AirMode = "none";
  private refused = false;

  constructor(environment: Environment | null = null) {
    const geometry = new BufferGeometry();
    geometry.setAttribute(
      "position",
      new Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3),
    );
    super(geometry);
    this.material = this.makeMaterial();
    this.frustumCulled = false;
    this.renderOrder = 1; // behind what is there: pixels that are covered cost nothing
    this.raycast = () => {};
    this.onBeforeRender = (renderer, _scene, camera) => {
      if (isNodeRenderer(renderer)) this.refuse();
      const { worldFromClip, eye } = this.material.uniforms;
      worldFromClip.value.copy(camera.matrixWorld).multiply(camera.projectionMatrixInverse);
      const c = camera.matrixWorld.elements;
      if (camera.projectionMatrix.elements[15] === 1) eye.value.set(c[8], c[9], c[10], 0);
      else eye.value.set(c[12], c[13], c[14], 1);
      this.material.uniformsNeedUpdate = true;
    };
    this.setEnvironment(environment);
  }

  setEnvironment(environment: Environment | null): void {
    this.shown.set(environment);
  }

  /**
   * The asset that is seen before it: its air ({@link LambentAsset.setAir}) lies before the ground below
   * the horizon, and its shafts of light before the sky, which is air already; null: none does. Say it
   * again when the asset's Sun or air came or went.
   */
  setAsset(asset: LambentAsset | null): void {
    const air = asset?.airMode ?? "none";
    const seen = air === "none" ? null : asset;
    if (seen === this.asset && air === this.air) return;
    this.asset = seen;
    this.air = air;
    this.material.dispose();
    this.material = this.makeMaterial();
  }

  /** Once: three draws nothing of it. */
  private refuse(): void {
    if (this.refused) return;
    this.refused = true;
    console.warn(
      "three-lambent: EnvironmentBackground is not drawn by WebGPURenderer: give scene.background " +
        "the map, or use THREE.WebGLRenderer",
    );
  }

  private makeMaterial(): ShaderMaterial {
    const air = this.asset?.air;
    return new ShaderMaterial({
      vertexShader: backgroundVert,
      fragmentShader: `${environmentGlsl}${air?.source(this.air) ?? kNoAir}${backgroundFrag}`,
      uniforms: {
        worldFromClip: { value: new Matrix4() },
        eye: { value: new Vector4() },
        ...this.shown.uniforms,
        ...(air && { ...air.uniforms, assetFromWorld: { value: air.assetFromWorld } }),
      },
      depthWrite: false,
    });
  }

  override dispose(): void {
    this.removeFromParent();
    this.geometry.dispose();
    this.material.dispose();
    this.shown.dispose();
  }
}
