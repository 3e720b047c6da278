// What the page opens by itself: what its address names, else what was open when it was left, else
// the first of its list. And what is said of an asset that was not baked.
import { bakeLine } from "./bake_line";
import { leftOut, linkOf, Links, linkTo } from "./link";
import { fetchManifest } from "./manifest";
import { messageOf } from "./messages";
import { Memory } from "./remember";
import type { Viewer } from "./viewer";

export class Session {
  private readonly links: Links;
  private memory: Memory | null = null;
  /** The asset that was spoken of last, and how to take that back. */
  private told: unknown = null;
  private untell: () => void = () => {};

  constructor(private readonly viewer: Viewer) {
    this.links = new Links(viewer);
    addEventListener("hashchange", () => void this.follow());
  }

  async begin(): Promise<void> {
    const { viewer } = this;
    try {
      viewer.loading.show("Loading", null);
      const manifest = await fetchManifest();
      viewer.library.addEnvironments(manifest.environments);
      viewer.library.addAssets(manifest.assets);
      const memory = new Memory(viewer, manifest);
      await this.openFirst(memory);
      this.memory = memory;
      performance.mark("lambent-first-view");
    } catch (error) {
      viewer.messages.error(messageOf(error));
    } finally {
      viewer.loading.hide();
      viewer.changed();
    }
  }
  private async openFirst(memory: Memory): Promise<void> {
    const { viewer } = this;
    const remembered = memory.read();
    if (location.hash.length > 1) {
      if (!(await this.links.open(location.hash))) await this.openOwn();
    } else if (remembered !== null && (await this.links.reopen(remembered))) {
      viewer.messages.stay("Everything is as it was left here.", {
        label: "Start afresh",
        title: "Show the page's own scene, as at first",
        press: () => void this.startAfresh(),
      });
    } else {
      await this.openOwn();
      memory.beginAt(linkTo(viewer));
      if (remembered !== null)
        viewer.messages.note(
          "What was open here before is no longer there: this is the page's own.");
    }
  }
  /** The first of the list, if nothing is shown. What a link had to say stays. */
  private async openOwn(): Promise<void> {
    const { viewer } = this;
    const first = viewer.library.assets[0];
    if (viewer.asset >= 0 || first === undefined) return;
    const said = viewer.messages.errors();
    if (await viewer.open(first)) for (const each of said) viewer.messages.error(each);
  }
  /** The address was changed by hand, or by a link within the page. */
  private async follow(): Promise<void> {
    if (await this.links.open(location.hash)) return;
    await this.openOwn();
  }

  /** The page's own scene, as it was first shown; nothing of before is remembered. */
  async startAfresh(): Promise<void> {
    const { viewer } = this;
    history.replaceState(null, "", location.pathname + location.search);
    const first = viewer.library.assets[0];
    if (first === undefined) return;
    viewer.unlit = false;
    viewer.play(false);
    const view = viewer.firstView(first);
    this.memory?.beginAt(linkOf(viewer.library, first, view));
    await viewer.open(first, view);
  }

  /** Call after anything changed. */
  note(): void {
    this.memory?.note();
    const { loaded } = this.viewer.current;
    if (loaded === this.told || loaded === null) return;
    this.told = loaded;
    this.untell();
    if (loaded.plain === null) return;
    const { name, stripped } = loaded;
    const line = bakeLine(name);
    this.untell = this.viewer.messages.stay(
      stripped
        ? `${name} was stripped by an optimiser: it had been baked, and what wrote it since ` +
            "dropped its transfer. It is shown as it is, under three.js's own light. Bake what " +
            `comes out of the optimiser: ${line}`
        : `${name} is not baked: it is shown as it is, under three.js's own light, without ` +
            `shadows or bounces. To relight it: ${line}`,
      { label: "Copy the line", title: line, press: () => void this.copyBakeLine() },
    );
  }
  async copyBakeLine(): Promise<void> {
    const { loaded } = this.viewer.current;
    if (loaded !== null) await this.copy(bakeLine(loaded.name), "The line is on the clipboard.");
  }
  async copyLink(): Promise<void> {
    const link = `${location.href.split("#")[0]}#${linkTo(this.viewer)}`;
    history.replaceState(null, "", link);
    const missing = leftOut(this.viewer);
    await this.copy(link, "The link is on the clipboard, and in the address bar.",
      "The address bar now holds the link.");
    if (missing.length === 0) return;
    this.viewer.messages.stay(
      `The link names ${missing.join(" and ")}, which came from this disk, and cannot carry it: ` +
        "whoever opens the link has to open the file by hand. The link says so.");
  }
  /** After files were opened. */
  opened(): Promise<void> {
    return this.links.opened();
  }
  private async copy(text: string, done: string, otherwise = text): Promise<void> {
    try {
      await navigator.clipboard.writeText(text);
      this.viewer.messages.note(done);
    } catch {
      this.viewer.messages.stay(otherwise);
    }
  }
}
