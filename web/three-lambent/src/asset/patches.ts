// Surfaces with meso-structure: shade::LitPatch. No other file needs any of it.

import {
  BufferAttribute,
  DataTexture,
  NearestFilter,
  RGIntegerFormat,
  UnsignedShortType,
  Vector4,
  type IUniform,
  type WebGLRenderer,
} from "three";
import { LitTexture } from "../gpu/lit-texture.js";
import { kGroupsAFetch, kNumbersOf, RttTexture } from "../gpu/rtt-texture.js";
import { TurnFrames, TurnPass } from "../gpu/turn-pass.js";
import { patchShaders } from "../materials/patch-shaders.js";
import { coverageUniforms, hasGaps } from "../materials/coverage.js";
import type { RelitShaders } from "../materials/relit-material.js";
import { macroOf } from "./choices.js";
import type { MeshSource } from "./mesh-source.js";
import type { Choices, RelitMesh } from "./relit-mesh.js";

/** @throws Error if the device's textures are too small */
function idMapTexture({ transfer, what }: MeshSource, renderer: WebGLRenderer): DataTexture {
  const map = transfer!.biScale!.idMap!;
  const most = renderer.capabilities.maxTextureSize;
  if (map.width > most || map.height > most)
    throw new Error(
      `three-lambent: ${what}: an id map of ${map.width}×${map.height} texels, but this ` +
        `device takes ${most} a side: make it smaller`,
    );
  const texture = new DataTexture(
    map.ids as Uint16Array<ArrayBuffer>,
    map.width,
    map.height,
    RGIntegerFormat,
    UnsignedShortType,
  );
  texture.internalFormat = "RG16UI";
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Passes, textures and shaders of a mesh with meso-structure. */
export function buildPatch(
  mesh: RelitMesh,
  renderer: WebGLRenderer,
  choices: Choices,
): RelitShaders {
  const { description, source } = mesh;
  const lease = mesh.lease!;
  const transfer = mesh.transfer!;
  const biScale = transfer.biScale!;
  const rtt = description.rtts[biScale.rtt];
  const rttTexture = lease.take(`rtt ${biScale.rtt}`, () => new RttTexture(rtt));
  const rows = rtt.bands ** 2;
  const scales = rttTexture.scales();
  const macro = macroOf(description, transfer, choices.transfer, choices.macro);
  let texture: LitTexture;
  if (macro) {
    const columns = biScale.bands ** 2;
    const shape = { rows: columns, columns, channels: macro.channels };
    const name = macro === biScale.shadowed ? "shadowed macro" : "macro";
    texture = mesh.add(renderer, { name, numbers: () => macro.numbers, shape, rows }, { scales });
  } else {
    texture = new LitTexture(renderer.capabilities, transfer.receivers, rows, source.what);
    const frames = lease.take(
      `${source.key} frames`,
      () => new TurnFrames(source.normals(), biScale.tangents, rtt.bands, source.what),
    );
    const pass = new TurnPass(frames, texture);
    mesh.lits.push({ texture, pass, glossy: false, scales, light: "whole" });
  }

  const fetch = mesh.mustFetch(renderer, rows);
  if (!source.geometry.hasAttribute("lambentTangent"))
    source.geometry.setAttribute("lambentTangent", new BufferAttribute(biScale.tangents, 3));
  mesh.mesh.geometry = fetch ? source.expanded() : source.geometry;
  const uniforms: Record<string, IUniform> = {
    incidentLit: { value: texture.target.texture },
    incidentALine: { value: texture.receiversALine },
    rtt: { value: rttTexture.texture },
    rttRows: { value: rttTexture.rows },
    views: { value: rtt.views },
    viewDependent: { value: choices.viewDependent },
    levelCount: { value: rttTexture.levelCount },
    levels: { value: rttTexture.levels },
  };
  const heights = choices.filter ? rttTexture.heights : null;
  if (heights) {
    uniforms.relief = { value: rttTexture.relief };
    uniforms.heights = { value: heights.texture };
    uniforms.heightRows = { value: heights.rows };
  }
  if (biScale.idMap) {
    const idMap = lease.take(`${source.key} ids`, () => idMapTexture(source, renderer));
    uniforms.idMap = { value: idMap };
    const each = rtt.size.map((size) => 1 / (size * biScale.scale));
    uniforms.periodsPerMetre = { value: Float32Array.from(each) };
    uniforms.seams = { value: new Vector4() };
  } else {
    uniforms.tiles = { value: Float32Array.from(biScale.tiles) };
  }
  const gaps = hasGaps(source.coverage);
  if (gaps) Object.assign(uniforms, coverageUniforms(source.coverage, source.number));
  const [surroundings, around] = mesh.surroundings(choices);
  const { encoding } = rtt.numbers;
  const shape = {
    bands: rtt.bands,
    numbers: kNumbersOf[encoding],
    groupsAFetch: kGroupsAFetch[encoding],
    fetch,
    filter: choices.filter,
    relief: heights !== null,
    idMap: biScale.idMap !== null,
    gaps,
    map: source.texture,
    colored: source.colored,
    surroundings,
  };
  return patchShaders(shape, { ...uniforms, ...around });
}
