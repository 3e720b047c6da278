// How a patch lies on a surface, as the asset alone tells it: lambent/synthesis/patch_lay.h, which
// says what it is, and cross_field.cpp, line for line; a test holds both to the same singularities.
import { Vector3, type BufferAttribute, type BufferGeometry } from "three";

export interface Line {
  from: Vector3;
  to: Vector3;
  normal: Vector3;
}
export interface Singularity {
  position: Vector3;
  normal: Vector3;
  /** In parts of `turns`. */
  index: number;
}
export interface PatchLay {
  turns: 1 | 2 | 4;
  field: Line[];
  singularities: Singularity[];
  cuts: Line[];
}

const kNone = -1;
const kStrokeLength = 0.7;
const [kCandidates, kKept] = [6, 0.6];
const [kTurnedShare, kTurnWidth] = [0.05, Math.PI / 12];

/** A triangle mesh as arrays of vectors; `corners`: three vertices for each triangle. */
interface Surface {
  corners: Uint32Array;
  positions: Vector3[];
  normals: Vector3[];
  tangents: Vector3[];
  uv: BufferAttribute;
}

/** null: without meso-structure, or before three-lambent lit it, which is when it has tangents. */
export function surfaceOf(geometry: BufferGeometry): Surface | null {
  if (!geometry.hasAttribute("lambentTangent") || !geometry.hasAttribute("uv")) return null;
  const vectors = (name: string) => {
    const from = geometry.getAttribute(name) as BufferAttribute;
    return Array.from({ length: from.count }, (_, i) => new Vector3().fromBufferAttribute(from, i));
  };
  const { index } = geometry;
  const positions = vectors("position");
  const count = index?.count ?? positions.length;
  return {
    corners: Uint32Array.from({ length: count }, (_, i) => index?.getX(i) ?? i),
    positions,
    normals: vectors("normal"),
    tangents: vectors("lambentTangent"),
    uv: geometry.getAttribute("uv") as BufferAttribute,
  };
}

const crossOf = ({ corners, positions }: Surface, t: number) => {
  const at = (k: number) => positions[corners[3 * t + k]];
  return at(1).clone().sub(at(0)).cross(at(2).clone().sub(at(0)));
};

export function areaOf(surface: Surface): number {
  let area = 0;
  for (let t = 0; t < surface.corners.length / 3; ++t) area += crossOf(surface, t).length() / 2;
  return area;
}
export const strokeSpacing = (area: number, strokes: number) => Math.sqrt((kKept * area) / strokes);

const nextOf = (h: number) => (h % 3 === 2 ? h - 2 : h + 1);
const previousOf = (h: number) => (h % 3 === 0 ? h + 2 : h - 1);

class Sets {
  private readonly parents: Uint32Array;
  constructor(count: number) {
    this.parents = Uint32Array.from({ length: count }, (_, i) => i);
  }
  rootOf(i: number): number {
    const { parents } = this;
    while (parents[i] !== i) i = parents[i] = parents[parents[i]];
    return i;
  }
  join(a: number, b: number): void {
    [a, b] = [this.rootOf(a), this.rootOf(b)];
    this.parents[Math.max(a, b)] = Math.min(a, b);
  }
}

interface Manifold {
  /** Of half-edge 3t + k, which runs from corner k to the next: the one the other way, or kNone. */
  twin: Int32Array;
  /** Corners of one fan have one number. */
  fanOf(corner: number): number;
  componentOf(triangle: number): number;
}

/** Triangles hang together over edges that exactly two share, with equal sense. */
function manifoldOf({ corners, positions }: Surface): Manifold {
  const numbers = new Map<string, number>();
  const place = positions.map(({ x, y, z }) => {
    const key = `${x + 0} ${y + 0} ${z + 0}`;
    if (!numbers.has(key)) numbers.set(key, numbers.size);
    return numbers.get(key)!;
  });
  const at = (h: number) => place[corners[h]];
  const count = corners.length;
  const edges = new Map<number, number[]>();
  for (let h = 0; h < count; ++h) {
    const t = h - (h % 3);
    if (at(t) === at(t + 1) || at(t + 1) === at(t + 2) || at(t + 2) === at(t)) continue;
    const [a, b] = [at(h), at(nextOf(h))];
    const key = Math.min(a, b) * numbers.size + Math.max(a, b);
    const sharing = edges.get(key);
    if (sharing) sharing.push(h);
    else edges.set(key, [h]);
  }
  const twin = new Int32Array(count).fill(kNone);
  const [fans, components] = [new Sets(count), new Sets(count / 3)];
  for (const [g, h, more] of edges.values()) {
    if (h === undefined || more !== undefined || at(g!) === at(h)) continue;
    [twin[g!], twin[h]] = [h, g!];
    fans.join(g!, nextOf(h));
    fans.join(h, nextOf(g!));
    components.join(Math.floor(g! / 3), Math.floor(h / 3));
  }
  return { twin, fanOf: (c) => fans.rootOf(c), componentOf: (t) => components.rootOf(t) };
}

