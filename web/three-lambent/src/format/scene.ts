// What the extension asks of the glTF document around it: a scene, nodes that leave the meshes where
// they were baked, and vertices to speak of. What no scene shows is passed over. As
// lambent/asset/check_gltf.cpp.

import type { AccessorReader } from "./accessors.js";
import { kExtensionName, LambentFormatError } from "./description.js";
import { Fields, type Json } from "./fields.js";

/** A primitive with transfer that the scene shows. */
export interface Carrier {
  /** "MESH/PRIMITIVE", the indices in the document. */
  key: string;
  /** The primitive's object of the extension. */
  transfer: Fields;
  vertices: number;
  /** NORMAL as the file has it; null if its numbers are not plain floats. */
  normals: Float32Array | null;
}

const kDraco = "KHR_draco_mesh_compression";
const kInstancing = "EXT_mesh_gpu_instancing";

const kIdentity = {
  matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  translation: [0, 0, 0],
  rotation: [0, 0, 0, 1],
  scale: [1, 1, 1],
};

function fail(place: string, what: string): never {
  throw new LambentFormatError(`${place}: ${what}`);
}

function listOf(value: unknown): unknown[] {
  return Array.isArray(value) ? value : [];
}

function memberOf(value: unknown, key: string): unknown {
  return typeof value === "object" && value !== null ? (value as Json)[key] : undefined;
}

function isIndex(value: unknown, count: number): value is number {
  return Number.isInteger(value) && (value as number) >= 0 && (value as number) < count;
}

function transferOf(primitive: unknown): unknown {
  return memberOf(memberOf(primitive, "extensions"), kExtensionName);
}

/** The member of a node's transform that is not the identity's. One spelled out moves nothing. */
function moverOf(node: Fields): string | undefined {
  return Object.entries(kIdentity).find(([key, expected]) => {
    if (!node.has(key)) return false;
    const value = node.raw(key);
    return !(
      Array.isArray(value) &&
      value.length === expected.length &&
      value.every((v, i) => v === expected[i])
    );
  })?.[0];
}

/** The meshes that the document's scene shows, in the sequence of its nodes. */
function shownMeshes(json: Json): Set<number> {
  const scenes = listOf(json.scenes);
  if (scenes.length === 0) fail("scenes", "is missing: transfer belongs to a place in a scene");
  const chosen = json.scene === undefined ? 0 : json.scene;
  if (!isIndex(chosen, scenes.length))
    fail("scene", `is ${JSON.stringify(chosen)}, but the file has ${scenes.length}`);
  const nodes = listOf(json.nodes);
  const meshes = listOf(json.meshes);
  const shown = new Set<number>();
  const visited = new Set<number>();
  const pending: { at: number; mover: string }[] = [];
  const visit = (list: unknown, place: string, mover: string) => {
    for (const at of [...listOf(list)].reverse()) {
      if (!isIndex(at, nodes.length))
        fail(place, `${JSON.stringify(at)} is no node: the file has ${nodes.length}`);
      if (visited.has(at))
        fail(
          place,
          `node ${at} is reached twice: nodes form a cycle or share a child; export the file again`,
        );
      visited.add(at);
      pending.push({ at, mover });
    }
  };
  visit(memberOf(scenes[chosen], "nodes"), `scenes[${chosen}].nodes`, "");
  for (let here = pending.pop(); here; here = pending.pop()) {
    const place = `nodes[${here.at}]`;
    const node: Fields = new Fields(nodes[here.at], place);
    const own = moverOf(node);
    const mover = own ? `${place}.${own}` : here.mover;
    if (node.has("mesh")) {
      const index = node.raw("mesh");
      if (!isIndex(index, meshes.length))
        node.fail("mesh", `${JSON.stringify(index)} is no mesh: the file has ${meshes.length}`);
      const primitives = listOf(memberOf(meshes[index], "primitives"));
      if (primitives.some((primitive) => transferOf(primitive) !== undefined)) {
        if (mover)
          fail(
            mover,
            "moves a mesh away from where its transfer was baked: bake the scene as it stands now",
          );
        if (node.has("skin"))
          node.fail(
            "skin",
            "deforms a mesh with baked transfer: remove it, or bake the deformed mesh",
          );
        if (memberOf(node.has("extensions") && node.raw("extensions"), kInstancing) !== undefined)
          fail(
            `${place}.extensions.${kInstancing}`,
            "shows a mesh with baked transfer in places where it was not baked: bake the scene as it stands now",
          );
        if (shown.has(index))
          node.fail("mesh", "shows a mesh with baked transfer that another node shows");
      }
      shown.add(index);
    }
    if (node.has("children")) visit(node.raw("children"), `${place}.children`, mover);
  }
  return shown;
}

