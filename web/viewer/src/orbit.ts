// How a pointer, a wheel and keys move the camera, the object and the environment: pure functions
// of the view, so that what a gesture does can be read, and tested, without an event.
import { Quaternion, Vector3 } from "three";
import type { LookAt, Rotation, Triple, ViewState } from "./view_state";

/** What dragging turns. */
export type Grip = "camera" | "object" | "light";

const kNearestToPole = 0.02; // radians between the line of sight and the vertical

function axes(camera: LookAt): { back: Vector3; right: Vector3; up: Vector3; distance: number } {
  const back = new Vector3(...camera.position).sub(new Vector3(...camera.target));
  const distance = back.length();
  back.normalize();
  const right = new Vector3(...camera.up).cross(back).normalize();
  return { back, right, up: new Vector3().crossVectors(back, right), distance };
}

/** Turns the camera about its target; radians, positive x to the right, positive y downwards. */
export function orbit(camera: LookAt, x: number, y: number): LookAt {
  const { back, distance } = axes(camera);
  const pole = new Vector3(...camera.up).normalize();
  const polar = Math.acos(Math.min(1, Math.max(-1, back.dot(pole))));
  const wanted = Math.min(Math.PI - kNearestToPole, Math.max(kNearestToPole, polar - y));
  const { right } = axes(camera);
  back.applyAxisAngle(right, wanted - polar);
  back.applyAxisAngle(pole, -x);
  const position = back.multiplyScalar(distance).add(new Vector3(...camera.target));
  return { ...camera, position: position.toArray() as Triple };
}

/** Moves camera and target so that what is at the target follows the pointer; pixels. */
export function pan(camera: LookAt, x: number, y: number, height: number): LookAt {
  const { right, up, distance } = axes(camera);
  const metres =
    camera.orthographicHalfHeight !== null
      ? (2 * camera.orthographicHalfHeight) / height
      : (2 * distance * Math.tan((camera.verticalFov * Math.PI) / 360)) / height;
  const step = right.multiplyScalar(-x * metres).add(up.multiplyScalar(y * metres));
  return {
    ...camera,
    position: new Vector3(...camera.position).add(step).toArray() as Triple,
    target: new Vector3(...camera.target).add(step).toArray() as Triple,
  };
}

/** Nearer by a factor above 1, farther by one below. `size`: the object's diagonal, metres. */
export function zoom(camera: LookAt, factor: number, size: number): LookAt {
  if (camera.orthographicHalfHeight !== null)
    return { ...camera, orthographicHalfHeight: camera.orthographicHalfHeight / factor };
  const { back, distance } = axes(camera);
  const wanted = Math.min(100 * size, Math.max(0.01 * size, distance / factor));
  const position = back.multiplyScalar(wanted).add(new Vector3(...camera.target));
  return { ...camera, position: position.toArray() as Triple };
}

function turned(rotation: Rotation, camera: LookAt, x: number, y: number): Rotation {
  const { right } = axes(camera);
  const up = new Vector3(...camera.up).normalize();
  const step = new Quaternion()
    .setFromAxisAngle(up, x)
    .multiply(new Quaternion().setFromAxisAngle(right, y));
  return step.multiply(new Quaternion(...rotation)).normalize().toArray() as Rotation;
}

/**
 * Turns the object about `centre` (in its own frame): to the right by x about the camera's
 * vertical, towards the viewer by y about its horizontal; radians.
 */
export function turnObject(
  object: ViewState["object"],
  camera: LookAt,
  centre: Vector3,
  x: number,
  y: number,
): ViewState["object"] {
  const before = centre.clone().applyQuaternion(new Quaternion(...object.rotation));
  const rotation = turned(object.rotation, camera, x, y);
  const after = centre.clone().applyQuaternion(new Quaternion(...rotation));
  const translation = new Vector3(...object.translation).add(before).sub(after);
  return { rotation, translation: translation.toArray() as Triple };
}

export function turnEnvironment(
  rotation: Rotation,
  camera: LookAt,
  x: number,
  y: number,
): Rotation {
  return turned(rotation, camera, x, y);
}
