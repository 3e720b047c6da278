// A document as it is written: rows of transfer gathered for the vertices as they are now,
// positions and normals as they were baked, triangles of two sides in their sequence. What was
// changed for that is put back afterwards.

import {
  BufferUtils,
  Primitive,
  type Buffer,
  type Document,
  type GLTF,
  type Mesh,
  type TypedArray,
  type WriterContext,
} from "@gltf-transform/core";
import { kExtensionName } from "../format/description.js";
import { Block, blocksOf, fail, mapBlocks, placeOf } from "./blocks.js";
import { Changes, keepFromMeshopt } from "./changes.js";
import { checkColour, checkNode, checkPrimitive, checkUvs } from "./checks.js";
import { hasTwoSides, receiverSemantic, type Bake, type Source } from "./source.js";

export interface Prepared {
  /** Puts the numbers of transfer into buffers. */
  store(context: WriterContext): void;
  /** Puts the extension's objects into the JSON. */
  write(context: WriterContext): void;
  /** Leaves the document as it was before. */
  undo(): void;
}

/** A primitive whose vertices are known: of each, its source and which of its vertices it is. */
export interface Carrier {
  readonly place: string;
  readonly mesh: Mesh;
  readonly primitive: Primitive;
  readonly semantic: string;
  readonly sources: readonly Source[];
  /** Index into `sources`. */
  readonly of: Uint32Array;
  readonly vertex: Uint32Array;
}

/** Reads the attribute that names receivers; null for a primitive without transfer. */
function carrierOf(
  mesh: Mesh,
  primitive: Primitive,
  place: string,
  known: ReadonlyMap<number, Source>,
): Carrier | null {
  const semantic = receiverSemantic(primitive);
  const property = primitive.getExtension(kExtensionName);
  if (!semantic) {
    if (property)
      fail(
        place,
        "an attribute _LAMBENT_RECEIVER_… was taken away, which transfer follows: leave it alone",
      );
    return null;
  }
  const names = primitive.getAttribute(semantic)?.getArray() ?? new Uint16Array(0);
  const count = names.length / 4;
  if (count === 0 || count !== primitive.getAttribute("POSITION")?.getCount())
    fail(place, "its attributes do not have as many elements each");
  const sources: Source[] = [];
  const indexOf = new Map<number, number>();
  const [of, vertex] = [new Uint32Array(count), new Uint32Array(count)];
  for (let i = 0; i < count; ++i) {
    const number = names[4 * i] + 65536 * names[4 * i + 1];
    let index = indexOf.get(number);
    if (index === undefined) {
      const source = known.get(number);
      if (!source) fail(place, `vertex ${i} has lost its transfer: bake the scene as it is now`);
      index = sources.push(source) - 1;
      indexOf.set(number, index);
    }
    of[i] = index;
    vertex[i] = names[4 * i + 2] + 65536 * names[4 * i + 3];
    if (vertex[i] >= sources[index].first.length)
      fail(place, `vertex ${i} has lost its transfer: bake the scene as it is now`);
  }
  return { place, mesh, primitive, semantic, sources, of, vertex };
}

/** Elements of `arrays` (one of each source), for the vertices as they are now. */
function gather<T extends TypedArray>(
  { of, vertex }: Carrier,
  arrays: readonly T[],
  each: number,
): T {
  const rows = new (arrays[0].constructor as new (n: number) => T)(of.length * each);
  for (let i = 0; i < of.length; ++i) {
    const from = vertex[i] * each;
    rows.set(arrays[of[i]].subarray(from, from + each) as never, i * each);
  }
  return rows;
}

/** The primitive's object for the vertices as they are now. Sources have one shape. */
function gatherTree(carrier: Carrier): unknown {
  const { sources, semantic } = carrier;
  if (sources.some((source) => source.semantic !== semantic))
    fail(carrier.place, "joins primitives whose transfer is of different kinds");
  const lists = sources.map(({ tree }) => blocksOf(tree));
  let next = 0;
  return mapBlocks(sources[0].tree, (block) => {
    const arrays = lists.map((list) => list[next].array);
    next += 1;
    return block.each === 0
      ? block
      : new Block(gather(carrier, arrays, block.each), block.type, block.each);
  });
}

/** Indices with every front before the backs, or null where they are that already. */
function sortTwoSides({ primitive, sources, of, vertex, place }: Carrier): Uint32Array | null {
  if (!sources[0].behind || hasTwoSides(primitive)) return null;
  const indices = primitive.getIndices()?.getArray() ?? Array.from(vertex.keys());
  // Of a vertex as it was read, the one that it is now; one of them, where they were split.
  const now = sources.map(() => new Map<number, number>());
  for (let i = 0; i < of.length; ++i) now[of[i]].set(vertex[i], i);
  const one = (i: number) => now[of[i]].get(vertex[i]) as number;
  const behind = (i: number) => {
    const other = sources[of[i]].behind?.get(vertex[i]);
    return other === undefined ? undefined : now[of[i]].get(other);
  };
  const [fronts, backs]: [number[], number[]] = [[], []];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [indices[i], indices[i + 1], indices[i + 2]];
    const [a2, b2, c2] = [behind(a), behind(b), behind(c)];
    if (a2 === undefined || b2 === undefined || c2 === undefined) continue;
    fronts.push(one(a), one(b), one(c));
    backs.push(a2, c2, b2);
  }
  if (2 * fronts.length !== indices.length)
    fail(
      place,
      "has two sides, whose triangles no longer match: " +
        "leave simplify() out, or apply it before the bake",
    );
  return Uint32Array.from([...fronts, ...backs]);
}

