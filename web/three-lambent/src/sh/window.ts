// This work is based on:
// - sloan2002precomputed, sloan2008stupid: "Windowing", the Hann and Lanczos windows, and
//   attenuation by the squared Laplacian, w_l = 1/(1 + λ l²(l+1)²).
// - hettich1993semi: the exchange method: solve on a grid, add the true minima, solve again.
//
// As lambent/sh/window.cpp. One evaluation of the condition costs one multiplication per point and
// band, since each band's share of f at a point is kept.

import { evaluateHarmonics } from "./basis.js";
import { legendre, sharpestNonNegative } from "./zonal.js";

/** (1+cos(πl/w))/2 for every band, 0 for l ≥ w. */
export function hannWindow(bands: number, width: number): Float64Array {
  const window = new Float64Array(bands);
  for (let l = 0; l < bands && l < width; ++l)
    window[l] = (1 + Math.cos((Math.PI * l) / width)) / 2;
  return window;
}

/** sin(πl/w)/(πl/w) for every band, 0 for l ≥ w. */
export function lanczosWindow(bands: number, width: number): Float64Array {
  const window = new Float64Array(bands);
  for (let l = 0; l < bands && l < width; ++l) {
    const x = (Math.PI * l) / width;
    window[l] = l === 0 ? 1 : Math.sin(x) / x;
  }
  return window;
}

function laplacianWindow(bands: number, lambda: number): Float64Array {
  return Float64Array.from({ length: bands }, (_, l) => 1 / (1 + lambda * (l * (l + 1)) ** 2));
}

type Direction = [number, number, number];

/** One channel: where it is sampled, and each band's share of it there. */
class Channel {
  readonly points: Direction[] = [];
  readonly values: Float64Array[] = [];
  private readonly y: Float64Array;

  constructor(
    readonly f: Float64Array,
    readonly bands: number,
  ) {
    this.y = new Float64Array(bands * bands);
  }

  at(s: Direction): Float64Array {
    evaluateHarmonics(this.bands, s[0], s[1], s[2], this.y);
    const shares = new Float64Array(this.bands);
    for (let l = 0; l < this.bands; ++l)
      for (let i = l * l; i < (l + 1) * (l + 1); ++i) shares[l] += this.f[i] * this.y[i];
    return shares;
  }

  add(s: Direction): void {
    this.points.push(s);
    this.values.push(this.at(s));
  }
}

function weigh(window: Float64Array, shares: Float64Array): number {
  let sum = 0;
  for (let l = 0; l < window.length; ++l) sum += window[l] * shares[l];
  return sum;
}

function fibonacci(count: number): Direction[] {
  const turn = Math.PI * (3 - Math.sqrt(5));
  return Array.from({ length: count }, (_, i) => {
    const z = 1 - (2 * i + 1) / count;
    const r = Math.sqrt(Math.max(0, 1 - z * z));
    return [r * Math.cos(turn * i), r * Math.sin(turn * i), z];
  });
}

function unit(v: Direction): Direction {
  const length = Math.hypot(...v);
  return [v[0] / length, v[1] / length, v[2] / length];
}

function frameOf(n: Direction): [Direction, Direction] {
  const sign = n[2] < 0 ? -1 : 1;
  const a = -1 / (sign + n[2]);
  const b = n[0] * n[1] * a;
  return [
    [1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]],
    [b, sign + n[1] * n[1] * a, -n[1]],
  ];
}

/** Newton steps on a quadratic fitted to a stencil in the tangent plane, held to go down. */
function descend(
  channel: Channel,
  window: Float64Array,
  start: Direction,
  reach: number,
): { direction: Direction; value: number } {
  let s = start;
  let radius = reach;
  let value = weigh(window, channel.at(s));
  while (radius > 1e-7) {
    const [x, y] = frameOf(s);
    const near = (u: number, v: number): Direction =>
      unit([s[0] + u * x[0] + v * y[0], s[1] + u * x[1] + v * y[1], s[2] + u * x[2] + v * y[2]]);
    const probe = (u: number, v: number) => weigh(window, channel.at(near(u, v)));
    const h = Math.max(radius / 4, 1e-4);
    const [east, west, up, down] = [probe(h, 0), probe(-h, 0), probe(0, h), probe(0, -h)];
    const gu = (east - west) / (2 * h);
    const gv = (up - down) / (2 * h);
    const huu = (east - 2 * value + west) / (h * h);
    const hvv = (up - 2 * value + down) / (h * h);
    const huv = (probe(h, h) - probe(h, -h) - probe(-h, h) + probe(-h, -h)) / (4 * h * h);
    const determinant = huu * hvv - huv * huv;
    const bowl = huu > 0 && determinant > 1e-12 * (huu * huu + hvv * hvv);
    const u = bowl ? (huv * gv - hvv * gu) / determinant : -gu;
    const v = bowl ? (huv * gu - huu * gv) / determinant : -gv;
    const length = Math.hypot(u, v);
    if (length === 0) break;
    const cut = bowl ? Math.min(1, radius / length) : radius / length;
    const next = near(cut * u, cut * v);
    const nextValue = weigh(window, channel.at(next));
    if (nextValue < value) {
      s = next;
      value = nextValue;
      if (bowl) radius = Math.min(radius, 2 * length * cut);
    } else {
      radius /= 4;
    }
  }
  return { direction: s, value };
}

const kMaxLambda = 1e12; // by then the window is 1, 0, 0, …

