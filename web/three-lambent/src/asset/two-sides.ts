// Meshes with two sides: a back of triangles for every front (lambent/scene/sheets.h).

import type { BufferGeometry } from "three";

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