/** As synthesis::turnedInto. */
function turnedInto(tangent: Vector3, from: Vector3, to: Vector3): Vector3 {
  const cosine = from.dot(to);
  const turned = tangent.clone();
  if (cosine > -0.9999)
    turned.addScaledVector(from.clone().add(to), -tangent.dot(to) / (1 + cosine));
  return turned.addScaledVector(to, -turned.dot(to)).normalize();
}

function visitCuts(
  { corners, uv }: Surface,
  { twin }: Manifold,
  visit: (h: number, twin: number) => void,
): void {
  const apart = (g: number, h: number) => {
    const [a, b] = [corners[g], corners[h]];
    return uv.getX(a) !== uv.getX(b) || uv.getY(a) !== uv.getY(b);
  };
  twin.forEach((other, h) => {
    if (other < h) return;
    if (apart(h, nextOf(other)) || apart(nextOf(h), other)) visit(h, other);
  });
}

function turnsOf(surface: Surface, manifold: Manifold): 1 | 2 | 4 {
  const { corners, normals, tangents } = surface;
  const turned = [0, 0, 0, 0];
  let all = 0;
  visitCuts(surface, manifold, (h, twin) => {
    const [a, b] = [corners[h], corners[nextOf(twin)]];
    const n = normals[a];
    const other = turnedInto(tangents[b], normals[b], n);
    const sine = n.dot(tangents[a].clone().cross(other));
    const angle = Math.atan2(sine, tangents[a].dot(other));
    const quarters = Math.round(angle / (Math.PI / 2));
    if (Math.abs(angle - (quarters * Math.PI) / 2) < kTurnWidth) ++turned[quarters & 3];
    ++all;
  });
  if (turned[1] + turned[3] > kTurnedShare * all) return 4;
  return turned[2] > kTurnedShare * all ? 2 : 1;
}

const turnBetween = (angle: number) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

function singularitiesOf(surface: Surface, manifold: Manifold, turns: number): Singularity[] {
  const { corners, positions, normals, tangents } = surface;
  const { twin, fanOf, componentOf } = manifold;
  const count = corners.length / 3;
  const crosses = Array.from({ length: count }, (_, t) => crossOf(surface, t));
  // −1 for components whose normals look to the other side than their winding says.
  const agreement = new Float64Array(count);
  crosses.forEach((cross, t) => {
    for (let k = 0; k < 3; ++k)
      agreement[componentOf(t)] += cross.dot(normals[corners[3 * t + k]]);
  });
  const senseOf = (t: number) => (agreement[componentOf(t)] < 0 ? -1 : 1);

  // In the plane of each triangle, all as angles: its edges, and one direction of the field.
  const edge = new Float64Array(3 * count);
  const direction = new Float64Array(count);
  crosses.forEach((cross, t) => {
    const p = [0, 1, 2].map((k) => positions[corners[3 * t + k]]);
    const edges = p.map((each, k) => p[(k + 1) % 3].clone().sub(each));
    const lengths = edges.map((each) => each.length());
    const x = edges[lengths.indexOf(Math.max(...lengths))].clone().normalize();
    const normal = cross.clone();
    normal.addScaledVector(x, -normal.dot(x)).normalize().multiplyScalar(senseOf(t));
    const y = normal.clone().cross(x);
    edges.forEach((each, k) => (edge[3 * t + k] = Math.atan2(each.dot(y), each.dot(x))));
    let [re, im, first] = [0, 0, 0];
    for (let k = 0; k < 3; ++k) {
      const v = corners[3 * t + k];
      const tangent = turnedInto(tangents[v], normals[v], normal);
      const angle = turns * Math.atan2(tangent.dot(y), tangent.dot(x));
      [re, im] = [re + Math.cos(angle), im + Math.sin(angle)];
      if (k === 0) first = angle;
    }
    direction[t] = (Math.hypot(re, im) < 1e-3 ? first : Math.atan2(im, re)) / turns;
  });

  const part = (2 * Math.PI) / turns;
  const turned = new Float64Array(3 * count); // of the field over a half-edge
  twin.forEach((other, h) => {
    if (other < h) return;
    const [s, t] = [Math.floor(h / 3), Math.floor(other / 3)];
    const seen = direction[s] + edge[other] + Math.PI - edge[h] - direction[t];
    turned[h] = -(seen - part * Math.round(seen / part));
    turned[other] = -turned[h];
  });

  type Sum = { corner: number; angles: number; turned: number; open: boolean };
  const around = new Map<number, Sum>();
  for (let c = 0; c < 3 * count; ++c) {
    const fan = fanOf(c);
    const sum = around.get(fan) ?? { corner: c, angles: 0, turned: 0, open: false };
    around.set(fan, sum);
    const before = previousOf(c);
    sum.angles += Math.abs(turnBetween(edge[before] + Math.PI - edge[c]));
    sum.turned += turned[before];
    sum.open ||= twin[c] === kNone || twin[before] === kNone;
  }
  const found: Singularity[] = [];
  for (const { corner, angles, turned: sum, open } of around.values()) {
    if (open) continue;
    const sense = senseOf(Math.floor(corner / 3));
    const index = Math.round(((2 * Math.PI - angles + sense * sum) / (2 * Math.PI)) * turns);
    const v = corners[corner];
    if (index !== 0) found.push({ position: positions[v], normal: normals[v], index });
  }
  return found;
}

