// What the mirrors of an asset show of it: captures of all other surfaces as they are lit, one for each
// mirror. They lie in the asset's frame: a camera does not change them, nor a turn but by the light.

import {
  Matrix3,
  Mesh,
  Scene,
  Vector2,
  Vector3,
  type Box3,
  type Matrix4,
  type WebGLRenderer,
} from "three";
import { captured as capturedGlsl } from "../generated/captured.js";
import { localCapture } from "../generated/localCapture.js";
import { canCapture, LocalCapture } from "../gpu/local-capture.js";
import { environmentGlsl, EnvironmentUniforms } from "../materials/environment-uniforms.js";
import { isNodeRenderer } from "../gpu/renderer.js";
import { boxOf, capturePlace } from "./mirror-place.js";
import type { Choices, RelitMesh } from "./relit-mesh.js";

/** Mirrors with a capture of their own, the largest ones; others look into the nearest. */
const kMostCaptures = 8;
/** What is nearer to a capture's place is not in it, in diagonals of the mirror. */
const kNear = 0.01;

const diagonalOf = (box: Box3) => box.getSize(new Vector3()).length();
const boxOfMesh = ({ source }: RelitMesh) => boxOf(source.geometry);

function captureAt(
  mesh: RelitMesh,
  meshes: readonly RelitMesh[],
  { min, max }: Box3,
): LocalCapture {
  // Backs that are not drawn hide nothing. Beside pictures of the CPU's, a ring around a ball
  // differs by 0.5 to 2.8/255 as captured from inside the ball, by 0.9 to 3.0/255 from beside it
  // (2026-11).
  const hiding = meshes.filter((each) => each !== mesh && !each.source.culled);
  const from = (mesh.source.captureFrom ??= capturePlace(
    mesh.source.geometry,
    hiding.map(({ source }) => source.geometry),
  ));
  const farthest = max.clone().sub(from).max(from.clone().sub(min)).length();
  const far = Math.max(1.01 * farthest, 1e-30);
  const near = Math.min(Math.max(kNear * diagonalOf(boxOfMesh(mesh)), 1e-6 * far), 0.1 * far);
  return new LocalCapture(from, near, far);
}

/** One capture, and who looks into it: first the mirror that it is drawn for, which is not in it. */
interface Captured {
  capture: LocalCapture;
  mirrors: RelitMesh[];
}

export class Mirrors {
  readonly environment = new EnvironmentUniforms();
  /** Of src/glsl/captured.glsl: of all surfaces that mirrors see. */
  readonly uniforms = {
    capturing: { value: false },
    worldFromAsset: { value: new Matrix3() }, // a turn
    captureScale: { value: new Vector2(1, 1) },
  };
  /** Text of the shaders of all surfaces that mirrors see. */
  readonly capturedSource = capturedGlsl;
  private meshes: readonly RelitMesh[] = [];
  private readonly captured: Captured[] = [];
  private readonly scene = new Scene();
  private readonly copies: Mesh[] = [];
  private done = "";

  /** Text of a mirror's shader: of the environment and, where it is captured, of the asset. */
  source({ captured }: Pick<Choices, "captured">): string {
    return environmentGlsl + (captured ? localCapture : "");
  }

  /**
   * @param meshes all of the asset
   * @param bounds of it
   */
  place(meshes: readonly RelitMesh[], bounds: Box3): void {
    this.meshes = meshes;
    const size = (mesh: RelitMesh) => diagonalOf(boxOfMesh(mesh));
    const mirrors = meshes.filter(({ isMirror }) => isMirror).sort((a, b) => size(b) - size(a));
    this.uniforms.captureScale.value.y = 1 / Math.max(diagonalOf(bounds), 1e-30);
    for (const mesh of mirrors)
      if (this.captured.length < kMostCaptures)
        this.captured.push({ capture: captureAt(mesh, meshes, bounds), mirrors: [mesh] });
      else this.nearest(boxOfMesh(mesh).getCenter(new Vector3())).mirrors.push(mesh);
    this.scene.matrixWorldAutoUpdate = false;
    for (const _ of meshes) this.copies.push(new Mesh());
    this.scene.add(...this.copies);
  }

  /** Texels of a side of captures. 0: mirrors see nothing of the asset. */
  sizeOn(renderer: WebGLRenderer, wanted: number): number {
    if (this.captured.length === 0 || isNodeRenderer(renderer)) return 0;
    if (!canCapture(renderer)) return 0;
    return Math.min(Math.floor(wanted), renderer.capabilities.maxCubemapSize);
  }

  /** Whether mirrors show mirrors, and in these the world. */
  get seeEachOther(): boolean {
    return this.captured.reduce((sum, { mirrors }) => sum + mirrors.length, 0) > 1;
  }

  private nearest(to: Vector3): Captured {
    const away = ({ capture }: Captured) => capture.from.distanceTo(to);
    return this.captured.reduce((a, b) => (away(b) < away(a) ? b : a));
  }

  /** Whether captures are not of this state, which tells all that they show. */
  due(state: string): boolean {
    return state !== this.done;
  }

  /**
   * @param size texels of a side of a capture
   * @param radiance about what there is: halves hold 10⁻⁵ to 10⁴ of it
   */
  draw(
    renderer: WebGLRenderer,
    state: string,
    worldFromAsset: Matrix4,
    size: number,
    radiance: number,
  ): void {
    const { capturing, captureScale, worldFromAsset: turn } = this.uniforms;
    captureScale.value.x = radiance > 0 ? 2 ** -Math.round(Math.log2(radiance)) : 1;
    const scale = worldFromAsset.getMaxScaleOnAxis();
    turn.value.setFromMatrix4(worldFromAsset).multiplyScalar(1 / scale);
    for (const { mirrors } of this.captured) for (const mirror of mirrors) mirror.lookInto(null);
    capturing.value = true;
    try {
      // Twice, so that each shows mirrors that show the asset; the last one does so at once.
      for (const each of [...this.captured, ...this.captured.slice(0, -1)])
        this.drawOne(renderer, each, size);
    } finally {
      capturing.value = false;
    }
    this.done = state;
  }

  private drawOne(renderer: WebGLRenderer, { capture, mirrors }: Captured, size: number): void {
    this.meshes.forEach((each, i) => {
      const { geometry, visible, renderOrder } = each.mesh;
      Object.assign(this.copies[i], {
        geometry,
        renderOrder,
        material: each.material,
        visible: visible && each !== mirrors[0],
      });
    });
    // What is drawn into cannot be looked into.
    for (const mirror of mirrors) mirror.lookInto(null);
    capture.draw(renderer, this.scene, size);
    const { y: scale } = this.uniforms.captureScale.value;
    const from = capture.from.clone().multiplyScalar(scale);
    for (const mirror of mirrors) mirror.lookInto({ texture: capture.texture!, from });
  }

  /** They are to be made again: the GPU has lost them, or they are not wanted. */
  forget(): void {
    for (const { capture, mirrors } of this.captured) {
      for (const mirror of mirrors) mirror.lookInto(null);
      capture.dispose();
    }
    this.done = "";
  }

  dispose(): void {
    this.forget();
    this.environment.dispose();
  }
}