/** The document's object. Whatever carries transfer comes from one bake. */
function bakeOf(whole: Bake | null, carriers: readonly Carrier[]): Bake | null {
  const bakes = new Set(carriers.flatMap(({ sources }) => sources.map(({ bake }) => bake)));
  if (whole) bakes.add(whole);
  if (bakes.size > 1)
    fail(
      placeOf("").slice(1),
      "the document joins assets that were baked apart and do not shade each other: " +
        "bake them together",
    );
  return [...bakes][0] ?? null;
}

const arraysOf = (sources: readonly Source[], semantic: string) =>
  sources.map(({ attributes }) => (attributes.get(semantic) as { array: Float32Array }).array);

const same = (a: TypedArray, b: TypedArray) =>
  a.length === b.length && (a as Float32Array).every((value, i) => value === b[i]);

const kComponentTypes: Record<string, GLTF.AccessorComponentType> = {
  ...{ Int8Array: 5120, Uint8Array: 5121, Int16Array: 5122 },
  ...{ Uint16Array: 5123, Uint32Array: 5125, Float32Array: 5126 },
};

/** Puts a block into a buffer of its own view; the index of its accessor, once that is known. */
function store({ array, type }: Block, buffer: Buffer, context: WriterContext) {
  const { json } = context.jsonDoc;
  const data = BufferUtils.pad(BufferUtils.toView(array));
  const views = context.otherBufferViews.get(buffer) ?? [];
  context.otherBufferViews.set(buffer, [...views, data]);
  const componentType = kComponentTypes[array.constructor.name];
  const def = { type, componentType, count: array.length / (type === "VEC3" ? 3 : 1) };
  json.accessors?.push(def as GLTF.IAccessor);
  return { def: def as GLTF.IAccessor, data, index: (json.accessors?.length ?? 0) - 1 };
}

/**
 * Gives transfer to vertices as they are now; throws before anything was changed where it cannot.
 *
 * @param whole the document's object, where the document was read with one
 */
export function prepare(
  document: Document,
  whole: Bake | null,
  known: ReadonlyMap<number, Source>,
): Prepared {
  const root = document.getRoot();
  const carriers: Carrier[] = [];
  for (const [m, mesh] of root.listMeshes().entries())
    for (const [p, primitive] of mesh.listPrimitives().entries()) {
      const carrier = carrierOf(mesh, primitive, `meshes[${m}].primitives[${p}]`, known);
      if (carrier) carriers.push(carrier);
    }
  const bake = bakeOf(whole, carriers);
  for (const carrier of carriers) {
    checkPrimitive(document, carrier);
    checkColour(document, carrier);
    checkUvs(carrier);
  }
  const nodes = new Set(carriers.map((carrier) => checkNode(document, carrier)));
  const made = carriers.map((carrier) => ({
    ...{ carrier, tree: gatherTree(carrier), indices: sortTwoSides(carrier) },
  }));

  const changes = new Changes(document);
  for (const { carrier, indices } of made) {
    const { primitive, sources } = carrier;
    for (const [semantic, { size }] of sources[0].attributes) {
      const baked = gather(carrier, arraysOf(sources, semantic), size);
      const accessor = primitive.getAttribute(semantic);
      const now = accessor?.getArray();
      const plain = now instanceof Float32Array && accessor && !accessor.getSparse();
      if (!plain || !same(now, baked)) changes.setAttribute(primitive, semantic, baked);
    }
    if (indices)
      changes.setIndices(
        primitive,
        carrier.of.length < 65535 ? Uint16Array.from(indices) : indices,
      );
    changes.setAttribute(primitive, carrier.semantic, null);
  }
  changes.removeReplaced();
  // Readers of transfer read no sparse accessors.
  const primitives = root.listMeshes().flatMap((mesh) => mesh.listPrimitives());
  for (const primitive of bake ? primitives : [])
    for (const accessor of [...primitive.listAttributes(), primitive.getIndices()])
      if (accessor?.getSparse())
        changes.make(
          () => accessor.setSparse(false),
          () => accessor.setSparse(true),
        );
  for (const node of nodes) {
    if (!node) continue;
    const before = node.getMatrix();
    changes.make(
      () => node.setTranslation([0, 0, 0]).setRotation([0, 0, 0, 1]).setScale([1, 1, 1]),
      () => node.setMatrix(before),
    );
  }
  const twoSided = carriers.filter(({ sources }) => sources[0].behind);
  if (bake)
    keepFromMeshopt(
      document,
      changes,
      twoSided.map(({ primitive }) => primitive),
    );

  const stored: ReturnType<typeof store>[] = [];
  let object: unknown;
  const objects = new Map<Primitive, unknown>();
  return {
    undo: () => changes.undo(),
    store: (context) => {
      const put = (tree: unknown, buffer: Buffer) =>
        mapBlocks(tree, (block) => {
          const entry = store(block, buffer, context);
          stored.push(entry);
          return entry.index;
        });
      const [first] = root.listBuffers();
      if (bake) object = put(bake.tree, first);
      for (const { carrier, tree } of made) {
        const buffer = carrier.primitive.getAttribute("POSITION")?.getBuffer() ?? first;
        objects.set(carrier.primitive, put(tree, buffer));
      }
    },
    write: (context) => {
      const { json } = context.jsonDoc;
      for (const { def, data } of stored)
        def.bufferView = context.otherBufferViewsIndexMap.get(data);
      if (bake) json.extensions = { ...json.extensions, [kExtensionName]: object };
      for (const { mesh, primitive } of carriers) {
        const at = mesh.listPrimitives().indexOf(primitive);
        const def = json.meshes?.[context.meshIndexMap.get(mesh) as number].primitives[at];
        if (!def) continue;
        def.mode = Primitive.Mode.TRIANGLES;
        def.extensions = { ...def.extensions, [kExtensionName]: objects.get(primitive) };
      }
    },
  };
}
