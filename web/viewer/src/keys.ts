// Keys → what they do; the list in help.ts says the same to people.
import { anyOf } from "./overlays";
import { pressOnPicture } from "./picture_keys";
import type { Viewer } from "./viewer";
import { kTransfers, type ViewState } from "./view_state";

export interface KeyActions {
  openFiles(): void;
  savePicture(): void;
  saveView(): void;
  undo(): void;
  redo(): void;
  hide(): void;
  fullScreen(): void;
  help(): void;
}

/** Listens to the whole page, except where a control wants the key for itself. */
export function listenToKeys(viewer: Viewer, actions: KeyActions): void {
  const { assets, environments } = viewer.library;
  const nextEnvironment = (by: number) =>
    next(environments.length, environmentOf(viewer), by, (i) => viewer.openEnvironment(i));
  const simple: Record<string, () => void> = {
    " ": () => viewer.play(!viewer.playing),
    a: () => viewer.play(!viewer.playing),
    u: () => viewer.setUnlit(!viewer.unlit),
    l: () => viewer.setOverlay(null, !anyOf(viewer.overlays)),
    m: () => viewer.change((view) => (view.macro = !view.macro)),
    v: () => viewer.change((view) => (view.viewDependent = !view.viewDependent)),
    e: () => nextEnvironment(1),
    E: () => nextEnvironment(-1),
    n: () => next(assets.length, viewer.asset, 1, (i) => viewer.openAsset(i)),
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
    F: () => actions.fullScreen(),
    Escape: () => viewer.messages.closeOne(),
    "?": () => actions.help(),
  };
  const withControl: Record<string, () => void> = {
    s: () => actions.saveView(),
    z: () => actions.undo(),
    Z: () => actions.redo(),
    y: () => actions.redo(),
  };
  window.addEventListener("keydown", (event) => {
    if (event.defaultPrevented) return; // the picture has taken it
    if (document.querySelector("dialog[open]") !== null && event.key !== "?") return;
    if (wantsKey(event)) return;
    const act = () => {
      if (pressOnPicture(viewer, event)) return true;
      if (event.ctrlKey || event.metaKey) {
        const key = event.shiftKey ? event.key.toUpperCase() : event.key.toLowerCase();
        const action = withControl[key];
        action?.();
        return action !== undefined;
      }
      if (event.altKey) return false;
      const transfer = /^[0-3]$/.test(event.key) ? kTransfers[Number(event.key)] : undefined;
      if (transfer !== undefined) viewer.change((view) => (view.transfer = transfer));
      const key = event.key.length === 1 && !event.shiftKey ? event.key.toLowerCase() : event.key;
      const action = simple[key] ?? simple[key.toLowerCase()];
      action?.();
      return transfer !== undefined || action !== undefined;
    };
    if (act()) event.preventDefault();
  });
}

/** Whether the focused control uses the key itself. */
function wantsKey(event: KeyboardEvent): boolean {
  const focused = event.composedPath()[0];
  const isArrow = event.key.startsWith("Arrow");
  if (focused instanceof HTMLSelectElement) return true;
  if (focused instanceof HTMLInputElement) {
    if (event.ctrlKey && event.key.toLowerCase() === "z") return false;
    return focused.type === "color" || focused.type === "date" || isArrow || event.key === " ";
  }
  if (!(focused instanceof HTMLButtonElement)) return false;
  const tab = focused.getAttribute("role") === "tab";
  return event.key === " " || event.key === "Enter" || (tab && isArrow);
}

export function environmentOf(viewer: Viewer): number {
  return viewer.library.environments.findIndex(
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
