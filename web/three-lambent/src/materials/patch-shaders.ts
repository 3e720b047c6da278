// The shaders of surfaces with meso-structure.

import { Vector2, type IUniform, type Texture } from "three";
import { baseColor } from "../generated/baseColor.js";
import { baseColorMap } from "../generated/baseColorMap.js";
import { coverage } from "../generated/coverage.js";
import { incident } from "../generated/incident.js";
import { incidentTexture } from "../generated/incidentTexture.js";
import { patchFrag } from "../generated/patchFrag.js";
import { patchPlace } from "../generated/patchPlace.js";
import { rowPlace } from "../generated/rowPlace.js";
import { rttFootprint } from "../generated/rttFootprint.js";
import { rttLookUp } from "../generated/rttLookUp.js";
import { rttResponse } from "../generated/rttResponse.js";
import { rttTexture } from "../generated/rttTexture.js";
import { shadingNormal } from "../generated/shadingNormal.js";
import { shadingPoint } from "../generated/shadingPoint.js";
import { surfaceVert } from "../generated/surfaceVert.js";
import { tangentFrame } from "../generated/tangentFrame.js";
import { viewSquare } from "../generated/viewSquare.js";
import { mapUniforms } from "./coverage.js";
import { defines, flag, incidentDefines } from "./defines.js";
import { responseMacros } from "./group-macros.js";
import type { RelitShaders } from "./relit-material.js";
import { kSurfaceKind } from "./relit-shaders.js";
import type { Surroundings } from "./surroundings.js";

/** What of meso-structure decides about its shaders. */
export interface PatchShape {
  bands: number;
  /** LAMBENT_NUMBERS of rtt_response.glsl, and groups of numbers in 16 bytes. */
  numbers: 0 | 1 | 2;
  groupsAFetch: number;
  fetch: boolean;
  filter: boolean;
  /** Whether views are corrected by their heights, which filtering takes. */
  relief: boolean;
  idMap: boolean;
  /** It may be there in parts alone. */
  gaps: boolean;
  /** Its tint: a texture, and whether vertices have colours. */
  map: Texture | null;
  colored: boolean;
  surroundings: Surroundings;
}

/** A surface with meso-structure. */
export function patchShaders(
  shape: PatchShape,
  uniforms: Record<string, IUniform>,
): RelitShaders {
  const coefficients = shape.bands ** 2;
  const { air, captured } = shape.surroundings;
  const common = defines({
    KIND: kSurfaceKind.vertices,
    VERTICES: 1,
    DIFFUSE: 0,
    GLOSSY: 0,
    PATCH: 1,
    SUN_SHARE: 0,
    ALPHA: flag(shape.gaps),
    FETCH: flag(shape.fetch),
    UV: 1,
    TEXEL_UV: 0,
    MAP: flag(shape.map),
    COLOR: flag(shape.colored),
    CAPTURED: flag(captured),
    NUMBERS: shape.numbers,
    FILTER: flag(shape.filter),
    RELIEF: flag(shape.relief),
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
    baseColor,
    shape.gaps ? coverage : "",
    shape.map ? baseColorMap : "",
    air,
    captured,
    patchFrag,
  ];
  const vertexParts = [common, light, incidentTexture, surfaceVert];
  return {
    vertex: vertexParts.join("\n"),
    fragment: parts.join("\n"),
    uniforms: {
      pixelWidth: { value: new Vector2() },
      ...(shape.map && mapUniforms(shape.map)),
      ...uniforms,
    },
  };
}
