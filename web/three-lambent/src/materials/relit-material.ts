// The materials of relit surfaces. They write linear radiance; drawn onto the canvas, three's own
// tone mapping and colour space follow, as for its own materials.

import {
  DoubleSide,
  Matrix3,
  Matrix4,
  ShaderMaterial,
  Vector2,
  Vector3,
  Vector4,
  type Camera,
  type IUniform,
  type Object3D,
  type Texture,
  type WebGLRenderer,
} from "three";
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

const inverse = new Matrix4();
const vector = new Vector4();

export class RelitMaterial extends ShaderMaterial {
  override readonly type: string = "LambentRelitMaterial";
  /** Sub-samples of a pixel that the caller adds up: what is filtered is as much narrower. */
  samples = 1;
  /** Which of them comes next. */
  sample = 0;

  constructor(vertex: string, fragment: string, uniforms: Record<string, IUniform>) {
    super({
      vertexShader: vertex,
      fragmentShader: fragment,
      uniforms: {
        eye: { value: new Vector4() },
        pixelWidth: { value: new Vector2() },
        worldFromAsset: { value: new Matrix3() },
        ...uniforms,
      },
      side: DoubleSide, // what is seen from behind is black, and hides what lies behind it
      clipping: true,
    });
  }

  /** For a mesh's onBeforeRender: the eye, and how wide a pixel is, in the asset's frame. */
  look(renderer: WebGLRenderer, camera: Camera, object: Object3D): void {
    this.lookFrom(renderer, camera, inverse.copy(object.matrixWorld).invert(), this.samples);
    this.place(object.matrixWorld);
  }

  /** The same for a camera that stands in the asset's frame, and one picture alone. */
  lookAround(renderer: WebGLRenderer, camera: Camera, worldFromAsset: Matrix4): void {
    this.lookFrom(renderer, camera, inverse.identity(), 1);
    this.place(worldFromAsset);
  }

  private lookFrom(
    renderer: WebGLRenderer,
    camera: Camera,
    assetFromCameras: Matrix4,
    samples: number,
  ): void {
    const { eye, pixelWidth } = this.uniforms;
    const height = renderer.getCurrentViewport(vector).w;
    // Half the picture's height: at distance 1, or of an orthographic camera at any.
    const half = 1 / Math.abs(camera.projectionMatrix.elements[5]);
    const width = (2 * half) / (height * Math.sqrt(samples));
    const orthographic = camera.projectionMatrix.elements[15] === 1;
    const c = camera.matrixWorld.elements;
    if (orthographic) {
      const scale = assetFromCameras.getMaxScaleOnAxis();
      eye.value.set(c[8], c[9], c[10], 0).applyMatrix4(assetFromCameras).normalize();
      pixelWidth.value.set(0, width * scale);
    } else {
      eye.value.set(c[12], c[13], c[14], 1).applyMatrix4(assetFromCameras);
      pixelWidth.value.set(width, 0);
    }
  }

  private place(worldFrom: Matrix4): void {
    const { veil, worldFromAsset } = this.uniforms;
    if (veil) veil.value[1] = this.sample;
    worldFromAsset.value.setFromMatrix4(worldFrom);
    const scale = worldFrom.getMaxScaleOnAxis();
    if (scale > 0) worldFromAsset.value.multiplyScalar(1 / scale);
    this.uniformsNeedUpdate = true;
  }
}

/** A surface without meso-structure. Uniforms of its results are the caller's to set. */
export function makeSurfaceMaterial(
  shape: SurfaceShape,
  uniforms: Record<string, IUniform>,
): RelitMaterial {
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
    mirror ? `uniform mat3 worldFromAsset;\n${environmentGlsl}` : "",
    mirror && shape.captured ? localCapture : "",
    surfaceFrag,
  ];
  const vertexParts = [common, light, glossy ? incidentTexture : "", surfaceVert];
  const material = new RelitMaterial(vertexParts.join("\n"), parts.join("\n"), {
    reflectance: { value: new Vector3(1, 1, 1) },
    ...(map && mapUniforms(map)),
    ...uniforms,
  });
  material.vertexColors = shape.colored;
  return material;
}

/** A surface with meso-structure. */
export function makePatchMaterial(
  shape: PatchShape,
  uniforms: Record<string, IUniform>,
): RelitMaterial {
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
  return new RelitMaterial(vertexParts.join("\n"), parts.join("\n"), uniforms);
}
