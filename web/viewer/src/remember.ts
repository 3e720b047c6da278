// What was open when the page was left, in the browser's own storage: an asset of the list or from
// an address, and its view. Files of a disk cannot be opened again, and are not remembered.
import { leftOut, linkTo } from "./link";
import type { Manifest } from "./manifest";
import type { Viewer } from "./viewer";

const kDelay = 400; // milliseconds after the last change

export class Memory {
  private readonly key = `lambent ${location.pathname}`;
  private readonly list: string;
  private due = 0;
  /** As the page shows itself: nothing to remember. */
  private pristine = "";

  /** What another list was left with says nothing of this one. */
  constructor(
    private readonly viewer: Viewer,
    { assets, environments }: Manifest,
  ) {
    this.list = JSON.stringify([assets.map((e) => e.name), environments.map((e) => e.source)]);
    addEventListener("pagehide", () => this.write());
  }

  /** The link to what was open; null: nothing is remembered. */
  read(): string | null {
    try {
      const { list, link } = JSON.parse(localStorage.getItem(this.key) ?? "{}") as
        Record<string, unknown>;
      return list === this.list && typeof link === "string" ? link : null;
    } catch {
      return null; // no storage, or not ours
    }
  }
  forget(): void {
    clearTimeout(this.due);
    this.due = 0;
    try {
      localStorage.removeItem(this.key);
    } catch {
      // There is no storage, and nothing in it.
    }
  }
  /** `link` is to what the page shows by itself. */
  beginAt(link: string): void {
    this.pristine = link;
    this.forget();
  }
  /** Call after anything changed. */
  note(): void {
    clearTimeout(this.due);
    this.due = window.setTimeout(() => this.write(), kDelay);
  }
  private write(): void {
    if (this.due === 0) return;
    this.due = 0;
    const { viewer } = this;
    if (viewer.asset < 0 || leftOut(viewer).length > 0) return;
    const link = linkTo(viewer);
    if (link === this.pristine) return this.forget();
    try {
      localStorage.setItem(this.key, JSON.stringify({ list: this.list, link }));
    } catch {
      // No storage, or it is full: the page begins as it did.
    }
  }
}
