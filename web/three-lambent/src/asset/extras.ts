// What few assets need: fetched with the first file that asks for it, so that a page without such
// assets never has it.

import type { AssetDescription } from "../format/description.js";

/** Parts of the package, or null where an asset has no use for them. */
export interface Extras {
  /** Meso-structure. */
  patches: typeof import("./patches.js") | null;
  mirrors: typeof import("./mirrors.js") | null;
}

/** @param mirrors whether any surface is one */
export async function extrasOf(description: AssetDescription, mirrors: boolean): Promise<Extras> {
  const patched = [...description.primitives.values()].some(({ biScale }) => biScale);
  const [patchesPart, mirrorsPart] = await Promise.all([
    patched ? import("./patches.js") : null,
    mirrors ? import("./mirrors.js") : null,
  ]);
  return { patches: patchesPart, mirrors: mirrorsPart };
}
