// The JSON of LAMBENT_radiance_transfer with its blocks of numbers in place of the accessors that
// hold them: what is kept of an asset between reading and writing it.

import type { TypedArray } from "@gltf-transform/core";
import { kExtensionName, LambentFormatError } from "../format/description.js";

/** The numbers of one accessor that the extension alone points to. */
export class Block {
  constructor(
    readonly array: TypedArray,
    readonly type: "SCALAR" | "VEC3",
    /** Numbers of one receiver that is a vertex; 0: the block does not follow the vertices. */
    readonly each: number,
  ) {}
}

type Json = Record<string, unknown>;
/** Hands out accessor `index`, or throws with `place`. */
export type AccessorSource = (index: unknown, place: string) => Pick<Block, "array" | "type">;

/** Members that are indices of accessors, wherever they stand. */
const kAccessors = new Set([
  ...["accessor", "scales", "positions", "normals", "covered", "tangents"],
  "heights",
]);
/** Objects whose numbers belong to a picture, not to vertices. */
const kPictures = new Set(["idMap", "grid"]);

/** What is wrong with the extension in a file. */
export function fail(place: string, what: string): never {
  throw new LambentFormatError(`${place}: ${what}`);
}

export function isObject(value: unknown): value is Json {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/**
 * A copy of `json` in which every index of an accessor is a Block.
 *
 * @param vertices the vertices that blocks follow; 0: they follow none
 */
export function withBlocks(
  json: unknown,
  place: string,
  vertices: number,
  accessor: AccessorSource,
): unknown {
  if (Array.isArray(json))
    return json.map((item, i) => withBlocks(item, `${place}[${i}]`, vertices, accessor));
  if (!isObject(json)) return json;
  const copy: Json = {};
  for (const [key, value] of Object.entries(json)) {
    const at = `${place}.${key}`;
    if (!kAccessors.has(key)) {
      copy[key] = withBlocks(value, at, kPictures.has(key) ? 0 : vertices, accessor);
      continue;
    }
    const { array, type } = accessor(value, at);
    const each = vertices > 0 ? array.length / vertices : 0;
    if (!Number.isInteger(each) || (vertices > 0 && each === 0))
      fail(at, `${array.length} numbers, which ${vertices} vertices do not share evenly`);
    copy[key] = new Block(array.slice(), type, each);
  }
  return copy;
}

/** A copy of a tree in which every Block is what `make` says. */
export function mapBlocks(tree: unknown, make: (block: Block) => unknown): unknown {
  if (tree instanceof Block) return make(tree);
  if (Array.isArray(tree)) return tree.map((item) => mapBlocks(item, make));
  if (!isObject(tree)) return tree;
  return Object.fromEntries(Object.entries(tree).map(([k, v]) => [k, mapBlocks(v, make)]));
}

/** All blocks of a tree, in one sequence for trees of one shape. */
export function blocksOf(tree: unknown): Block[] {
  const blocks: Block[] = [];
  mapBlocks(tree, (block) => blocks.push(block));
  return blocks;
}

/** What trees have in common whose vertices may stand in one primitive. */
export function shapeOf(tree: unknown): string {
  const blocks = (b: Block) => `${b.array.constructor.name} ${b.type} ${b.each}`;
  return JSON.stringify(mapBlocks(tree, blocks));
}

/** Whether some numbers of a tree belong to a picture that one primitive alone can have. */
export function hasPicture(tree: unknown): boolean {
  return blocksOf(tree).some(({ each }) => each === 0);
}

/** The place of the extension in an object of the document. */
export const placeOf = (object: string) => `${object}.extensions.${kExtensionName}`;
