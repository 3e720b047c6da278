// Meshes with two sides: a back of triangles for every front (lambent/scene/sheets.h).

import type { BufferGeometry } from "three";

/**
 * Whether the second half of a geometry is the back of its first half: the same positions, and
 * triangles (a, b, c) as (a + n, c + n, b + n). What faces away is then to be culled: it has the same
 * depth as what faces the eye.
 */
export function hasBacks(geometry: BufferGeometry): boolean {
  const position = geometry.getAttribute("position");
  const { index } = geometry;
  if (!position || !index) return false;
  const vertices = position.count / 2;
  const corners = index.count / 2;
  if (corners === 0 || corners % 3 !== 0 || !Number.isInteger(vertices)) return false;
  for (let i = 0; i < corners; i += 3) {
    const [a, b, c] = [index.getX(i), index.getX(i + 1), index.getX(i + 2)];
    const k = i + corners;
    if (Math.max(a, b, c) >= vertices) return false;
    if (index.getX(k) !== a + vertices) return false;
    if (index.getX(k + 1) !== c + vertices || index.getX(k + 2) !== b + vertices) return false;
  }
  for (let v = 0; v < vertices; ++v)
    for (const axis of ["getX", "getY", "getZ"] as const)
      if (position[axis](v) !== position[axis](v + vertices)) return false;
  return true;
}
