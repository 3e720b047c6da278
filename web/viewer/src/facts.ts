// What the controls say about the asset that is shown: figures, and why a choice is not there.
import type { TransferChoice } from "three-lambent";
import type { PanelFacts } from "./panel";
import type { Viewer } from "./viewer";

const count = (value: number): string => value.toLocaleString("en");

function bytes(value: number): string {
  return value < 1e6 ? `${(value / 1e3).toFixed(0)} kB` : `${(value / 1e6).toFixed(1)} MB`;
}

export function facts(viewer: Viewer, environment: number): PanelFacts {
  const loaded = viewer.current.loaded;
  const asset = loaded?.asset;
  const kinds = asset?.kinds;
  const noTransfer: Record<TransferChoice, string | null> = {
    best: null,
    unshadowed: null,
    shadowed: null,
    interreflected: null,
  };
  if (asset !== undefined) {
    if (!asset.offers("shadowed"))
      noTransfer.shadowed =
        "Without shadows alone: bake with --keep-shadowed to switch bounces off.";
    if (!asset.offers("interreflected"))
      noTransfer.interreflected = "Without bounces: it was baked shadowed or unshadowed.";
  }
  return {
    assets: viewer.assets.map((each) => each.name),
    asset: viewer.asset,
    environments: viewer.environments.map((each) => each.name),
    environment,
    disc: viewer.disc,
    playing: viewer.playing,
    unlit: viewer.unlit,
    sky: {
      problem: viewer.skyProblem,
      follows: viewer.follows,
      air: viewer.view.air,
      noShafts: viewer.view.sunShadow === "sharp" ? null : "They take a sharp shadow of the Sun.",
    },
    info:
      asset === undefined
        ? "Drop a .glb that lambent bake wrote."
        : `${count(asset.info.vertices)} vertices, ${count(asset.info.receivers)} receivers of ` +
          `${asset.info.bands} bands, ${bytes(loaded!.bytes)}`,
    noTransfer,
    noSharpSun:
      asset === undefined || asset.offersSharpSun
        ? null
        : "The Sun's shadow stays soft: bake with --keep-shadowed to make it sharp.",
    noPatch: kinds?.has("bi-scale") ? null : "No meso-structure on this asset.",
    noLobe: kinds?.has("glossy") ? null : "No glossy surface on this asset.",
  };
}
