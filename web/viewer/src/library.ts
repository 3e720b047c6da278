// What a viewer can open: assets and environments by their names, and how to read the files behind.
import { kLightExtensions } from "./environment_map";
import { MissingLight, type Files, type ReadFile } from "./environments";
import type { AssetEntry, EnvironmentEntry } from "./manifest";
import { messageOf } from "./messages";

/** Where an asset came from, which is what a link can say of it. */
export type Origin = "listed" | "address" | "file";

/** An asset by its name: of the list, from an address, or a file that a person gave. */
export interface Opened {
  name: string;
  read: ReadFile;
  origin: Origin;
  /** Of an asset from an address. */
  address?: string;
  /** Members of a view that suit it. */
  view?: Record<string, unknown>;
}

export class Library implements Files {
  readonly assets: Opened[] = [];
  readonly environments: EnvironmentEntry[] = [];
  private readonly files = new Map<string, ReadFile>();
  /** Names of lights that a person gave: no link can bring them. */
  readonly given = new Set<string>();

  /** `fetched` reads what has an address; progress is its matter. */
  constructor(readonly fetched: (address: string) => ReadFile) {}

  addEnvironments(entries: readonly EnvironmentEntry[]): void {
    for (const entry of entries) {
      this.environments.push(entry);
      for (const [name, address] of Object.entries(entry.files))
        this.files.set(name, this.fetched(address));
    }
  }
  addAssets(entries: readonly AssetEntry[]): void {
    for (const { name, file, view } of entries)
      this.assets.push({ name, read: this.fetched(file), origin: "listed", view });
  }
  /** The asset at an address, in the list once. */
  atAddress(address: string): Opened {
    const known = this.assets.find((each) => each.address === address);
    if (known !== undefined) return known;
    const name = nameOfAddress(address);
    return { name, read: this.fetched(address), origin: "address", address };
  }
  indexOf(opened: Opened): number {
    return this.assets.indexOf(opened);
  }
  firstSource(): string {
    return this.environments[0]?.source ?? "uniform:1";
  }

  names(): Iterable<string> {
    return this.files.keys();
  }
  /** Of a name that nobody gave a file for: what lies there beside the page, if it is a light. */
  read(name: string): ReadFile | undefined {
    const file = this.files.get(name);
    if (file !== undefined) return file;
    const path = name.replace(/[?#].*$/, "").toLowerCase();
    if (!kLightExtensions.some((each) => path.endsWith(each))) return undefined;
    const fetched = this.fetched(name);
    return () =>
      fetched().catch((error: unknown) => {
        throw new MissingLight(name, messageOf(error));
      });
  }
  /** Runs `work` with a light under a name; takes it away again where that answers false. */
  async withLight(name: string, read: ReadFile, work: () => Promise<boolean>): Promise<boolean> {
    const before = this.files.get(name);
    this.files.set(name, read);
    const shown = await work();
    if (shown) this.given.add(name);
    else if (before === undefined) this.files.delete(name);
    else this.files.set(name, before);
    return shown;
  }
}

export function nameOfAddress(address: string): string {
  const path = address.replace(/[?#].*$/, "");
  const last = path.split("/").pop() || path;
  try {
    return decodeURIComponent(last);
  } catch {
    return last;
  }
}
