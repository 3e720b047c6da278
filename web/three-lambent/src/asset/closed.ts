// Bodies, whose backs lie inside, and are not to be drawn: along a silhouette the back is as far away
// as the front, and would show through as dots.

import { Box3, Vector3, type BufferAttribute, type BufferGeometry } from "three";

/** Of a box's diagonal: what is as near as that is one vertex. */
const kOnePlace = 1e-4;

const mixed = (a: number, b: number) => {
  let h = Math.imul(a, 0x9e3779b1) ^ Math.imul(b ^ (b >>> 15), 0x85ebca77);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae3d);
  return h ^ (h >>> 16);
};

/** Two numbers for each vertex that tell its place, rounded to cells that begin at an offset. */
function placesOf(positions: Float64Array, cell: number, offset: number): Int32Array[] {
  const places = [1, 2].map((seed) => new Int32Array(positions.length / 3).fill(seed));
  for (let i = 0; i < positions.length; ++i) {
    const at = Math.floor(positions[i] / cell + offset);
    const vertex = (i / 3) | 0;
    for (const each of places) each[vertex] = mixed(each[vertex], at);
  }
  return places;
}

/**
 * Whether a geometry's triangles enclose something that they face away from. Every edge that runs
 * from one place to another must run back as often: sums of a number for each, less that of its
 * reverse, are then 0.
 */
export function isBody(geometry: BufferGeometry): boolean {
  const position = geometry.getAttribute("position") as BufferAttribute | undefined;
  if (!position || position.count < 4) return false;
  const { index } = geometry;
  const count = index ? index.count : position.count;
  if (count < 12 || count % 3 !== 0) return false;
  const box = new Box3().setFromBufferAttribute(position);
  const diagonal = box.getSize(new Vector3()).length();
  if (!(diagonal > 0)) return false;
  const { x, y, z } = box.getCenter(new Vector3());
  const p = new Float64Array(3 * position.count); // from the middle
  for (let i = 0; i < position.count; ++i) {
    p[3 * i] = position.getX(i) - x;
    p[3 * i + 1] = position.getY(i) - y;
    p[3 * i + 2] = position.getZ(i) - z;
  }
  const corners = new Uint32Array(count);
  for (let i = 0; i < count; ++i) corners[i] = index ? index.getX(i) : i;
  let volume = 0;
  for (let i = 0; i < count; i += 3) {
    const [a, b, c] = [3 * corners[i], 3 * corners[i + 1], 3 * corners[i + 2]];
    volume +=
      p[a] * (p[b + 1] * p[c + 2] - p[b + 2] * p[c + 1]) +
      p[a + 1] * (p[b + 2] * p[c] - p[b] * p[c + 2]) +
      p[a + 2] * (p[b] * p[c + 1] - p[b + 1] * p[c]);
  }
  if (!(volume > 0)) return false;
  // What lies on both sides of one set of cells' borders does not on the other's.
  return [0.5, 0].some((offset) =>
    placesOf(p, kOnePlace * diagonal, offset).every((places) => {
      let sum = 0;
      for (let i = 0; i < count; i += 3) {
        const [a, b, c] = [places[corners[i]], places[corners[i + 1]], places[corners[i + 2]]];
        sum = (sum + mixed(a, b) - mixed(b, a) + mixed(b, c) - mixed(c, b)) | 0;
        sum = (sum + mixed(c, a) - mixed(a, c)) | 0;
      }
      return sum === 0;
    }),
  );
}
