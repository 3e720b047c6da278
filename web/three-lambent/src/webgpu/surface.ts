// Exit radiance of a relit surface by nodes: src/glsl/surface.vert.glsl, surface.frag.glsl,
// shading_point.glsl and incident_texture.glsl. They write linear radiance; fog, tone mapping and
// colour space follow, as for three's own materials.

import {
  Matrix4,
  Vector2,
  Vector3,
  Vector4,
  type Camera,
  type IUniform,
  type Texture,
} from "three";
import {
  attribute,
  cameraProjectionMatrix,
  cross,
  dFdx,
  dFdy,
  Discard,
  Fn,
  frontFacing,
  If,
  int,
  ivec2,
  modelViewMatrix,
  normalGeometry,
  normalize,
  positionGeometry,
  screenCoordinate,
  select,
  textureLoad,
  uniform,
  varying,
  vec2,
  vec3,
  vec4,
  vertexIndex,
} from "three/tsl";
import type { Node, NodeFrame } from "three/webgpu";
import { incidentGroups } from "../materials/group-macros.js";
import type { RelitMaterial, RelitNodes } from "../materials/relit-material.js";
import type { SurfaceShape } from "../materials/relit-shaders.js";
import { mapUniforms } from "../materials/coverage.js";
import {
  harmonics,
  isThere,
  lobeRadiance,
  reflectAbout,
  sampleBaseColor,
  shadingNormal,
  texelsAround,
  type Float,
  type Int,
  type Vec2,
  type Vec3,
  type Vec4,
} from "./shading.js";

type Uniforms = Record<string, IUniform>;

const objectFromView = new Matrix4();

/** Position, 1; or, for an orthographic camera, direction to the viewer, 0: in the object's frame. */
function eyeOfObject(camera: Camera, worldFromObject: Matrix4, out: Vector4): Vector4 {
  objectFromView.multiplyMatrices(camera.matrixWorldInverse, worldFromObject).invert();
  const e = objectFromView.elements;
  const orthographic = camera.projectionMatrix.elements[15] === 1;
  if (!orthographic) return out.set(e[12], e[13], e[14], 1);
  const length = Math.hypot(e[8], e[9], e[10]);
  return out.set(e[8] / length, e[9] / length, e[10] / length, 0);
}

const eyeNode = () =>
  uniform(new Vector4()).onObjectUpdate((frame: NodeFrame, self) => {
    const { camera, object } = frame;
    if (camera && object) eyeOfObject(camera, object.matrixWorld, self.value as Vector4);
    return undefined;
  }) as unknown as Vec4;

/** 1. Whoever draws with it is advised as before a WebGLRenderer draws. */
const advised = () =>
  uniform(1).onObjectUpdate(({ scene, object, material }: NodeFrame) => {
    if (scene && object) (material as RelitMaterial | null)?.drawn?.(scene, object);
    return undefined;
  }) as unknown as Float;

/** A receiver's results: four numbers each, so many texels one after the other. */
function results(texture: Texture, aLine: number, texels: number) {
  const inLine = uniform(aLine, "int");
  return (receiver: Int) => {
    const line = receiver.div(inLine).toVar();
    const first = receiver.sub(line.mul(inLine)).mul(texels).toVar();
    return (group: number) =>
      textureLoad(texture, ivec2(first.add(group), line), int(0)) as unknown as Vec4;
  };
}

/** Weighed sum of what receivers have. */
const weighed = (values: readonly Vec4[], weights: readonly Float[]): Vec4 =>
  values.map((value, k) => value.mul(weights[k])).reduce((sum, value) => sum.add(value));

interface Mirrored {
  view: Vec3;
  mu: Float;
}

