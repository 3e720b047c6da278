// Cameras as the tool places them: lambent/scene/camera.cpp.

import {
  Box3,
  Matrix4,
  OrthographicCamera,
  PerspectiveCamera,
  Vector3,
  type Camera,
  type Mesh,
  type Object3D,
} from "three";

/** All positions below an object, in the world. Matrices must be up to date. */
function forEachVertex(root: Object3D, visit: (p: Vector3) => void): void {
  const p = new Vector3();
  root.traverse((object) => {
    const position = (object as Mesh).isMesh && (object as Mesh).geometry.getAttribute("position");
    if (!position) return;
    for (let i = 0; i < position.count; ++i)
      visit(p.fromBufferAttribute(position, i).applyMatrix4(object.matrixWorld));
  });
}

/**
 * A three-quarter view from slightly above that frames everything below `root`: sets the camera's
 * place, direction, field of view, aspect, near and far.
 *
 * @param aspect width / height of the picture
 * @returns what it looks at (the middle of the bounding box), for orbit controls
 */
export function frameAutomatically(
  root: Object3D,
  camera: PerspectiveCamera,
  aspect: number,
): Vector3 {
  root.updateWorldMatrix(true, true);
  const fov = 0.6; // radians
  const back = new Vector3(0.55, 0.45, 1).normalize();
  const right = new Vector3(0, 1, 0).cross(back).normalize();
  const up = back.clone().cross(right);
  const margin = 0.93; // of the image is used, so that nothing touches its border
  const half = Math.tan(fov / 2);
  const tx = margin * half * Math.max(aspect, 1e-3);
  const ty = margin * half;

  // Each side plane of the view pyramid must have every vertex on its inner side. With the axes
  // fixed these are linear in the eye's position, so the nearest eye is found in one pass.
  let [rightmost, leftmost, topmost, lowest, foremost] = Array<number>(5).fill(-Infinity);
  const box = new Box3();
  forEachVertex(root, (p) => {
    const a = p.dot(right);
    const b = p.dot(up);
    const d = p.dot(back);
    rightmost = Math.max(rightmost, a + tx * d);
    leftmost = Math.max(leftmost, -a + tx * d);
    topmost = Math.max(topmost, b + ty * d);
    lowest = Math.max(lowest, -b + ty * d);
    foremost = Math.max(foremost, d);
    box.expandByPoint(p);
  });
  const eye = back.clone().multiplyScalar(3);
  if (Number.isFinite(foremost)) {
    const diagonal = Math.max(box.getSize(new Vector3()).length(), 1e-6);
    const distance = Math.max(
      (rightmost + leftmost) / 2 / tx,
      (topmost + lowest) / 2 / ty,
      foremost + 0.05 * diagonal,
    );
    eye
      .copy(right)
      .multiplyScalar((rightmost - leftmost) / 2)
      .addScaledVector(up, (topmost - lowest) / 2)
      .addScaledVector(back, distance);
  }
  camera.matrixWorld.makeBasis(right, up, back).setPosition(eye);
  camera.matrix.copy(camera.matrixWorld);
  if (camera.parent) {
    camera.parent.updateWorldMatrix(true, false);
    camera.matrix.premultiply(new Matrix4().copy(camera.parent.matrixWorld).invert());
  }
  camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
  camera.fov = (fov * 180) / Math.PI;
  camera.aspect = aspect;
  fitClipping(camera, root);
  return box.isEmpty() ? new Vector3() : box.getCenter(new Vector3());
}

/** Near and far planes that fit everything below `root` (its bounding box), with some margin. */
export function fitClipping(camera: Camera, root: Object3D): void {
  root.updateWorldMatrix(true, true);
  camera.updateWorldMatrix(true, false);
  const box = new Box3().setFromObject(root);
  const cameraFromWorld = new Matrix4().copy(camera.matrixWorld).invert();
  let nearest = Infinity;
  let farthest = -Infinity;
  const p = new Vector3();
  for (let corner = 0; corner < 8 && !box.isEmpty(); ++corner) {
    p.set(
      (corner & 1 ? box.max : box.min).x,
      (corner & 2 ? box.max : box.min).y,
      (corner & 4 ? box.max : box.min).z,
    ).applyMatrix4(cameraFromWorld);
    nearest = Math.min(nearest, -p.z);
    farthest = Math.max(farthest, -p.z);
  }
  if (!(nearest <= farthest)) [nearest, farthest] = [0, 1];
  const margin = 0.01 * (farthest - nearest) + 1e-4 * Math.abs(farthest) + 1e-9;
  let near = nearest - margin;
  let far = farthest + margin;
  if (camera instanceof PerspectiveCamera) {
    // A camera inside the box, or before all of it: a 24-bit depth buffer is useful at 1 : 10⁴.
    if (far <= 0) far = 1;
    near = Math.max(near, 1e-4 * far);
  }
  if (camera instanceof PerspectiveCamera || camera instanceof OrthographicCamera) {
    camera.near = near;
    camera.far = far;
    camera.updateProjectionMatrix();
  }
}

/**
 * `count` places in the unit square that are evenly stratified along both axes, the first in the
 * middle if count is 1: where the tool's `--samples N` looks through a pixel, in pixels from its
 * upper left corner.
 */
export function subpixelPositions(count: number): [number, number][] {
  const n = Math.max(1, Math.floor(count));
  const reversed = (i: number) => {
    let bits = 0;
    for (let b = 0; b < 32; ++b) if ((i >>> b) & 1) bits |= 1 << (31 - b);
    return bits >>> 0;
  };
  // Hammersley points, with the radical inverse replaced by its rank.
  const order = Array.from({ length: n }, (_, i) => i).sort((a, b) => reversed(a) - reversed(b));
  const places: [number, number][] = Array(n);
  order.forEach((i, rank) => (places[i] = [(i + 0.5) / n, (rank + 0.5) / n]));
  return places;
}
