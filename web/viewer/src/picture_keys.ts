// Keys of the picture itself: they move the camera, the object and the light.
import type { Viewer } from "./viewer";

const kStep = 0.07; // radians
const kPanStep = 30; // pixels

const kArrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Does what a key of the picture says; false: it is none. */
export function pressOnPicture(viewer: Viewer, event: KeyboardEvent): boolean {
  const arrow = kArrows[event.key];
  if (arrow !== undefined) {
    const [x, y] = arrow;
    if (event.altKey) viewer.pan(-kPanStep * x, -kPanStep * y);
    else if (event.ctrlKey || event.metaKey) viewer.turnObject(kStep * x, kStep * y);
    else if (event.shiftKey) viewer.turnLight(kStep * x, kStep * y);
    else viewer.drag(viewer.grip, kStep * x, kStep * y);
    return true;
  }
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  if (event.key === "+" || event.key === "=") viewer.zoom(1.1);
  else if (event.key === "-") viewer.zoom(1 / 1.1);
  else if (event.key === "f" || (event.key === "F" && !event.shiftKey)) viewer.frame();
  else if (event.key === "r" || event.key === "R") viewer.reset();
  else return false;
  return true;
}