function leastLambda(channels: Channel[], bands: number): number {
  const holds = (lambda: number) => {
    const window = laplacianWindow(bands, lambda);
    return channels.every((channel) => channel.values.every((v) => weigh(window, v) >= 0));
  };
  if (holds(0)) return 0;
  let bad = 0;
  let good = 1e-7;
  while (!holds(good)) {
    bad = good;
    good *= 1.7;
    if (good > kMaxLambda) return kMaxLambda;
  }
  for (let i = 0; i < 60 && good - bad > 1e-12 * good; ++i) {
    const middle = (bad + good) / 2;
    if (holds(middle)) good = middle;
    else bad = middle;
  }
  return good;
}

function minimaOf(channel: Channel, window: Float64Array, peak: number) {
  const spacing = 0.7 / channel.bands;
  const low = channel.points
    .map((point, i) => ({ point, value: weigh(window, channel.values[i]) }))
    .filter(({ value }) => value < 0.2 * peak) // what is higher hides no negative valley
    .sort((a, b) => a.value - b.value);
  const starts: Direction[] = [];
  for (const { point } of low) {
    const near = (q: Direction) =>
      Math.hypot(point[0] - q[0], point[1] - q[1], point[2] - q[2]) < spacing;
    if (!starts.some(near)) starts.push(point);
    if (starts.length === 24) break;
  }
  return starts.map((start) => descend(channel, window, start, spacing / 2));
}

/**
 * The least attenuation of the family 1/(1+λ l²(l+1)²) that leaves the radiance of every channel
 * non-negative in every direction; all ones if it is so already. Some milliseconds: for when a
 * light is made, not for every frame.
 *
 * @param coefficients bands² × 3 numbers: [coefficient][channel]
 */
export function minimalRingingWindow(coefficients: ArrayLike<number>, bands: number): Float64Array {
  const meanOnly = new Float64Array(bands);
  meanOnly[0] = 1;
  const channels: Channel[] = [];
  let peak = 0;
  for (let c = 0; c < 3; ++c) {
    const f = Float64Array.from({ length: bands * bands }, (_, i) => coefficients[3 * i + c]);
    if (f.every((v) => v === 0)) continue;
    if (!(f[0] > 0)) return meanOnly;
    const channel = new Channel(f, bands);
    for (const s of fibonacci(48 * bands * bands)) channel.add(s);
    channels.push(channel);
    const all = laplacianWindow(bands, 0);
    for (const v of channel.values) peak = Math.max(peak, Math.abs(weigh(all, v)));
  }
  if (channels.length === 0) return laplacianWindow(bands, 0);
  let lambda = 0;
  for (let round = 0; round < 30; ++round) {
    lambda = leastLambda(channels, bands);
    if (lambda >= kMaxLambda) return meanOnly;
    const window = laplacianWindow(bands, lambda);
    let holds = true;
    for (const channel of channels) {
      const tolerance = (1e-7 * channel.f[0]) / Math.sqrt(4 * Math.PI);
      for (const minimum of minimaOf(channel, window, peak)) {
        if (minimum.value < -tolerance) holds = false;
        if (minimum.value < 0) channel.add(minimum.direction);
      }
    }
    if (holds) break;
  }
  return laplacianWindow(bands, lambda);
}

/** By bands: the basis at the directions that are looked at. */
const pointsOf = new Map<number, Float64Array[]>();

/** The least s that leaves (1−s) · plain + s · soft non-negative at all points that it sees. */
class LeastShare {
  private share = 0;

  see(plain: number, soft: number): void {
    if (plain < 0) this.share = soft <= 0 ? 1 : Math.max(this.share, plain / (plain - soft));
  }
  window(soft: Float64Array): Float64Array {
    return soft.map((moment) => 1 - this.share + this.share * moment);
  }
}

/**
 * The least of the family (1−s) + s ĥ_l, 0 ≤ s ≤ 1, with the ĥ_l of {@link sharpestNonNegative}, that
 * leaves the radiance of every channel non-negative, but for dips below .5% of the peak between the
 * directions that are looked at. It keeps more of small lights than {@link minimalRingingWindow}.
 *
 * @param coefficients bands² × 3 numbers: [coefficient][channel]
 */
export function leastSofteningWindow(coefficients: ArrayLike<number>, bands: number): Float64Array {
  const soft = sharpestNonNegative(bands);
  let points = pointsOf.get(bands);
  if (!points) {
    points = fibonacci(100 * bands * bands).map(
      ([x, y, z]) => evaluateHarmonics(bands, x, y, z) as Float64Array,
    );
    pointsOf.set(bands, points);
  }
  const least = new LeastShare();
  for (const y of points)
    for (let c = 0; c < 3; ++c) {
      let [plain, softened] = [0, 0];
      for (let l = 0, i = 0; l < bands; ++l) {
        let share = 0;
        for (; i < (l + 1) * (l + 1); ++i) share += coefficients[3 * i + c] * y[i];
        plain += share;
        softened += soft[l] * share;
      }
      least.see(plain, softened);
    }
  return least.window(soft);
}

/** The same for a zonal function's moments, such as a lobe's. */
export function leastSofteningOfZonal(moments: Float64Array): Float64Array {
  const bands = moments.length;
  const soft = sharpestNonNegative(bands);
  const least = new LeastShare();
  const angles = 100 * bands;
  for (let i = 0; i <= angles; ++i) {
    const p = legendre(bands, Math.cos((Math.PI * i) / angles));
    let [plain, softened] = [0, 0];
    p.forEach((each, l) => {
      const share = (2 * l + 1) * moments[l] * each;
      plain += share;
      softened += soft[l] * share;
    });
    least.see(plain, softened);
  }
  return least.window(soft);
}
