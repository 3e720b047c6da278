// What an asset says about itself.

import type { AssetDescription } from "../format/description.js";
import type { RelitMesh } from "./relit-mesh.js";

/** Kinds of surfaces that an asset may have. */
export type AssetKind = "diffuse" | "glossy" | "texels" | "mirror" | "bi-scale";

/** What an asset says about itself. */
export interface AssetInfo {
  /** Of the format. */
  version: string;
  generator: string;
  /** What was simulated: "unshadowed", "shadowed" or "interreflected". */
  transfer: string;
  /** Bands of light that relight it. */
  bands: number;
  directions: number;
  bounces: number;
  vertices: number;
  triangles: number;
  receivers: number;
  /** Bytes of transfer, RTTs and id maps in the file. */
  transferBytes: number;
}

export function kindsOf(meshes: readonly RelitMesh[]): Set<AssetKind> {
  const kinds = new Set<AssetKind>();
  for (const { transfer, isMirror } of meshes) {
    if (isMirror) kinds.add("mirror");
    else if (transfer?.biScale) kinds.add("bi-scale");
    if (transfer?.vectors) kinds.add("diffuse");
    if (transfer?.matrices) kinds.add("glossy");
    if (transfer?.grid) kinds.add("texels");
  }
  return kinds;
}

export function infoOf(description: AssetDescription, meshes: readonly RelitMesh[]): AssetInfo {
  let [vertices, triangles, receivers, transferBytes] = [0, 0, 0, 0];
  for (const { source, transfer } of meshes) {
    const { index } = source.geometry;
    const { count } = source.geometry.getAttribute("position");
    vertices += count;
    triangles += (index ? index.count : count) / 3;
    receivers += transfer?.receivers ?? 0;
    const blocks = [
      transfer?.vectors?.numbers,
      transfer?.matrices?.numbers,
      transfer?.shadowed?.vectors?.numbers,
      transfer?.shadowed?.matrices?.numbers,
      transfer?.biScale?.shadowed?.numbers,
      transfer?.biScale?.interreflected?.numbers,
    ];
    for (const numbers of blocks) transferBytes += numbers?.data.byteLength ?? 0;
    transferBytes += transfer?.biScale?.idMap?.ids.byteLength ?? 0;
  }
  for (const { numbers } of description.rtts) transferBytes += numbers.data.byteLength;
  const { version, generator, transfer, bands, directions, bounces } = description;
  return {
    ...{ version, generator, transfer, bands, directions, bounces },
    ...{ vertices, triangles, receivers, transferBytes },
  };
}
