// The shaders of relit surfaces. They write linear radiance; drawn onto the canvas, three's own
// tone mapping, colour space and fog follow, as for its own materials.

import { Vector3, type IUniform, type Texture } from "three";
import { baseColor } from "../generated/baseColor.js";
import { baseColorMap } from "../generated/baseColorMap.js";
import { coverage } from "../generated/coverage.js";
import { incident } from "../generated/incident.js";
import { incidentTexture } from "../generated/incidentTexture.js";
import { lobe } from "../generated/lobe.js";
import { sh } from "../generated/sh.js";
import { shadingNormal } from "../generated/shadingNormal.js";
import { shadingPoint } from "../generated/shadingPoint.js";
import { sunLight } from "../generated/sunLight.js";
import { sunShadow } from "../generated/sunShadow.js";
import { surfaceFrag } from "../generated/surfaceFrag.js";
import { surfaceVert } from "../generated/surfaceVert.js";
import { texelReceivers } from "../generated/texelReceivers.js";
import { mapUniforms } from "./coverage.js";
import { defines, flag, incidentDefines } from "./defines.js";
import type { RelitShaders } from "./relit-material.js";
import { kAlone, type Surroundings } from "./surroundings.js";

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
  surroundings?: Surroundings;
  /** Of a mirror: what it shows. */
  shown?: string;
  /** It may be there in parts alone. */
  gaps?: boolean;
  map: Texture | null;
  colored: boolean;
  uv: boolean;
  /** Texels lie by a second set of texture coordinates. */
  texelUv?: boolean;
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
  const { air, captured } = shape.surroundings ?? kAlone;
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
    CAPTURED: flag(captured),
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
    air,
    captured,
    shape.shown ?? "",
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