const kPlastic = 1.324717957244746;
/** As math::r2. */
function r2(index: number): [number, number] {
  const [x, y] = [0.5 + index / kPlastic, 0.5 + index / (kPlastic * kPlastic)];
  return [x - Math.floor(x), y - Math.floor(y)];
}

function strokesOf(surface: Surface, spacing: number): Line[] {
  const { corners, positions, normals, tangents } = surface;
  const strokes: Line[] = [];
  const kept = new Map<string, Vector3[]>(); // by cells as wide as the spacing
  const cellOf = (p: Vector3) => p.toArray().map((each) => Math.floor(each / spacing));
  const isFree = (p: Vector3) => {
    const [x, y, z] = cellOf(p) as [number, number, number];
    for (let i = 0; i < 27; ++i) {
      const cell = [x + (i % 3) - 1, y + (Math.floor(i / 3) % 3) - 1, z + Math.floor(i / 9) - 1];
      for (const other of kept.get(cell.join()) ?? [])
        if (other.distanceToSquared(p) < spacing * spacing) return false;
    }
    return true;
  };
  const step = (spacing * spacing) / kCandidates;
  let [area, index] = [0, 0];
  for (let t = 0; t < corners.length / 3; ++t) {
    const vertices = [0, 1, 2].map((k) => corners[3 * t + k]);
    const mean = (of: Vector3[], weights: number[]) =>
      vertices.reduce((sum, v, k) => sum.addScaledVector(of[v], weights[k]), new Vector3());
    const face = crossOf(surface, t);
    area += face.length() / 2;
    face.normalize();
    for (; (index + 0.5) * step < area; ++index) {
      let [u, v] = r2(index);
      if (u + v > 1) [u, v] = [1 - u, 1 - v];
      const weights = [1 - u - v, u, v];
      const place = mean(positions, weights);
      if (!isFree(place)) continue;
      const along = mean(tangents, weights);
      along.addScaledVector(face, -along.dot(face));
      if (!(along.length() > 1e-3)) continue;
      const cell = cellOf(place).join();
      const beside = kept.get(cell);
      if (beside) beside.push(place);
      else kept.set(cell, [place]);
      along.setLength((kStrokeLength * spacing) / 2);
      const normal = mean(normals, weights).normalize();
      strokes.push({ from: place.clone().sub(along), to: place.clone().add(along), normal });
    }
  }
  return strokes;
}

export function patchLay(surface: Surface, spacing: number): PatchLay {
  const manifold = manifoldOf(surface);
  const turns = turnsOf(surface, manifold);
  const cuts: Line[] = [];
  visitCuts(surface, manifold, (h) => {
    const [a, b] = [surface.corners[h], surface.corners[nextOf(h)]];
    const normal = surface.normals[a].clone().add(surface.normals[b]).normalize();
    cuts.push({ from: surface.positions[a], to: surface.positions[b], normal });
  });
  const singularities = singularitiesOf(surface, manifold, turns);
  return { turns, field: strokesOf(surface, spacing), singularities, cuts };
}
