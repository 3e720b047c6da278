// What the controls say about the asset that is shown: figures, and why a choice is not there.
import type { TransferChoice } from "three-lambent";
import { bakeLine } from "./bake_line";
import type { History } from "./history";
import type { LoadedAsset } from "./load_asset";
import type { PanelFacts } from "./panel";
import { stillness, type Viewer } from "./viewer";

const count = (value: number): string => value.toLocaleString("en");

function bytes(value: number): string {
  return value < 1e6 ? `${(value / 1e3).toFixed(0)} kB` : `${(value / 1e6).toFixed(1)} MB`;
}

function figures({ asset, plain, bytes: size }: LoadedAsset): string {
  if (plain !== null) return `${count(plain.vertices)} vertices, ${bytes(size)}, not baked`;
  return `${count(asset.info.vertices)} vertices, ${count(asset.info.receivers)} receivers of ` +
    `${asset.info.bands} bands, ${bytes(size)}`;
}

export function facts(viewer: Viewer, environment: number, past: History): PanelFacts {
  const { loaded } = viewer.current;
  const asset = loaded?.asset ?? null;
  const notBaked = loaded !== null && asset === null ? "Only a baked asset can be relit." : null;
  const noTransfer: Record<TransferChoice, string | null> = {
    best: null,
    unshadowed: notBaked,
    shadowed: notBaked,
    interreflected: notBaked,
  };
  if (asset !== null) {
    if (!asset.offers("shadowed"))
      noTransfer.shadowed =
        "No shadows without bounces: bake with --keep-shadowed to switch bounces off.";
    if (!asset.offers("interreflected"))
      noTransfer.interreflected = "No bounces: it was baked shadowed or unshadowed.";
  }
  const sun = "The Sun's shadow stays soft: bake with --keep-shadowed to make it sharp.";
  return {
    assets: viewer.library.assets.map((each) => each.name),
    asset: viewer.asset,
    environments: viewer.library.environments.map((each) => each.name),
    environment,
    disc: viewer.disc,
    playing: viewer.playing,
    still: stillness().matches ? "This browser asks for reduced motion." : null,
    unlit: viewer.unlit,
    overlays: viewer.overlays,
    undoes: past.undoes,
    redoes: past.redoes,
    sky: {
      problem: viewer.sky.problem,
      follows: viewer.sky.follows,
      air: viewer.view.air,
      noShafts: viewer.view.sunShadow === "sharp" ? null : "They take a sharp shadow of the Sun.",
    },
    info: loaded === null ? "Drop a .glb here." : figures(loaded),
    bake: loaded?.plain ? bakeLine(loaded.name) : null,
    noTransfer,
    noSharpSun: notBaked ?? (asset === null || asset.offersSharpSun ? null : sun),
    noPatch: notBaked ?? (asset?.kinds.has("bi-scale") ? null : "No relief on this asset."),
    noLobe: notBaked ?? (asset?.kinds.has("glossy") ? null : "No glossy surface on this asset."),
    noLight: notBaked,
  };
}