/** The UV set that a member of a primitive's transfer names. */
function texCoordOf(transfer: Fields, member: string): unknown {
  return transfer.has(member) ? memberOf(transfer.raw(member), "texCoord") : undefined;
}

/** Checks a primitive; its vertices and normals, or null where it has nothing to see. */
async function checkPrimitive(
  primitive: Fields,
  transfer: Fields | null,
  accessors: AccessorReader,
): Promise<Pick<Carrier, "vertices" | "normals"> | null> {
  const mode = primitive.has("mode") ? primitive.raw("mode") : 4;
  const compressed =
    memberOf(primitive.has("extensions") && primitive.raw("extensions"), kDraco) !== undefined;
  const attributes =
    transfer || primitive.has("attributes") ? primitive.object("attributes") : null;
  if (transfer && attributes) {
    if (mode !== 4)
      primitive.fail("mode", "is not triangles (4), which is all that transfer is baked for");
    if (primitive.has("targets"))
      primitive.fail(
        "targets",
        "morph targets deform a mesh with baked transfer: remove them, or bake the deformed mesh",
      );
    if (compressed)
      primitive.fail(
        `extensions.${kDraco}`,
        "brings vertices into another sequence than their baked transfer has: leave the mesh uncompressed",
      );
    for (const name of ["POSITION", "NORMAL"])
      if (!attributes.has(name)) attributes.fail(name, "is missing, and transfer stands on it");
    for (const needs of ["grid", "biScale"]) {
      if (!transfer.has(needs)) continue;
      const uvs = texCoordOf(transfer, needs) === 1 ? "TEXCOORD_1" : "TEXCOORD_0";
      if (!attributes.has(uvs))
        attributes.fail(uvs, `is missing, and ${needs} is looked up with it`);
    }
  }
  if (!attributes?.has("POSITION") || mode === 0 || mode === 1 || mode === 2 || mode === 3)
    return null;
  let vertices = 0;
  let normals: Float32Array | null = null;
  // A second set of texture coordinates is none of this reader's unless a grid lies on it.
  const second = transfer !== null && texCoordOf(transfer, "grid") === 1;
  for (const name of ["POSITION", "NORMAL", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"] as const) {
    if (!attributes.has(name) || (name === "TEXCOORD_1" && !second)) continue;
    const { count, width, floats } = await accessors.attribute(attributes, name);
    if (name === "POSITION") vertices = count;
    if (count !== vertices)
      attributes.fail(name, `has ${count} elements for ${vertices} vertices`);
    const wrong = floats?.findIndex((v) => !Number.isFinite(v)) ?? -1;
    if (wrong >= 0)
      attributes.fail(name, `a number of vertex ${Math.floor(wrong / width)} is not finite`);
    if (name === "NORMAL") normals = floats;
  }
  if (primitive.has("indices") && !compressed) await accessors.checkIndices(primitive, vertices);
  return { vertices, normals };
}

/** Checks all that the document's scene shows, and finds there what carries transfer. */
export async function findCarriers(json: Json, accessors: AccessorReader): Promise<Carrier[]> {
  const carriers: Carrier[] = [];
  let anything = false;
  for (const m of shownMeshes(json)) {
    const primitives = listOf(memberOf(listOf(json.meshes)[m], "primitives"));
    for (const [p, value] of primitives.entries()) {
      const place = `meshes[${m}].primitives[${p}]`;
      const primitive = new Fields(value, place);
      const object = transferOf(value);
      const transfer =
        object === undefined ? null : new Fields(object, `${place}.extensions.${kExtensionName}`);
      const vertices = await checkPrimitive(primitive, transfer, accessors);
      if (!vertices) continue;
      anything = true;
      if (transfer) carriers.push({ key: `${m}/${p}`, transfer, ...vertices });
    }
  }
  if (!anything) fail(`scenes[${json.scene ?? 0}]`, "shows no triangles");
  return carriers;
}
