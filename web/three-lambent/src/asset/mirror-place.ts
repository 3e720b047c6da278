// Where what a mirror shows is captured from: as placeAt of lambent/render/gl_mirrors.cpp, where
// all backs are drawn.

import { Box3, Vector3, type BufferGeometry } from "three";

const kTries = 16;
/** Before the mirror, in diagonals of it. */
const kBefore = 0.02;

export function boxOf(geometry: BufferGeometry): Box3 {
  if (!geometry.boundingBox) geometry.computeBoundingBox();
  return geometry.boundingBox!;
}

/**
 * How large a part of all directions triangles cover, seen from a place, those that face away less
 * those that face it: 4π inside of a body. (Van Oosterom and Strackee's formula.)
 */
function solidAngleAround(geometry: BufferGeometry, place: Vector3): number {
  const position = geometry.getAttribute("position");
  const { index } = geometry;
  const count = index ? index.count : position.count;
  const corners = [new Vector3(), new Vector3(), new Vector3()];
  const [a, b, c] = corners;
  const across = new Vector3();
  let sum = 0;
  for (let i = 0; i + 2 < count; i += 3) {
    for (let k = 0; k < 3; ++k)
      corners[k].fromBufferAttribute(position, index ? index.getX(i + k) : i + k).sub(place);
    const [la, lb, lc] = corners.map((corner) => corner.length());
    sum +=
      2 *
      Math.atan2(
        a.dot(across.crossVectors(b, c)),
        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb,
      );
  }
  return sum;
}

/** Whether a place is inside of one of these bodies: nothing but its back would be seen. */
function isBuried(others: readonly BufferGeometry[], place: Vector3): boolean {
  return others.some(
    (geometry) =>
      boxOf(geometry).containsPoint(place) &&
      Math.abs(solidAngleAround(geometry, place)) > 3 * Math.PI,
  );
}

/**
 * The middle of a mirror's box or, where something stands there that the mirror goes around, a
 * place before the mirror.
 *
 * @param others all other surfaces whose backs are drawn
 */
export function capturePlace(mirror: BufferGeometry, others: readonly BufferGeometry[]): Vector3 {
  const box = boxOf(mirror);
  const middle = box.getCenter(new Vector3());
  if (!isBuried(others, middle)) return middle;
  const [position, normal] = ["position", "normal"].map((name) => mirror.getAttribute(name));
  const before = kBefore * box.getSize(new Vector3()).length();
  const tries = Math.min(kTries, position.count);
  for (let k = 0; k < tries; ++k) {
    const i = Math.floor((k * position.count) / tries);
    const along = new Vector3().fromBufferAttribute(normal, i);
    const place = new Vector3().fromBufferAttribute(position, i).addScaledVector(along, before);
    if (!isBuried(others, place)) return place;
  }
  return middle;
}
