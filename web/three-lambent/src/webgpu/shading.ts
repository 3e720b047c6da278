// Functions of shaders/ as nodes: what is shaded with harmonics, receivers on texels, base colour,
// coverage. The texts there are the reference; pictures of both are held together by a test.
//
// Three's transpiler makes nodes of some of those texts (of shading_normal.glsl and
// texel_receivers.glsl, r187), and not of those that have arrays as results, functions that are
// defined after they are used, or macros that write code (sh.glsl, base_color.glsl, coverage.glsl,
// lobe.glsl, incident.glsl): so all are written by hand (2026-11).

import type { Texture } from "three";
import {
  clamp,
  float,
  fract,
  int,
  ivec2,
  ivec4,
  mix,
  normalize,
  select,
  textureLoad,
  textureSize,
  uint,
  vec2,
  vec3,
  vec4,
} from "three/tsl";
import type { Node } from "three/webgpu";

export type Float = Node<"float">;
export type Int = Node<"int">;
export type Vec2 = Node<"vec2">;
export type Vec3 = Node<"vec3">;
export type Vec4 = Node<"vec4">;
export type Bool = Node<"bool">;

/** shaders/sh.glsl, y[0 … bands² − 1] at a unit direction. */
export function harmonics(d: Vec3, bands: number): Float[] {
  const y: Float[] = [];
  let [c, s]: [Float, Float] = [float(1), float(0)];
  let sectoral = 0.28209479177388;
  for (let m = 0; m < bands; ++m) {
    let [before, legendre]: [Float, Float] = [float(0), float(sectoral)];
    for (let l = m; l < bands; ++l) {
      if (m === 0) y[l * (l + 1)] = legendre;
      else {
        y[l * (l + 1) + m] = legendre.mul(c).mul(Math.SQRT2).toVar();
        y[l * (l + 1) - m] = legendre.mul(s).mul(Math.SQRT2).toVar();
      }
      const next = (l + 1) ** 2 - m * m;
      const a = Math.sqrt((4 * (l + 1) ** 2 - 1) / next);
      const b = l === 0 ? 0 : Math.sqrt((l * l - m * m) / (4 * l * l - 1));
      const after: Float = d.z.mul(legendre).sub(before.mul(b)).mul(a).toVar();
      [before, legendre] = [legendre, after];
    }
    const turned = d.x.mul(c).sub(d.y.mul(s)).toVar();
    s = d.x.mul(s).add(d.y.mul(c)).toVar();
    c = turned;
    sectoral *= Math.sqrt((2 * m + 3) / (2 * m + 2));
  }
  return y;
}

/** shaders/shading_normal.glsl. */
export const shadingNormal = (interpolated: Vec3, front: Vec3): Vec3 => {
  const normal = select(
    interpolated.dot(interpolated).greaterThan(1e-30),
    normalize(interpolated),
    front,
  ).toVar() as Vec3;
  const side = normal.dot(front).toVar();
  return select(side.lessThan(0), normalize(normal.sub(front.mul(side.mul(2)))), normal) as Vec3;
};

/** shaders/shading_normal.glsl. */
export const reflectAbout = (outgoing: Vec3, normal: Vec3): Vec3 =>
  normal.mul(normal.dot(outgoing).mul(2)).sub(outgoing);

/**
 * shaders/incident.glsl and lobe.glsl: of groups of light RGBR GBRG BRGB …
 *
 * @param y harmonics at R
 * @param mu N·R
 */
export function lobeRadiance(
  { y, mu, gain }: { y: readonly Float[]; mu: Float; gain: Vec4 },
  incident: readonly Vec4[],
): Vec3 {
  const sums = [0, 1, 2].map(() => vec4(0).toVar());
  const factor = (number: number) => y[Math.min(Math.floor(number / 3), y.length - 1)];
  incident.forEach((group, i) => {
    const k = 4 * i;
    sums[i % 3].addAssign(vec4(factor(k), factor(k + 1), factor(k + 2), factor(k + 3)).mul(group));
  });
  const [a, b, c] = sums;
  const at = clamp(mu, 0, 1).toVar();
  const rise = at.mul(gain.w).add(gain.z).mul(at).add(gain.y).mul(at).add(gain.x);
  return vec3(
    a.x.add(a.w).add(b.z).add(c.y),
    a.y.add(b.x).add(b.w).add(c.z),
    a.z.add(b.y).add(c.x).add(c.w),
  ).mul(at.mul(rise).add(1));
}

