// A primitive as it was read: its transfer, and what of its vertices transfer stands on. Immutable,
// and shared by all copies of the primitive.

import type { Material, Primitive } from "@gltf-transform/core";
import type { BufferGeometry } from "three";
import { hasBacks } from "../asset/two-sides.js";
import { blocksOf, hasPicture, isObject, shapeOf } from "./blocks.js";

/** The document's object, shared by all primitives of one bake. */
export interface Bake {
  /** JSON with Blocks. */
  readonly tree: Record<string, unknown>;
  /** The box of all that was read with transfer. */
  readonly low: number[];
  readonly high: number[];
}

/** What of a material and its primitive enters the light that leaves it. */
export interface Colour {
  /** The UV set of baseColorTexture; −1: none. */
  readonly texture: number;
  /** Whether there is a COLOR_0. */
  readonly vertices: boolean;
  /** Factors: base colour, metallic, roughness. */
  readonly factors: readonly number[];
}

export interface Source {
  /** Tells sources apart within a process; its low 16 bits are at least 2. */
  readonly number: number;
  /** "meshes[0].primitives[0]" of the file that was read. */
  readonly place: string;
  readonly bake: Bake;
  /** The primitive's object: JSON with Blocks. */
  readonly tree: Record<string, unknown>;
  /** POSITION, NORMAL and the UVs that transfer is looked up with. */
  readonly attributes: ReadonlyMap<string, { array: Float32Array; size: number }>;
  /** Of a vertex, the first one that stands at the same place and has the same transfer. */
  readonly first: Uint32Array;
  /** Of a vertex on one of two sides, that behind it; null: there is one side. */
  readonly behind: ReadonlyMap<number, number> | null;
  readonly colour: Colour;
  /** The largest side of its box. */
  readonly extent: number;
  /** The name of the attribute that says which receiver a vertex is. */
  readonly semantic: string;
}

const kPrefix = "_LAMBENT_RECEIVER_";
let count = 0;

/** A number that no other source has. Tools that quantise leave attributes alone that exceed 1. */
function nextNumber(): number {
  count += 1;
  if ((count & 0xffff) < 2) count += 2;
  return count >>> 0;
}

export const isReceiverSemantic = (semantic: string) => semantic.startsWith(kPrefix);

export function receiverSemantic(primitive: Primitive): string | undefined {
  return primitive.listSemantics().find(isReceiverSemantic);
}

export function colourOf(primitive: Primitive): Colour {
  const material: Material | null = primitive.getMaterial();
  return {
    texture: material?.getBaseColorTexture()
      ? (material.getBaseColorTextureInfo()?.getTexCoord() ?? 0)
      : -1,
    vertices: primitive.getAttribute("COLOR_0") !== null,
    factors: material
      ? [
          ...material.getBaseColorFactor(),
          material.getMetallicFactor(),
          material.getRoughnessFactor(),
        ]
      : [],
  };
}

/** The numbers of an attribute as floats, of the vertices one after the other. */
export function floatsOf(primitive: Primitive, semantic: string): Float32Array | null {
  const accessor = primitive.getAttribute(semantic);
  const array = accessor?.getArray();
  if (!accessor || !array) return null;
  if (array instanceof Float32Array) return array;
  const size = accessor.getElementSize();
  const floats = new Float32Array(accessor.getCount() * size);
  const element: number[] = [];
  for (let i = 0; i < accessor.getCount(); ++i)
    floats.set(accessor.getElement(i, element), i * size);
  return floats;
}

/** FNV-1a: a short name for a long one. */
function hashOf(text: string): string {
  let hash = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i)
    hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193) >>> 0;
  return hash.toString(16).toUpperCase().padStart(8, "0");
}

/** As hasBacks of the loader, of plain arrays. */
function twoSided(positions: Float32Array, indices: ArrayLike<number> | null): boolean {
  if (!indices) return false;
  const position = {
    getX: (i: number) => positions[3 * i],
    getY: (i: number) => positions[3 * i + 1],
    getZ: (i: number) => positions[3 * i + 2],
  };
  const index = { count: indices.length, getX: (i: number) => indices[i] };
  return hasBacks({ getAttribute: () => position, index } as unknown as BufferGeometry);
}

/** Whether a primitive's triangles are fronts, and then their backs in the same sequence. */
export function hasTwoSides(primitive: Primitive): boolean {
  const positions = floatsOf(primitive, "POSITION");
  return positions !== null && twoSided(positions, primitive.getIndices()?.getArray() ?? null);
}

