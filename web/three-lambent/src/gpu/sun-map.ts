// What hides a point of the Sun from an asset: a map of depths, drawn anew for each point of the disc.
// As lambent/render/gl_sun_map.cpp: the map covers what is seen alone, the box, seen from the Sun, of
// the view's frustum, where that is smaller than that of the asset; towards the Sun it reaches as far
// as the asset does.

import {
  Box3,
  DepthTexture,
  DoubleSide,
  FloatType,
  GLSL3,
  GreaterDepth,
  LessDepth,
  Matrix3,
  Matrix4,
  Mesh,
  NearestFilter,
  NoBlending,
  RawShaderMaterial,
  RedFormat,
  Scene,
  Vector3,
  Vector4,
  WebGLRenderTarget,
  type BufferGeometry,
  type IUniform,
  type Texture,
  type WebGLRenderer,
} from "three";
import { baseColor } from "../generated/baseColor.js";
import { baseColorMap } from "../generated/baseColorMap.js";
import { coverage as coverageGlsl } from "../generated/coverage.js";
import { sunMapCutFrag } from "../generated/sunMapCutFrag.js";
import { sunMapCutVert } from "../generated/sunMapCutVert.js";
import { sunMapFrag } from "../generated/sunMapFrag.js";
import { sunMapVert } from "../generated/sunMapVert.js";
import { worldFromTangent, type Vector } from "../light/frames.js";
import { coverageUniforms, hasGaps, mapUniforms, type Coverage } from "../materials/coverage.js";
import { reversesDepth } from "./depth.js";
import { PassCamera } from "./pass-camera.js";
import { renderInto } from "./render-into.js";

/** Texels of a side, where the device takes as many. */
const kSide = 2048;
const kBorder = 2; // texels around what is seen

/** The corners of what is seen, turned into the Sun's frame; null: they are not finite. */
function frustumBox(clipFromAsset: Matrix4, frameFromAsset: Matrix4): Box3 | null {
  const frameFromClip = clipFromAsset.clone().invert().premultiply(frameFromAsset);
  const box = new Box3();
  for (let k = 0; k < 8; ++k)
    box.expandByPoint(
      new Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1).applyMatrix4(frameFromClip),
    );
  return [...box.min.toArray(), ...box.max.toArray()].every(Number.isFinite) ? box : null;
}

/** What throws shadows: all of a geometry, or as much of it as is there. */
export interface Caster {
  geometry: BufferGeometry;
  coverage: Coverage;
  texture: Texture | null;
  /** It lies on another, which hides as much. */
  layer: boolean;
}

/** Depth of what is there alone. `number`: as the surface's own. */
function gapsMaterial(
  { coverage, texture }: Caster,
  number: number,
  clipFromAsset: IUniform<Matrix4>,
): RawShaderMaterial {
  const begin = `precision highp float;\nprecision highp int;\n#define LAMBENT_MAP ${texture ? 1 : 0}\n`;
  const parts = [baseColor, coverageGlsl, texture ? baseColorMap : "", sunMapCutFrag];
  return new RawShaderMaterial({
    ...kDepthAlone,
    vertexShader: `precision highp float;\n${sunMapCutVert}`,
    fragmentShader: begin + parts.join("\n"),
    uniforms: {
      clipFromAsset,
      ...coverageUniforms(coverage, number),
      ...(texture && mapUniforms(texture)),
    },
  });
}

const kDepthAlone = {
  glslVersion: GLSL3,
  side: DoubleSide,
  depthFunc: LessDepth,
  colorWrite: false,
  blending: NoBlending,
} as const;

/** Where a map lies. */
interface Placement {
  /** To texels, and depth 0 … 1. */
  mapFromAsset: Matrix4;
  frame: Matrix3;
  texel: number;
  range: number;
}

function placementOf(
  towards: Vector,
  bounds: Box3,
  clipFromAsset: Matrix4 | null,
  side: number,
): Placement {
  const [x, y] = worldFromTangent(towards);
  const frame = new Matrix3().set(...x, ...y, ...towards);
  const turn = new Matrix4().setFromMatrix3(frame);
  const all = bounds.clone().applyMatrix4(turn);
  const box = all.clone();
  const seen = clipFromAsset && frustumBox(clipFromAsset, turn);
  if (seen) {
    for (const axis of ["x", "y"] as const) {
      box.min[axis] = Math.max(box.min[axis], seen.min[axis]);
      box.max[axis] = Math.min(box.max[axis], seen.max[axis]);
    }
    if (!(box.min.x <= box.max.x && box.min.y <= box.max.y)) box.copy(all); // nothing is seen
  }
  // Square texels: both sides are as long as the longer.
  const diagonal = all.getSize(new Vector3()).length();
  const least = 1e-6 * Math.max(diagonal, 1e-30);
  const size = box.getSize(new Vector3());
  const texel = Math.max(size.x, size.y, least) / (side - 2 * kBorder);
  const middle = box.getCenter(new Vector3());
  const margin = 0.001 * diagonal + least;
  const nearest = all.max.z + margin;
  const range = nearest - (all.min.z - margin);
  const mapFromFrame = new Matrix4().set(
    ...[1 / texel, 0, 0, 0.5 * side - middle.x / texel],
    ...[0, 1 / texel, 0, 0.5 * side - middle.y / texel],
    ...[0, 0, -1 / range, nearest / range],
    ...([0, 0, 0, 1] as const),
  );
  return { mapFromAsset: mapFromFrame.multiply(turn), frame, texel, range };
}

