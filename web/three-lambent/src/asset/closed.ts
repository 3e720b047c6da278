// Meshes of which what faces away is not to be drawn: those with two sides, a back of triangles for
// every front (lambent/scene/sheets.h), and bodies, whose backs lie inside. Along the silhouette of
// a body its back is as far away as its front, and would show through as dots.

import { Box3, Vector3, type BufferAttribute, type BufferGeometry } from "three";

/**
 * Whether the second half of a geometry's triangles is the back of its first half: the same turned
 * over, (a, b, c) as (a', c', b'), with vertices of their own at the same positions. What faces
 * away is then to be culled: it has the same depth as what faces the eye.
 */
export function hasBacks(geometry: BufferGeometry): boolean {
  const position = geometry.getAttribute("position");
  const { index } = geometry;
  if (!position || !index) return false;
  const corners = index.count / 2;
  if (corners === 0 || corners % 3 !== 0) return false;
  const other = new Map<number, number>();
  const pair = (front: number, back: number) => {
    if (front === back) return false;
    for (const axis of ["getX", "getY", "getZ"] as const)
      if (position[axis](front) !== position[axis](back)) return false;
    if (!other.has(front) && !other.has(back)) other.set(front, back).set(back, front);
    return other.get(front) === back && other.get(back) === front;
  };
  for (let i = 0; i < corners; i += 3) {
    const k = i + corners;
    for (const [front, back] of [[i, k], [i + 1, k + 2], [i + 2, k + 1]] as const)
      if (!pair(index.getX(front), index.getX(back))) return false;
  }
  return true;
}

/** Of a box's diagonal: what is as near as that is one vertex. */
const kOnePlace = 1e-4;

const mixed = (a: number, b: number) => {
  let h = Math.imul(a, 0x9e3779b1) ^ Math.imul(b ^ (b >>> 15), 0x85ebca77);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae3d);
  return h ^ (h >>> 16);
};

/** Two numbers for each vertex that tell its place, rounded to cells that begin at an offset. */
function placesOf(geometry: BufferGeometry, box: Box3, offset: number): [Int32Array, Int32Array] {
  const position = geometry.getAttribute("position");
  const cells = 1 / (kOnePlace * box.getSize(new Vector3()).length());
  const places = [1, 2].map((seed) => new Int32Array(position.count).fill(seed));
  for (let i = 0; i < position.count; ++i)
    for (const [axis, get] of (["getX", "getY", "getZ"] as const).entries()) {
      const cell = Math.floor((position[get](i) - box.min.getComponent(axis)) * cells + offset);
      for (const each of places) each[i] = mixed(each[i], cell);
    }
  return [places[0], places[1]];
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
  const corner = (i: number) => (index ? index.getX(i) : i);
  const box = new Box3().setFromBufferAttribute(position);
  if (!(box.getSize(new Vector3()).length() > 0)) return false;
  const middle = box.getCenter(new Vector3());
  const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
  let volume = 0;
  for (let i = 0; i < count; i += 3) {
    for (const [k, at] of [a, b, c].entries())
      at.fromBufferAttribute(position, corner(i + k)).sub(middle);
    volume += a.dot(b.cross(c));
  }
  if (!(volume > 0)) return false;
  // What lies on both sides of one set of cells' borders does not on the other's.
  return [0.5, 0].some((offset) =>
    placesOf(geometry, box, offset).every((places) => {
      let sum = 0;
      for (let i = 0; i < count; i += 3)
        for (let k = 0; k < 3; ++k) {
          const from = places[corner(i + k)];
          const to = places[corner(i + ((k + 1) % 3))];
          sum = (sum + mixed(from, to) - mixed(to, from)) | 0;
        }
      return sum === 0;
    }),
  );
}
