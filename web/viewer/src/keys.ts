// Keys → what they do; the list in help.ts says the same to people.
import type { Viewer } from "./viewer";
import { kTransfers, type ViewState } from "./view_state";

const kStep = 0.07; // radians
const kPanStep = 30; // pixels

export interface KeyActions {
  openFiles(): void;
  savePicture(): void;
  saveView(): void;
  hide(): void;
  help(): void;
}

/** Listens to the whole page, except where a control wants the key for itself. */
export function listenToKeys(viewer: Viewer, actions: KeyActions): void {
  const arrows: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, -1],
    ArrowDown: [0, 1],
  };
  const nextEnvironment = (by: number) =>
    next(viewer.environments.length, environmentOf(viewer), by, (i) => viewer.openEnvironment(i));
  const simple: Record<string, () => void> = {
    "+": () => viewer.zoom(1.1),
    "=": () => viewer.zoom(1.1),
    "-": () => viewer.zoom(1 / 1.1),
    f: () => viewer.frame(),
    r: () => viewer.reset(),
    " ": () => viewer.play(!viewer.playing),
    a: () => viewer.play(!viewer.playing),
    u: () => viewer.setUnlit(!viewer.unlit),
    m: () => viewer.change((view) => (view.macro = !view.macro)),
    v: () => viewer.change((view) => (view.viewDependent = !view.viewDependent)),
    e: () => nextEnvironment(1),
    E: () => nextEnvironment(-1),
    n: () => next(viewer.assets.length, viewer.asset, 1, (i) => viewer.openAsset(i)),
    d: () => viewer.addDisc(),
    Delete: () => viewer.removeDisc(viewer.disc),
    w: () => viewer.change((view) => (view.window = windowAfter(view.window))),
    "[": () => viewer.change((view) => (view.exposure = brighter(view.exposure, -1 / 3))),
    "]": () => viewer.change((view) => (view.exposure = brighter(view.exposure, 1 / 3))),
    t: () => viewer.change((view) => (view.tone = view.tone === "filmic" ? "linear" : "filmic")),
    b: () => viewer.change((view) => (view.background = !view.background)),
    o: () => actions.openFiles(),
    s: () => actions.savePicture(),
    h: () => actions.hide(),
    "?": () => actions.help(),
  };
  window.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]") !== null && event.key !== "?") return;
    const arrow = arrows[event.key];
    if (wantsKey(event)) return;
    if (arrow !== undefined) {
      const [x, y] = arrow;
      if (event.altKey) viewer.pan(-kPanStep * x, -kPanStep * y);
      else if (event.ctrlKey || event.metaKey) viewer.turnObject(kStep * x, kStep * y);
      else if (event.shiftKey) viewer.turnLight(kStep * x, kStep * y);
      else viewer.drag(viewer.grip, kStep * x, kStep * y);
      return event.preventDefault();
    }
    if ((event.ctrlKey || event.metaKey) && event.key === "s") {
      event.preventDefault();
      return actions.saveView();
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const transfer = /^[0-3]$/.test(event.key) ? kTransfers[Number(event.key)] : undefined;
    if (transfer !== undefined) return viewer.change((view) => (view.transfer = transfer));
    const action = simple[event.key] ?? simple[event.key.toLowerCase()];
    if (action === undefined) return;
    event.preventDefault();
    action();
  });
}

/** Whether the focused control uses the key itself. */
function wantsKey(event: KeyboardEvent): boolean {
  const focused = event.target as HTMLElement;
  const isArrow = event.key.startsWith("Arrow");
  if (focused instanceof HTMLSelectElement) return true;
  if (focused instanceof HTMLInputElement)
    return focused.type === "color" || isArrow || event.key === " ";
  return focused instanceof HTMLButtonElement && (event.key === " " || event.key === "Enter");
}

export function environmentOf(viewer: Viewer): number {
  return viewer.environments.findIndex(
    (each) => each.source === viewer.view.environment.source,
  );
}
function next(count: number, now: number, by: number, open: (index: number) => unknown): void {
  if (count > 0) open((Math.max(0, now) + by + count) % count);
}
const brighter = (exposure: number, by: number): number =>
  Math.max(-60, Math.min(60, Math.round((exposure + by) * 300) / 300));

/** The usual one, none, the least, Hann's and Lanczos's in turn; as wide as the light has bands. */
function windowAfter(window: ViewState["window"]): ViewState["window"] {
  const all = ["auto", "none", "minimal", "hann", "lanczos"] as const;
  const now = all.findIndex((each) => window.startsWith(each));
  return all[(now + 1) % all.length]!;
}
