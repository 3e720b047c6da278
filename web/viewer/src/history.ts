// Changes that can be taken back, and made again.
import type { Opened } from "./library";
import type { Viewer } from "./viewer";
import type { ViewState } from "./view_state";

const kTogether = 1000; // milliseconds between changes of the same numbers that count as one
const kMost = 200;

interface Moment {
  asset: Opened | undefined;
  view: ViewState;
  unlit: boolean;
}

export class History {
  private readonly past: Moment[] = [];
  private readonly future: Moment[] = [];
  private now: Moment | null = null;
  private last = { what: "", when: -Infinity };
  private restoring = false;

  constructor(private readonly viewer: Viewer) {}

  /** Call after anything changed. What goes by itself is no change that anybody made. */
  note(): void {
    const { viewer } = this;
    if (this.restoring || viewer.current.loaded === null) return;
    const asset = viewer.library.assets[viewer.asset];
    const { now } = this;
    const shown: Moment = { asset, view: viewer.view, unlit: viewer.unlit };
    const what = now === null ? "" : changedBetween(now, shown);
    if (now !== null && what === "") return;
    this.now = copyOf(shown);
    if (now === null || (viewer.playing && what === "~environment.rotation")) return;
    const when = performance.now();
    // Numbers that run: a drag, a slider, an arrow that is held.
    const { last } = this;
    const runs = what.startsWith("~") && what === last.what && when - last.when < kTogether;
    this.last = { what, when };
    this.future.length = 0;
    if (runs) return;
    this.past.push(now);
    if (this.past.length > kMost) this.past.shift();
  }
  /** What comes next is a change of its own. */
  divide(): void {
    this.last.what = "";
  }
  get undoes(): boolean {
    return this.past.length > 0;
  }
  get redoes(): boolean {
    return this.future.length > 0;
  }
  undo(): Promise<void> {
    return this.move(this.past, this.future);
  }
  redo(): Promise<void> {
    return this.move(this.future, this.past);
  }

  private async move(from: Moment[], to: Moment[]): Promise<void> {
    if (this.restoring || this.now === null || from.length === 0) return;
    const wanted = from.pop()!;
    this.restoring = true;
    try {
      this.viewer.play(false);
      this.viewer.unlit = wanted.unlit;
      if (!(await this.viewer.show(structuredClone(wanted.view), wanted.asset))) return;
      to.push(this.now);
      this.now = copyOf(wanted);
    } finally {
      this.restoring = false;
      this.divide();
      this.viewer.changed();
    }
  }
}

const copyOf = (moment: Moment): Moment => ({
  ...moment,
  view: structuredClone(moment.view),
});

/** Which members differ; it begins with "~" where all of them are numbers. "" where none does. */
function changedBetween(a: Moment, b: Moment): string {
  const names = new Set<string>();
  let numbers = true;
  if (a.asset !== b.asset || a.unlit !== b.unlit) numbers = false;
  const isSky = (text: string) => text.startsWith("sky:");
  const compare = (x: unknown, y: unknown, name: string): void => {
    if (Object.is(x, y)) return;
    if (typeof x === "object" && typeof y === "object" && x !== null && y !== null) {
      const [p, q] = [x as Record<string, unknown>, y as Record<string, unknown>];
      for (const key of new Set([...Object.keys(p), ...Object.keys(q)]))
        compare(p[key], q[key], Array.isArray(x) ? name : name === "" ? key : `${name}.${key}`);
      return;
    }
    const [place] = name.split(".");
    names.add(place === "camera" || place === "object" || place === "discs" ? place : name);
    // A camera that was the asset's own has begun to move; a sky is given by numbers.
    const runs =
      (typeof x === "number" && typeof y === "number") ||
      (name === "camera" && y !== null) ||
      (name === "environment.source" && isSky(String(x)) && isSky(String(y)));
    if (!runs) numbers = false;
  };
  compare(a.view, b.view, "");
  if (a.asset !== b.asset) names.add("asset");
  if (a.unlit !== b.unlit) names.add("unlit");
  return (numbers && names.size > 0 ? "~" : "") + [...names].sort().join(" ");
}