export class SunMap {
  /** Of shaders/sun_shadow.glsl. */
  readonly uniforms = {
    sunMap: { value: null as Texture | null },
    sunMapFromWorld: { value: new Matrix4() },
    sunFrameFromWorld: { value: new Matrix3() },
    sunMapScales: { value: new Vector4() },
  };
  private target: WebGLRenderTarget | null = null;
  private readonly scene = new Scene();
  private readonly camera = new PassCamera();
  /** Of all that throws shadows. */
  readonly bounds = new Box3();
  private readonly material = new RawShaderMaterial({
    ...kDepthAlone,
    vertexShader: `precision highp float;\n${sunMapVert}`,
    fragmentShader: `precision highp float;\n${sunMapFrag}`,
    uniforms: { clipFromAsset: { value: new Matrix4() } },
  });
  private readonly gaps: RawShaderMaterial[] = [];
  private done = "";

  /** @param casters all that throws shadows, in one frame: the asset's */
  constructor(casters: readonly Caster[]) {
    this.scene.matrixWorldAutoUpdate = false;
    for (const [number, caster] of casters.entries()) {
      const { geometry, coverage } = caster;
      if (caster.layer) continue;
      if (!geometry.boundingBox) geometry.computeBoundingBox();
      this.bounds.union(geometry.boundingBox!);
      const clipFromAsset = this.material.uniforms.clipFromAsset;
      const whole = !hasGaps(coverage);
      const material = whole ? this.material : gapsMaterial(caster, number, clipFromAsset);
      if (!whole) this.gaps.push(material);
      const mesh = new Mesh(geometry, material);
      mesh.frustumCulled = false;
      this.scene.add(mesh);
    }
  }

  /**
   * Draws the map, unless it is there: as the point of the Sun looks at the asset.
   *
   * @param towards unit, in the asset's frame
   * @param clipFromAsset what is seen; null: all of the asset may be
   */
  draw(renderer: WebGLRenderer, towards: Vector, clipFromAsset: Matrix4 | null): void {
    const state = [...towards, ...(clipFromAsset?.elements ?? [])].join();
    if (state === this.done) return;
    const side = Math.min(kSide, renderer.capabilities.maxTextureSize);
    const target = (this.target ??= depthTarget(side));
    const { mapFromAsset, frame, texel, range } = placementOf(
      towards,
      this.bounds,
      clipFromAsset,
      side,
    );
    this.uniforms.sunMap.value = target.depthTexture;
    this.uniforms.sunMapFromWorld.value.copy(mapFromAsset);
    this.uniforms.sunFrameFromWorld.value.copy(frame);
    this.uniforms.sunMapScales.value.set(side, side, texel, range);
    // The map itself is never reversed.
    const reversed = reversesDepth(renderer);
    const clipFromMap = new Matrix4()
      .makeTranslation(-1, -1, reversed ? 0 : -1)
      .scale(new Vector3(2 / side, 2 / side, reversed ? 1 : 2));
    this.material.uniforms.clipFromAsset.value.multiplyMatrices(clipFromMap, mapFromAsset);
    for (const material of [this.material, ...this.gaps]) {
      material.uniformsNeedUpdate = true;
      material.depthFunc = reversed ? GreaterDepth : LessDepth;
    }
    const { depth } = renderer.state.buffers;
    if (reversed) depth.setClear(0);
    renderInto(renderer, this.scene, this.camera, target, "depth");
    if (reversed) depth.setClear(1);
    this.done = state;
  }

  /** It is to be made again: the GPU has lost it. */
  forget(): void {
    this.target?.depthTexture?.dispose();
    this.target?.dispose();
    this.target = this.uniforms.sunMap.value = null;
    this.done = "";
  }

  dispose(): void {
    this.forget();
    for (const material of [this.material, ...this.gaps]) material.dispose();
  }
}

function depthTarget(side: number): WebGLRenderTarget {
  const depthTexture = new DepthTexture(side, side, FloatType);
  depthTexture.minFilter = depthTexture.magFilter = NearestFilter;
  return new WebGLRenderTarget(side, side, {
    format: RedFormat, // what three wants beside a depth; one byte a texel
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    generateMipmaps: false,
    depthTexture,
  });
}
