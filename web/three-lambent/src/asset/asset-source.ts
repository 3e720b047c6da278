// What all instances of an asset have in common: what its file holds, and that on GPUs.

import type { WebGLRenderer } from "three";
import type { AssetDescription } from "../format/description.js";
import type { LambentNodes } from "../gpu/nodes.js";
import { SharedThings } from "../gpu/shared.js";
import type { Extras } from "./extras.js";
import { MeshSource, type MeshEntry } from "./mesh-source.js";

/** How incident light comes to fragments: interpolated, or fetched at the triangle's corners. */
export type IncidentMode = "auto" | "varyings" | "fetch";

export class AssetSource {
  readonly meshes: readonly MeshSource[];
  /** What was said about it, so that it is said once. */
  readonly said = new Set<string>();
  private readonly things = new WeakMap<WebGLRenderer, SharedThings>();
  private users = 0;

  constructor(
    readonly description: AssetDescription,
    entries: readonly MeshEntry[],
    readonly incident: IncidentMode,
    readonly extras: Extras,
    /** For WebGPURenderer. */
    readonly nodes: LambentNodes | null = null,
  ) {
    this.meshes = entries.map(
      (entry, i) => new MeshSource(entry, description.primitives.get(entry.key) ?? null, i),
    );
  }

  thingsOn(renderer: WebGLRenderer): SharedThings {
    let things = this.things.get(renderer);
    if (!things) {
      things = new SharedThings();
      this.things.set(renderer, things);
    }
    return things;
  }

  /** What was there is to be made again: the GPU has lost it. */
  forget(renderer: WebGLRenderer): void {
    this.things.delete(renderer);
  }

  retain(): void {
    ++this.users;
  }

  /** The last one frees what the loader made. */
  release(): void {
    if (--this.users === 0) for (const mesh of this.meshes) mesh.dispose();
  }
}
