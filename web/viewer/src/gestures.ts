// Pointer, wheel and touch on the picture → what moves and by how much.
import type { Grip } from "./orbit";

export interface GestureTarget {
  /** What plain dragging turns at the moment. */
  grip(): Grip;
  /** Radians for a pixel are the target's matter. */
  drag(grip: Grip, x: number, y: number): void;
  pan(x: number, y: number): void;
  zoom(factor: number): void;
  /** A press and release without a drag between; pixels from the picture's corner. */
  click(x: number, y: number): void;
  /** Two clicks or taps after each other. */
  doubleClick(): void;
}

const kSlip = 5; // pixels that a click may wander
const kDoubleClick = 350; // milliseconds

/** Listens on `element` until the returned function is called. */
export function listen(element: HTMLElement, target: GestureTarget): () => void {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  const pointers = new Map<number, { x: number; y: number }>();
  let button = 0;
  let start = { x: 0, y: 0 };
  let dragged = false;
  let fingers = 0; // at most, since the first came down
  let lastClick = -Infinity;

  const gripOf = (event: PointerEvent): Grip =>
    event.shiftKey ? "light" : event.ctrlKey || event.metaKey ? "object" : target.grip();

  element.addEventListener("contextmenu", (event) => event.preventDefault(), options);
  element.addEventListener(
    "pointerdown",
    (event) => {
      if (event.button > 2) return;
      element.setPointerCapture(event.pointerId);
      if (pointers.size === 0) {
        start = { x: event.clientX, y: event.clientY };
        [dragged, fingers] = [false, 0];
      }
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      fingers = Math.max(fingers, pointers.size);
      button = event.button;
    },
    options,
  );
  element.addEventListener(
    "pointermove",
    (event) => {
      const before = pointers.get(event.pointerId);
      if (before === undefined) return;
      const [x, y] = [event.clientX - before.x, event.clientY - before.y];
      dragged ||= Math.hypot(event.clientX - start.x, event.clientY - start.y) >= kSlip;
      if (pointers.size === 1 && fingers === 1) {
        if (!dragged) return; // the slip is not lost: `before` stays
        if (button !== 0 || event.altKey) target.pan(x, y);
        else target.drag(gripOf(event), x, y);
      } else if (pointers.size === 2) {
        const other = [...pointers.entries()].find(([id]) => id !== event.pointerId)![1];
        const span = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y);
        const now = { x: event.clientX, y: event.clientY };
        if (span(before) > 10 && span(now) > 10) target.zoom(span(now) / span(before));
        target.pan(x / 2, y / 2); // the fingers' middle moves by half of what one does
      }
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    },
    options,
  );
  const release = (event: PointerEvent) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type !== "pointerup" || dragged || fingers > 1 || button !== 0) return;
    const box = element.getBoundingClientRect();
    const double = event.timeStamp - lastClick < kDoubleClick;
    lastClick = double ? -Infinity : event.timeStamp;
    if (double) target.doubleClick();
    else target.click(event.clientX - box.left, event.clientY - box.top);
  };
  element.addEventListener("pointerup", release, options);
  element.addEventListener("pointercancel", release, options);
  element.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
      target.zoom(Math.exp(-0.0015 * lines * Math.max(-300, Math.min(300, event.deltaY))));
    },
    { ...options, passive: false },
  );
  return () => stop.abort();
}