/** shaders/texel_receivers.glsl. */
export function texelsAround(
  uv: Vec2,
  grid: Node<"ivec2">,
): { receivers: Int[]; weights: Float[] } {
  const size = vec2(grid);
  const at = clamp(uv.mul(size).sub(0.5), vec2(0), size.sub(1)).toVar();
  const a = ivec2(at).toVar();
  const last = grid.sub(1);
  const b = ivec2(
    select(a.x.lessThan(last.x), a.x.add(1), last.x),
    select(a.y.lessThan(last.y), a.y.add(1), last.y),
  ).toVar();
  const w = at.sub(vec2(a)).toVar();
  const [top, bottom] = [a.y.mul(grid.x), b.y.mul(grid.x)];
  const receiver = ivec4(top.add(a.x), top.add(b.x), bottom.add(a.x), bottom.add(b.x)).toVar();
  const rest = vec2(1).sub(w).toVar();
  const weight = vec4(
    rest.y.mul(rest.x),
    rest.y.mul(w.x),
    w.y.mul(rest.x),
    w.y.mul(w.x),
  ).toVar();
  return {
    receivers: [receiver.x, receiver.y, receiver.z, receiver.w],
    weights: [weight.x, weight.y, weight.z, weight.w],
  };
}

function wrapTexel(i: Int, size: Int, rule: Int): Int {
  const period = select(rule.equal(2), size.mul(2), size).toVar() as Int;
  const rest = i.sub(i.div(period).mul(period)).toVar(); // towards zero
  const k = select(rest.lessThan(0), rest.add(period), rest).toVar() as Int;
  const wrapped = select(k.lessThan(size), k, size.mul(2).sub(1).sub(k));
  const last = size.sub(1);
  const below = select(i.lessThan(last), i, last);
  const clamped = select(i.greaterThan(0), below, int(0));
  return select(rule.equal(1), clamped, wrapped).toVar() as Int;
}

/** shaders/base_color.glsl and coverage.glsl, of a texture: its colour, linear, and its alpha. */
export function sampleBaseColor(
  map: Texture,
  uv: Vec2,
  wrap: { u: Int; v: Int },
): Vec4 {
  const load = (x: Int, y: Int) => textureLoad(map, ivec2(x, y), int(0)) as unknown as Vec4;
  const whole = textureSize(textureLoad(map, ivec2(0), int(0)), int(0));
  const size = ivec2(whole as unknown as Node<"uvec2">).toVar();
  const at = clamp(uv, vec2(-1e6), vec2(1e6)).mul(vec2(size)).sub(0.5).toVar();
  const cell = at.floor().toVar();
  const w = at.sub(cell).toVar();
  const low = ivec2(cell).toVar();
  const x0 = wrapTexel(low.x, size.x, wrap.u);
  const x1 = wrapTexel(low.x.add(1), size.x, wrap.u);
  const y0 = wrapTexel(low.y, size.y, wrap.v);
  const y1 = wrapTexel(low.y.add(1), size.y, wrap.v);
  const upper = mix(load(x0, y0), load(x1, y0), w.x);
  const lower = mix(load(x0, y1), load(x1, y1), w.x);
  return mix(upper, lower, w.y).toVar() as Vec4;
}

/** veilNumber() of shaders/coverage.glsl: in [0, 1), of a pixel and a number. */
const veilNumber = (pixel: Node<"ivec2">, number: Int): Float => {
  const h = uint(pixel.x)
    .mul(uint(1664525))
    .add(uint(pixel.y).mul(uint(22695477)))
    .add(uint(number).mul(uint(747796405)))
    .toVar();
  h.assign(h.bitXor(h.shiftRight(uint(16))).mul(uint(2246822519)));
  h.assign(h.bitXor(h.shiftRight(uint(13))).mul(uint(3266489917)));
  h.assign(h.bitXor(h.shiftRight(uint(16))));
  return float(h.shiftRight(uint(8))).div(16777216);
};

/** What isThere() of shaders/coverage.glsl is told. */
export interface CoverageNodes {
  mode: number;
  /** The material's part of alpha, and the threshold of a mask. */
  rule: Vec2;
  kept: Float;
  veil: { number: Int; sample: Int };
}

/**
 * isThere() of shaders/coverage.glsl.
 *
 * @param alpha of the vertices times that of the texture
 * @param fragment its pixel
 * @param depth of it, in clip space: what lies behind each other must not be there in the same
 *   sub-samples
 */
export const isThere = (
  { mode, rule, kept, veil }: CoverageNodes,
  alpha: Float,
  fragment: Vec2,
  depth: Float,
): Bool => {
  const whole = alpha.mul(rule.x).toVar();
  const share = (mode === 2 ? kept.mul(whole) : kept).toVar();
  const layer = veil.number.mul(1024).add(int(depth.mul(512)));
  const number = veilNumber(ivec2(fragment), layer);
  const kind = veil.number.mod(int(3));
  const others = select(kind.equal(1), float(0.754877666), float(0.569840291));
  const turn = select(kind.equal(0), float(0.618033988), others);
  const seen = fract(number.add(float(veil.sample).mul(turn))).lessThan(share);
  const there = share.greaterThanEqual(1).or(seen);
  return (mode === 1 ? whole.greaterThanEqual(rule.y).and(there) : there) as Bool;
};
