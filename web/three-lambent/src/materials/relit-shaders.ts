// The shaders of relit surfaces. They write linear radiance; drawn onto the canvas, three's own
// tone mapping, colour space and fog follow, as for its own materials.

import { Vector2, Vector3, type IUniform, type Texture } from "three";
import {
  baseColor,
  baseColorMap,
  captured,
  coverage,
  incident,
  incidentTexture,
  lobe,
  localCapture,
  patchFrag,
  patchPlace,
  rowPlace,
  rttFootprint,
  rttLookUp,
  rttResponse,
  rttTexture,
  sh,
  shadingNormal,
  shadingPoint,
  sunLight,
  sunShadow,
  surfaceFrag,
  surfaceVert,
  tangentFrame,
  texelReceivers,
  viewSquare,
} from "../generated/shaders.js";
import { airSource, type AirMode } from "./air-source.js";
import { mapUniforms } from "./coverage.js";
import { environmentGlsl } from "./environment-uniforms.js";
import { eachGroup, incidentGroups, responseMacros } from "./group-macros.js";
import type { RelitShaders } from "./relit-material.js";

/** LAMBENT_KIND of surface.frag.glsl. */
export const kSurfaceKind = { vertices: 0, texels: 1, mirror: 2, black: 3, unlit: 4 } as const;

/** What of a surface decides about its shaders. */
export interface SurfaceShape {
  kind: keyof typeof kSurfaceKind;
  diffuse?: boolean;
  albedoOutside?: boolean;
  /** Bands of the lobe; 0: not glossy. */
  lobeBands?: number;
  /** The fragment shader fetches the light at the triangle's corners. */
  fetch?: boolean;
  /** A sharp Sun shines on it, and can be hidden; what is known of it is to be taken out. */
  sun?: "open" | "hidden" | null;
  sunShare?: boolean;
  /** What it is seen through. */
  air?: AirMode;
  /** Mirrors see it; a mirror sees the asset. */
  captured?: boolean;
  /** It may be there in parts alone. */
  gaps?: boolean;
  map: Texture | null;
  colored: boolean;
  uv: boolean;
  /** Texels lie by a second set of texture coordinates. */
  texelUv?: boolean;
}

/** What of meso-structure decides about its shaders. */
export interface PatchShape {
  bands: number;
  /** LAMBENT_NUMBERS of rtt_response.glsl, and groups of numbers in 16 bytes. */
  numbers: 0 | 1 | 2;
  groupsAFetch: number;
  fetch: boolean;
  filter: boolean;
  idMap: boolean;
  air: AirMode;
  captured: boolean;
}

const flag = (value: unknown) => (value ? 1 : 0);

function defines(values: Record<string, string | number>): string {
  return Object.entries(values)
    .map(([name, value]) => `#define LAMBENT_${name} ${value}\n`)
    .join("");
}

/** What incident.glsl and incident_texture.glsl want before them. */
function incidentDefines(coefficients: number, interpolated: boolean): string {
  return defines({
    GROUPS: incidentGroups(coefficients),
    "EACH_GROUP(DO)": eachGroup(coefficients),
    INTERPOLATED: flag(interpolated),
    LIGHT_PLACE: "ivec2",
  });
}

/** A surface without meso-structure. Uniforms of its results are the caller's to set. */
export function surfaceShaders(
  shape: SurfaceShape,
  uniforms: Record<string, IUniform>,
): RelitShaders {
  const coefficients = (shape.lobeBands ?? 0) ** 2;
  const vertices = shape.kind === "vertices";
  const map = shape.uv ? shape.map : null;
  const glossy = coefficients > 0 && (vertices || shape.kind === "texels");
  const fetch = shape.fetch && glossy && vertices;
  const mirror = shape.kind === "mirror";
  const sun = shape.sun === "hidden" ? 2 : flag(shape.sun);
  const common = defines({
    KIND: kSurfaceKind[shape.kind],
    VERTICES: flag(vertices),
    DIFFUSE: flag(shape.diffuse && (vertices || shape.kind === "texels")),
    GLOSSY: flag(glossy),
    PATCH: 0,
    FETCH: flag(fetch),
    MAP: flag(map),
    UV: flag(shape.uv),
    TEXEL_UV: flag(shape.texelUv),
    COLOR: flag(shape.colored),
    ALBEDO_OUTSIDE: flag(shape.albedoOutside),
    SUN: sun,
    SUN_SHARE: flag(shape.sunShare),
    ALPHA: flag(shape.gaps),
    CAPTURED: flag(shape.captured),
  });
  const light = glossy ? incidentDefines(coefficients, vertices && !fetch) : "";
  const parts = [
    common,
    light,
    glossy ? `#define LAMBENT_BANDS ${shape.lobeBands}\n${sh}` : "",
    glossy ? incident + incidentTexture + lobe : "",
    shadingNormal,
    shadingPoint,
    baseColor,
    shape.gaps ? coverage : "",
    map ? baseColorMap : "",
    shape.kind === "texels" ? texelReceivers : "",
    sun === 2 ? sunShadow : "",
    sun ? sunLight : "",
    airSource(shape.air ?? "none"),
    shape.captured ? captured : "",
    mirror ? environmentGlsl : "",
    mirror && shape.captured ? localCapture : "",
    surfaceFrag,
  ];
  const vertexParts = [common, light, glossy ? incidentTexture : "", surfaceVert];
  return {
    vertex: vertexParts.join("\n"),
    fragment: parts.join("\n"),
    uniforms: {
      reflectance: { value: new Vector3(1, 1, 1) },
      ...(map && mapUniforms(map)),
      ...uniforms,
    },
  };
}

/** A surface with meso-structure. */
export function patchShaders(
  shape: PatchShape,
  uniforms: Record<string, IUniform>,
): RelitShaders {
  const coefficients = shape.bands ** 2;
  const common = defines({
    KIND: kSurfaceKind.vertices,
    VERTICES: 1,
    DIFFUSE: 0,
    GLOSSY: 0,
    PATCH: 1,
    SUN_SHARE: 0,
    ALPHA: 0,
    FETCH: flag(shape.fetch),
    UV: 1,
    TEXEL_UV: 0,
    COLOR: 0,
    CAPTURED: flag(shape.captured),
    NUMBERS: shape.numbers,
    FILTER: flag(shape.filter),
    ID_MAP: flag(shape.idMap),
    RESPONSE: responseMacros(coefficients, shape.groupsAFetch),
    RTT_PLACE: "ivec3",
  });
  const light = incidentDefines(coefficients, !shape.fetch);
  const parts = [
    common,
    light,
    incident,
    incidentTexture,
    rowPlace,
    rttResponse,
    rttTexture,
    viewSquare,
    rttFootprint,
    rttLookUp,
    tangentFrame,
    shadingNormal,
    shadingPoint,
    patchPlace,
    airSource(shape.air),
    shape.captured ? captured : "",
    patchFrag,
  ];
  const vertexParts = [common, light, incidentTexture, surfaceVert];
  return {
    vertex: vertexParts.join("\n"),
    fragment: parts.join("\n"),
    uniforms: { pixelWidth: { value: new Vector2() }, ...uniforms },
  };
}
