// What a document must still be like for its transfer to be right; each has its remedy.

import {
  Primitive,
  PropertyType,
  type Document,
  type Material,
  type Node,
} from "@gltf-transform/core";
import { fail } from "./blocks.js";
import { colourOf, floatsOf } from "./source.js";
import type { Carrier } from "./written.js";

/** How far positions may have been rounded: parts of a primitive's extent, and of the scene's. */
const kRounded = 1 / 200;
const kRoundedInScene = 1 / 4000;
const kUvRounded = 1 / 200;

/** What a primitive with transfer may not be. */
export function checkPrimitive(document: Document, { primitive, place }: Carrier): void {
  if (primitive.getMode() !== Primitive.Mode.TRIANGLES)
    fail(`${place}.mode`, "is no longer triangles, which is all that transfer is baked for");
  if (primitive.listTargets().length > 0)
    fail(`${place}.targets`, "deform a mesh with baked transfer: remove them");
  const used = document.getRoot().listExtensionsUsed();
  if (used.some(({ extensionName }) => extensionName === "KHR_draco_mesh_compression"))
    fail(
      `${place}.extensions.KHR_draco_mesh_compression`,
      "brings vertices into a sequence that their transfer cannot follow: " +
        "compress with meshopt() instead",
    );
}

/** Light was baked with the colours that the material had. */
export function checkColour(document: Document, { primitive, place, sources }: Carrier): void {
  const now = colourOf(primitive);
  const material: Material | null = primitive.getMaterial();
  const named = `${place}.material${material?.getName() ? ` ("${material.getName()}")` : ""}`;
  for (const { colour } of sources) {
    if (colour.texture >= 0 && now.texture < 0)
      fail(
        named,
        "has lost its baseColorTexture, by which transfer is multiplied: " +
          "prune({ keepSolidTextures: true }) keeps those of one colour",
      );
    if (colour.texture < 0 && now.texture >= 0)
      fail(
        named,
        "has got a baseColorTexture, by which transfer would be multiplied twice: " +
          "leave palette() out, or apply it before the bake",
      );
    if (colour.vertices !== now.vertices)
      fail(`${place}.attributes.COLOR_0`, "was added or removed, and transfer is multiplied by it");
    const near = (value: number, i: number) => Math.abs(value - now.factors[i]) < 1e-4;
    if (now.factors.length !== colour.factors.length || !colour.factors.every(near))
      document
        .getLogger()
        .warn(`${named}: has changed since the bake, and its light has not: bake the scene again`);
  }
}

/** The UVs that transfer is looked up with. Those that were removed are put back. */
export function checkUvs({ primitive, place, sources, of, vertex }: Carrier): void {
  for (const semantic of sources[0].attributes.keys()) {
    const now = semantic.startsWith("TEXCOORD") ? floatsOf(primitive, semantic) : null;
    for (let i = 0; now && i < 2 * of.length; ++i) {
      const [at, component] = [i >> 1, i & 1];
      const { array } = sources[of[at]].attributes.get(semantic) as { array: Float32Array };
      if (!(Math.abs(now[i] - array[2 * vertex[at] + component]) <= kUvRounded))
        fail(
          `${place}.attributes.${semantic}`,
          "was replaced, and transfer is looked up with it: apply unwrap() before the bake",
        );
    }
  }
}

/** Whether the scene that is shown has a node. */
function isShown(document: Document, node: Node): boolean {
  const scene = document.getRoot().getDefaultScene() ?? document.getRoot().listScenes()[0];
  let top = node;
  for (let above = top.getParentNode(); above; above = above.getParentNode()) top = above;
  return scene?.listChildren().includes(top) ?? false;
}

/** The node that shows a carrier's mesh, where it has to be put back to where it was baked. */
export function checkNode(document: Document, carrier: Carrier): Node | null {
  const { mesh, primitive, place, sources, of, vertex } = carrier;
  const parents = mesh.listParents().filter((p) => p.propertyType === PropertyType.NODE) as Node[];
  const nodes = parents.filter((node) => isShown(document, node));
  if (nodes.length > 1)
    fail(
      place,
      "is shown by more than one node, and transfer belongs to one place: clone the mesh",
    );
  if (nodes.length === 0) return null;
  const [node] = nodes;
  if (node.getSkin()) fail(place, "is skinned, and transfer was baked at rest: remove the skin");
  if (node.getExtension("EXT_mesh_gpu_instancing"))
    fail(place, "is instanced, and transfer belongs to one place: leave instance() out");
  const world = node.getWorldMatrix();
  const positions = floatsOf(primitive, "POSITION") as Float32Array;
  for (let i = 0; i < of.length; ++i) {
    const { attributes, extent, bake } = sources[of[i]];
    const scene = Math.max(...bake.high.map((high, c) => high - bake.low[c]));
    const rounded = Math.max(kRounded * extent, kRoundedInScene * scene);
    const { array } = attributes.get("POSITION") as { array: Float32Array };
    const [x, y, z] = positions.subarray(3 * i, 3 * i + 3);
    for (let c = 0; c < 3; ++c) {
      const here = world[c] * x + world[4 + c] * y + world[8 + c] * z + world[12 + c];
      if (!(Math.abs(here - array[3 * vertex[i] + c]) <= rounded))
        fail(
          place,
          "was moved, turned, deformed or rounded too coarsely, and transfer belongs to one " +
            "place in the scene: do so before the bake, or turn the light instead",
        );
    }
  }
  // Positions are written as they were baked, so that a transform that undoes rounding has to go.
  const moves = (n: Node) =>
    n.getTranslation().some(Boolean) ||
    n.getScale().some((s) => s !== 1) ||
    n.getRotation().some((r, i) => r !== (i === 3 ? 1 : 0));
  for (let above = node.getParentNode(); above; above = above.getParentNode())
    if (moves(above)) fail(place, "stands under a node with a transform: apply flatten() first");
  if (!moves(node)) return null;
  if (node.listChildren().length > 0)
    fail(place, "is shown by a node with children and a transform: apply flatten() first");
  return node;
}
