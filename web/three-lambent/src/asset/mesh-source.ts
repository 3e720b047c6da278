// What all instances of a mesh have in common: its triangles, its transfer, what the file says of
// its surface.

import {
  BufferAttribute,
  Texture,
  Vector3,
  type BufferGeometry,
  type Material,
  type Mesh,
} from "three";
import type { Numbers, PrimitiveTransfer, Vectors } from "../format/description.js";
import type { Coverage } from "../materials/coverage.js";
import { bandOf, evaluateHarmonics } from "../sh/basis.js";
import { clampedCosineMoments } from "../sh/zonal.js";
import { isBody } from "./closed.js";
import { isMirror, type Reflectance } from "./reflectance.js";
import { hasBacks } from "./two-sides.js";

/** A mesh as the loader made it, with what the file says of it. */
export interface MeshEntry {
  mesh: Mesh;
  /** Of "MESH/PRIMITIVE" in the document. */
  key: string;
  reflectance: Reflectance;
  coverage: Coverage;
}

export class MeshSource {
  /** As the loader made it. */
  readonly geometry: BufferGeometry;
  readonly original: Material;
  readonly key: string;
  readonly reflectance: Reflectance;
  readonly coverage: Coverage;
  /** For messages. */
  readonly what: string;
  /** What faces away is never to be seen. */
  readonly culled: boolean;
  /** Of a mirror: where what it shows is captured from, once that is known. */
  captureFrom: Vector3 | null = null;
  private threeEach: BufferGeometry | null = null;

  /** @param number of the mesh in its asset */
  constructor(
    { mesh, key, reflectance, coverage }: MeshEntry,
    readonly transfer: PrimitiveTransfer | null,
    readonly number: number,
  ) {
    this.geometry = mesh.geometry;
    this.original = mesh.material as Material;
    this.key = key;
    this.reflectance = reflectance;
    this.coverage = coverage;
    this.what = `mesh "${mesh.name}"`;
    this.culled = hasBacks(mesh.geometry) || isBody(mesh.geometry);
  }

  get map(): Texture | null {
    return (this.original as { map?: Texture | null }).map ?? null;
  }

  get colored(): boolean {
    return this.geometry.hasAttribute("color");
  }

  get uv(): boolean {
    return this.geometry.hasAttribute("uv");
  }

  /** The map, where there are places in it. */
  get texture(): Texture | null {
    return this.uv ? this.map : null;
  }

  /** Whether it lies on another mesh. */
  get layer(): boolean {
    return this.transfer?.biScale?.layer ?? false;
  }

  get isMirror(): boolean {
    return isMirror(this.reflectance);
  }

  /**
   * Three vertices for each triangle, which know the numbers of all three: fragment shaders of
   * WebGL2 are not told their triangle.
   */
  expanded(): BufferGeometry {
    if (this.threeEach) return this.threeEach;
    const { index } = this.geometry;
    const expanded = index ? this.geometry.toNonIndexed() : this.geometry.clone();
    const count = expanded.getAttribute("position").count;
    const corners = new Uint32Array(3 * count);
    for (let i = 0; i < count; ++i) {
      const first = i - (i % 3);
      for (let k = 0; k < 3; ++k) corners[3 * i + k] = index ? index.getX(first + k) : first + k;
    }
    expanded.setAttribute("lambentCorners", new BufferAttribute(corners, 3));
    expanded.boundingBox = this.geometry.boundingBox;
    expanded.boundingSphere = this.geometry.boundingSphere;
    this.threeEach = expanded;
    return expanded;
  }

  normals(): Float32Array {
    const normal = this.geometry.getAttribute("normal");
    const normals = new Float32Array(3 * normal.count);
    for (let i = 0; i < normal.count; ++i)
      normals.set([normal.getX(i), normal.getY(i), normal.getZ(i)], 3 * i);
    return normals;
  }

  /**
   * Whether {@link unshadowedVectors} leave the colour at vertices to the pixels: all but what was
   * baked in, where no texture takes part.
   */
  unshadowedOutside(stored: Vectors): boolean {
    const textured = this.map !== null && this.uv;
    return stored.albedoOutside || this.transfer?.grid != null || textured || !this.colored;
  }

  /** ρ/π Â_l y_i(N), of three channels. */
  unshadowedVectors(transfer: PrimitiveTransfer, stored: Vectors): Numbers {
    const { bands } = stored;
    const n = bands * bands;
    const normals = transfer.grid ? transfer.grid.normals : this.normals();
    const color = this.unshadowedOutside(stored) ? null : this.geometry.getAttribute("color");
    const cosine = clampedCosineMoments(bands);
    const y = new Float64Array(n);
    const data = new Float32Array(transfer.receivers * 3 * n);
    const rho = new Vector3();
    for (let p = 0; p < transfer.receivers; ++p) {
      const [nx, ny, nz] = normals.subarray(3 * p, 3 * p + 3);
      const length = Math.hypot(nx, ny, nz) || 1;
      evaluateHarmonics(bands, nx / length, ny / length, nz / length, y);
      rho.set(...this.reflectance.diffuse);
      if (color) rho.multiply(new Vector3(color.getX(p), color.getY(p), color.getZ(p)));
      for (let c = 0; c < 3; ++c) {
        const factor = rho.getComponent(c) / Math.PI;
        const to = (3 * p + c) * n;
        for (let i = 0; i < n; ++i) data[to + i] = factor * cosine[bandOf(i)] * y[i];
      }
    }
    return { encoding: "float32", data, scales: null, run: 0 };
  }

  /** Off every GPU; they come back when they are drawn. */
  freeGeometries(): void {
    this.geometry.dispose();
    this.threeEach?.dispose();
  }

  /** With the material that the loader made; pictures that the browser decoded are closed. */
  dispose(): void {
    this.freeGeometries();
    for (const value of Object.values(this.original)) {
      if (!(value instanceof Texture)) continue;
      value.dispose();
      const image = value.image as { close?: () => void } | null;
      image?.close?.();
    }
    this.original.dispose();
  }
}
