// The part of an address after '#', which names what is open and how it is shown:
//   #asset=NAME   an asset of the page's list    &view=JSON   the view, as it is saved
//   #src=ADDRESS  one from an address            &light=NAME  a file of light that the view takes
//   #file=NAME    a file of somebody's disk
// What is a file of somebody's disk no link can carry: whoever opens the link opens it by hand.
import { isFile, termsOf } from "./source";
import type { Library, Opened } from "./library";
import { messageOf } from "./messages";
import { parseView, viewToJson, type ViewState } from "./view_state";
import type { Viewer } from "./viewer";

export interface Link {
  asset: { by: "asset" | "src" | "file"; name: string } | null;
  lights: string[];
  view: ViewState | null;
}

/** What stands after '#' for what is shown. */
export function linkTo({ library, asset, view }: Viewer): string {
  return linkOf(library, library.assets[asset], view);
}
/** The same for an asset and a view of it. */
export function linkOf(library: Library, opened: Opened | undefined, view: ViewState): string {
  const parts = new URLSearchParams();
  if (opened?.origin === "listed") parts.set("asset", opened.name);
  else if (opened?.address !== undefined) parts.set("src", opened.address);
  else if (opened !== undefined) parts.set("file", opened.name);
  for (const light of givenLights(library, view)) parts.append("light", light);
  parts.set("view", JSON.stringify(JSON.parse(viewToJson(view))));
  return parts.toString();
}
/** Names of the files that a link to what is shown cannot carry. */
export function leftOut({ library, asset, view }: Viewer): string[] {
  const opened = library.assets[asset];
  return [...(opened?.origin === "file" ? [opened.name] : []), ...givenLights(library, view)];
}
function givenLights(library: Library, view: ViewState): string[] {
  const terms = termsOf(view.environment.source, library.names());
  return terms.filter((each) => library.given.has(each));
}

/** null: there is no link. Throws an Error that says what cannot be read. */
export function parseLink(hash: string): Link | null {
  const parts = new URLSearchParams(hash.replace(/^#/, ""));
  const by = (["asset", "src", "file"] as const).find((each) => parts.has(each));
  const json = parts.get("view");
  if (by === undefined && json === null) {
    if ([...parts.keys()].length === 0) return null;
    throw new Error("it names neither an asset nor a view");
  }
  const name = by === undefined ? "" : parts.get(by)!;
  if (by !== undefined && name === "") throw new Error(`"${by}" is empty`);
  return {
    asset: by === undefined ? null : { by, name },
    lights: parts.getAll("light"),
    view: json === null ? null : viewOf(json),
  };
}
function viewOf(text: string): ViewState {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw new Error("its view is no JSON: a part of the link is missing");
  }
  const { version } = (json ?? {}) as { version?: unknown };
  if (typeof version === "number" && version > 1)
    throw new Error(`it is of a newer page than this one (its view has version ${version})`);
  return parseView(json, "view");
}

/** Opens links, and keeps what is left of one that waits for files. */
export class Links {
  private waiting: Link | null = null;

  constructor(private readonly viewer: Viewer) {}

  /** True if what the link names is shown; else it says why not, or what is missing. */
  async open(hash: string): Promise<boolean> {
    this.waiting = null;
    const { messages } = this.viewer;
    let link: Link | null;
    try {
      link = parseLink(hash);
    } catch (error) {
      const why = messageOf(error);
      messages.error(`This link cannot be read: ${why}. The page shows its own scene.`);
      return false;
    }
    if (link === null) return false;
    const missing = this.missing(link);
    if (missing.length === 0) {
      if (await this.show(link)) return true;
      // A light of another page's list: once it is here, the link can be shown.
      const lights = this.unknownLights(link);
      if (lights.length > 0) this.waiting = { ...link, lights: [...link.lights, ...lights] };
      return false;
    }
    this.waiting = link;
    const files = missing.join(" and ");
    const [the, them] = missing.length > 1 ? ["the files", "them"] : ["the file", "it"];
    messages.stay(`This link shows ${files}, which no link can carry: open ${the} here ` +
      `(O, or drop ${them}), and all is shown as the link has it.`);
    return false;
  }
  /** The same of what was remembered: where something of it is missing, false and no more. */
  async reopen(hash: string): Promise<boolean> {
    try {
      const link = parseLink(hash);
      return link !== null && this.missing(link).length === 0 && (await this.show(link));
    } catch {
      return false;
    }
  }
  /** After files were opened: they may be what a link waited for. */
  async opened(): Promise<void> {
    const link = this.waiting;
    if (link === null || this.missing(link).length > 0) return;
    this.waiting = null;
    if (await this.show(link)) this.viewer.messages.note("It is shown as the link has it.");
  }

  private missing({ asset, lights }: Link): string[] {
    const { library } = this.viewer;
    const known = new Set(library.names());
    const absent = lights.filter((each) => !known.has(each));
    if (asset !== null && find(library, asset) === undefined) absent.unshift(asset.name);
    return absent;
  }
  private unknownLights({ view }: Link): string[] {
    const known = new Set(this.viewer.library.names());
    const terms = view === null ? [] : termsOf(view.environment.source, known);
    return terms.filter((each) => isFile(each) && !known.has(each));
  }
  private show({ asset, view }: Link): Promise<boolean> {
    const { viewer } = this;
    const { assets } = viewer.library;
    const opened =
      asset === null ? assets[Math.max(0, viewer.asset)] : find(viewer.library, asset);
    if (opened === undefined) return Promise.resolve(false);
    if (viewer.library.indexOf(opened) === viewer.asset && viewer.asset >= 0 && view !== null)
      return viewer.openView({ lambent: "view", ...view }, "the link");
    return viewer.open(opened, view ?? undefined);
  }
}

function find(library: Library, { by, name }: NonNullable<Link["asset"]>): Opened | undefined {
  if (by === "src") return library.atAddress(name);
  const origin = by === "asset" ? "listed" : "file";
  const named = library.assets.filter((each) => each.name === name);
  return named.find((each) => each.origin === origin) ?? named[0];
}