/** Of each vertex, the first one whose attributes and transfer have the same bytes. */
function firstAlike(
  vertices: number,
  attributes: Source["attributes"],
  tree: unknown,
): Uint32Array {
  const bytes = (array: ArrayBufferView, each: number) => ({
    each: (each * array.byteLength) / ((array as Float32Array).length || 1),
    data: new Uint8Array(array.buffer, array.byteOffset, array.byteLength),
  });
  const keys = [...attributes.values()].map(({ array, size }) => bytes(array, size));
  const rows = blocksOf(tree)
    .filter(({ each }) => each > 0)
    .map(({ array, each }) => bytes(array, each));
  const alike = (a: number, b: number) =>
    [...keys, ...rows].every(({ data, each }) => {
      for (let i = 0; i < each; ++i) if (data[a * each + i] !== data[b * each + i]) return false;
      return true;
    });
  const first = new Uint32Array(vertices);
  const seen = new Map<number, number[]>();
  for (let vertex = 0; vertex < vertices; ++vertex) {
    let hash = 0x811c9dc5;
    for (const { data, each } of keys)
      for (let i = 0; i < each; ++i) hash = Math.imul(hash ^ data[vertex * each + i], 0x01000193);
    const others = seen.get(hash);
    const same = others?.find((other) => alike(other, vertex));
    first[vertex] = same ?? vertex;
    if (same !== undefined) continue;
    if (others) others.push(vertex);
    else seen.set(hash, [vertex]);
  }
  return first;
}

/** Of every vertex on a front, that behind it. */
function backsOf(indices: ArrayLike<number>): Map<number, number> {
  const behind = new Map<number, number>();
  const corners = indices.length / 2;
  for (let i = 0; i < corners; i += 3) {
    const k = i + corners;
    behind.set(indices[i], indices[k]);
    behind.set(indices[i + 1], indices[k + 2]);
    behind.set(indices[i + 2], indices[k + 1]);
  }
  return behind;
}

/** UV sets that transfer is looked up with. */
function uvsOf(tree: Record<string, unknown>): string[] {
  if (isObject(tree.grid)) return [`TEXCOORD_${tree.grid.texCoord === 1 ? 1 : 0}`];
  return isObject(tree.biScale) ? ["TEXCOORD_0"] : [];
}

/** What has been read of a primitive. Its attributes have been checked to be there. */
export function sourceOf(
  primitive: Primitive,
  place: string,
  bake: Bake,
  tree: Record<string, unknown>,
): Source {
  const attributes = new Map<string, { array: Float32Array; size: number }>();
  for (const semantic of ["POSITION", "NORMAL", ...uvsOf(tree)]) {
    const array = floatsOf(primitive, semantic) as Float32Array;
    const size = semantic.startsWith("TEXCOORD") ? 2 : 3;
    attributes.set(semantic, { array: array.slice(), size });
  }
  const positions = (attributes.get("POSITION") as { array: Float32Array }).array;
  const indices = primitive.getIndices()?.getArray() ?? null;
  const vertices = positions.length / 3;
  const behind = indices && twoSided(positions, indices) ? backsOf(indices) : null;
  // Vertices with another one behind them are told apart, so that these pairs stay.
  const first = behind
    ? Uint32Array.from({ length: vertices }, (_, i) => i)
    : firstAlike(vertices, attributes, tree);
  const number = nextNumber();
  const shape = `${shapeOf(tree)} ${behind !== null} ${hasPicture(tree) ? number : ""}`;
  const box = [0, 1, 2].map((c) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = c; i < positions.length; i += 3) {
      low = Math.min(low, positions[i]);
      high = Math.max(high, positions[i]);
    }
    bake.low[c] = Math.min(bake.low[c], low);
    bake.high[c] = Math.max(bake.high[c], high);
    return high - low;
  });
  return {
    ...{ number, place, bake, tree, attributes, first, behind },
    colour: colourOf(primitive),
    extent: Math.max(...box),
    semantic: `${kPrefix}${hashOf(shape)}`,
  };
}

/** For every vertex as it was read: its source's number and its own, 16 bits a component. */
export function receiversOf({ number, first }: Source): Uint16Array {
  const receivers = new Uint16Array(4 * first.length);
  for (const [i, vertex] of first.entries())
    receivers.set([number & 0xffff, number >>> 16, vertex & 0xffff, vertex >>> 16], 4 * i);
  return receivers;
}