/** A surface without meso-structure, which is no mirror: surfaceShaders. */
export function surfaceNodes(shape: SurfaceShape, uniforms: Uniforms): RelitNodes {
  const { kind } = shape;
  const vertices = kind === "vertices";
  const lit = vertices || kind === "texels";
  const coefficients = lit ? (shape.lobeBands ?? 0) ** 2 : 0;
  const glossy = coefficients > 0;
  const diffuse = lit && shape.diffuse;
  const map = shape.uv ? shape.map : null;
  const uv = (shape.uv ? attribute("uv", "vec2") : vec2(0)) as Vec2;

  // Where a receiver's results are: of vertices at their corners, of texels around a place.
  const corners = attribute("lambentCorners", "uvec3") as Node<"uvec3">;
  const index = int(vertexIndex);
  const corner = index.sub(index.div(3).mul(3));
  const isCorner = (k: number) => select(corner.equal(k), 1, 0) as unknown as Float;
  const barycentric = varying(vec3(isCorner(0), isCorner(1), isCorner(2))) as unknown as Vec3;
  const [first, second, third] = [corners.x, corners.y, corners.z].map((k) => int(k));
  const later = select(corner.equal(1), second, third);
  const receiver = shape.fetch ? (select(corner.equal(0), first, later) as Int) : index;

  const diffuseOf = diffuse && results(uniforms.diffuseLit.value, uniforms.diffuseALine.value, 1);
  const interpolated =
    diffuseOf && vertices ? (varying(diffuseOf(receiver)(0).xyz) as unknown as Vec3) : null;
  const groups = incidentGroups(coefficients);
  const incidentOf =
    glossy && results(uniforms.incidentLit.value, uniforms.incidentALine.value, groups);

  const grid = () => {
    const [width, height] = uniforms.grid.value as Int32Array;
    return ivec2(uniform(width, "int"), uniform(height, "int"));
  };
  const texelUv = (shape.texelUv ? attribute("uv1", "vec2") : uv) as Vec2;
  const factor = uniform((uniforms.reflectance?.value ?? new Vector3(1, 1, 1)) as Vector3);
  const reflectance = factor as unknown as Vec3;
  const one = advised();
  const eye = eyeNode();

  const baseOf = (sampled: Vec4 | null): Vec3 => {
    const tint = shape.colored ? (attribute("color", "vec3") as unknown as Vec3) : vec3(1);
    return sampled ? tint.mul(sampled.xyz) : tint;
  };

  const sampledMap = (): Vec4 | null => {
    if (!map) return null;
    const [u, v] = mapUniforms(map).baseColorWrap.value as Int32Array;
    return sampleBaseColor(map, uv, { u: uniform(u, "int"), v: uniform(v, "int") });
  };

  const kept = uniforms.kept && uniform(uniforms.kept.value as number);
  const cutOut = (sampled: Vec4 | null): void => {
    const veil = uniforms.veil as IUniform<Int32Array>;
    const own = shape.colored ? (attribute("color", "vec4") as unknown as Vec4).w : null;
    const [projection, inView] = [cameraProjectionMatrix, modelViewMatrix] as unknown[];
    const clip = (projection as Node<"mat4">)
      .mul(inView as Node<"mat4">)
      .mul(vec4(positionGeometry as unknown as Vec3, 1)) as unknown as Vec4;
    const rule = uniforms.alphaRule.value as Vector2;
    const coverage = {
      mode: uniforms.alphaMode.value as number,
      rule: uniform(rule) as unknown as Vec2,
      kept: kept as unknown as Float,
      veil: {
        number: uniform(veil.value[0], "int"),
        sample: uniform(0, "int").onRenderUpdate(() => veil.value[1]) as unknown as Int,
      },
    };
    const alpha = [own, sampled?.w].filter((a): a is Float => a != null);
    const all = alpha.reduce((product, a) => product.mul(a), vec4(1).x as Float);
    const depth = clip.z.div(clip.w);
    Discard(isThere(coverage, all, screenCoordinate as unknown as Vec2, depth).not());
  };

  /** R, the view mirrored about the normal, unit; and N·R. All of a quad comes here: derivatives. */
  const mirroredView = (): Mirrored => {
    const toViewer = select(
      eye.w.greaterThan(0),
      normalize(eye.xyz.sub(positionGeometry)),
      eye.xyz,
    ).toVar() as Vec3;
    const across = cross(dFdx(positionGeometry), dFdy(positionGeometry)).toVar();
    const size = across.length().toVar();
    const own = select(size.greaterThan(0), across.div(size), toViewer).toVar() as Vec3;
    const front = select(own.dot(toViewer).lessThan(0), own.negate(), own).toVar() as Vec3;
    const normal = shadingNormal(normalGeometry as unknown as Vec3, front).toVar();
    const view = reflectAbout(toViewer, normal).toVar();
    return { view, mu: view.dot(normal).toVar() };
  };

  const radianceOf = (base: Vec3, reflected: Mirrored | null): Vec3 => {
    if (kind === "unlit") return base.mul(reflectance);
    const texels = kind === "texels" ? texelsAround(texelUv, grid()) : null;
    let sum: Vec3 = vec3(0);
    if (diffuseOf) {
      const direct = texels
        ? weighed(texels.receivers.map((at) => diffuseOf(at)(0)), texels.weights).xyz
        : interpolated!;
      sum = shape.albedoOutside ? direct.mul(base) : direct;
    }
    if (incidentOf && reflected) {
      const at = texels?.receivers ?? [first, second, third];
      const weights = texels?.weights ?? [barycentric.x, barycentric.y, barycentric.z];
      const places = at.map((each) => incidentOf(each));
      const incident = Array.from({ length: groups }, (_, g) =>
        weighed(places.map((read) => read(g)), weights),
      );
      const y = harmonics(reflected.view, shape.lobeBands!);
      const gain = uniform(uniforms.lobeGain.value as Vector4) as unknown as Vec4;
      sum = sum.add(base.mul(lobeRadiance({ y, mu: reflected.mu, gain }, incident)));
    }
    return sum;
  };

  const fragmentNode = Fn(() => {
    const reflected = glossy ? mirroredView() : null;
    const sampled = map ? sampledMap() : null;
    if (shape.gaps) cutOut(sampled);
    const sent = vec3(0).toVar();
    if (kind !== "black")
      If(frontFacing, () => {
        sent.assign(radianceOf(baseOf(sampled), reflected));
      });
    const there = shape.gaps && kind !== "unlit" ? sent.div(kept!.max(1e-4)) : sent;
    return vec4(kind === "unlit" ? there : there.mul(one), 1);
  })();
  return { fragmentNode, uniforms };
}
