// What rays find in a cube map that was drawn from somewhere else, against where they meet bodies.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";

/** Numbers in (0, 1), the same ones each time. */
function sequence(seed) {
  let state = seed;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
}

const along = (from, direction, t) => from.map((v, c) => v + t * direction[c]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Where a ray that starts in a box leaves it. */
const toWall = (half, from, direction) =>
  Math.min(...half.map((h, c) => (Math.sign(direction[c]) * h - from[c]) / direction[c]));

/** How far away a ray meets a ball; Infinity: it does not. */
function toBall({ center, radius }, from, direction) {
  const off = from.map((v, c) => v - center[c]);
  const b = dot(off, direction);
  const root = b * b - dot(off, off) + radius * radius;
  return root >= 0 && -b - Math.sqrt(root) > 0 ? -b - Math.sqrt(root) : Infinity;
}

/** Rays that start on a ball, outwards. */
function raysFrom({ center, radius }, count) {
  const next = sequence(7);
  const direction = () => {
    const z = 2 * next() - 1;
    const angle = 2 * Math.PI * next();
    const s = Math.sqrt(1 - z * z);
    return [s * Math.cos(angle), z, s * Math.sin(angle)];
  };
  return Array.from({ length: count }, () => {
    const normal = direction();
    const out = direction();
    if (dot(normal, out) < 0) out.forEach((v, c) => (out[c] = -v));
    return { from: along(center, normal, radius), direction: out };
  });
}

describe("a local capture", () => {
  let browser;
  before(async () => {
    const script = await bundle(readFileSync(new URL("page/captures.js", import.meta.url), "utf8"));
    browser = await openPage({ script });
    await browser.page.waitForFunction("window.ready");
  });
  after(() => browser?.close());

  /** What each ray sees: the place that its radiance tells, and how much of it. */
  async function look(state, rays) {
    const numbers = rays.flatMap(({ from, direction }) => [...from, ...direction]);
    const seen = await browser.page.evaluate((s) => window.look(s), { ...state, rays: numbers });
    assert.deepEqual(browser.problems(), []);
    return rays.map((_, i) => ({
      place: seen.slice(4 * i, 4 * i + 3).map((v) => v - 1.5),
      met: seen[4 * i + 3],
    }));
  }
  const apart = (a, b) => Math.hypot(...a.map((v, c) => v - b[c]));
  const room = [1, 0.8, 1.2];

  it("shows each side of a room where it is", async () => {
    const rays = [0, 1, 2]
      .flatMap((axis) =>
        [1, -1].map((sign) => [0.2, 0.3, 0.4].map((v, c) => (c === axis ? sign : v))),
      )
      .map((d) => ({ from: [0, 0, 0], direction: d.map((v) => v / Math.hypot(...d)) }));
    const seen = await look({ size: 64, from: [0, 0, 0], room }, rays);
    rays.forEach(({ from, direction }, i) => {
      const wall = along(from, direction, toWall(room, from, direction));
      assert.equal(seen[i].met, 1);
      assert.ok(apart(seen[i].place, wall) < 0.01, `${seen[i].place}, not ${wall}`);
    });
  });

  it("shows walls where rays from beside its place meet them, to a texel", async () => {
    const mirror = { center: [0.2, -0.1, 0.3], radius: 0.5 };
    const rays = raysFrom(mirror, 4000);
    for (const size of [64, 256]) {
      const seen = await look({ size, from: mirror.center, room }, rays);
      const off = rays.map(({ from, direction }, i) =>
        apart(seen[i].place, along(from, direction, toWall(room, from, direction))),
      );
      const rms = Math.sqrt(off.reduce((sum, v) => sum + v * v, 0) / off.length);
      console.log(
        `${size}: places off by ${rms.toFixed(4)}, ${Math.max(...off).toFixed(4)} at most`,
      );
      assert.ok(seen.every(({ met }) => met > 0.999));
      assert.ok(rms < 0.003 && Math.max(...off) < 4 / size, `${rms}, ${Math.max(...off)}`);
    }
  });

  it("shows bodies, and nothing between them", async () => {
    const balls = [
      { center: [1.2, 0, 0], radius: 0.4 },
      { center: [-0.5, 0.3, 1.2], radius: 0.5 },
      { center: [-0.8, -0.9, -0.9], radius: 0.6 },
    ];
    const rays = raysFrom({ center: [0, 0, 0], radius: 0.4 }, 8000);
    const seen = await look({ size: 256, from: [0, 0, 0], balls }, rays);
    let [hits, missed, added] = [0, 0, 0];
    rays.forEach(({ from, direction }, i) => {
      const { met, place } = seen[i];
      const t = Math.min(...balls.map((ball) => toBall(ball, from, direction)));
      if (t === Infinity) {
        added += met;
        return;
      }
      ++hits;
      missed += 1 - met;
      if (met === 1) assert.ok(apart(place, along(from, direction, t)) < 0.08, `${place}`);
    });
    console.log(`of ${hits} rays ${missed.toFixed(1)} missed, ${added.toFixed(1)} added`);
    assert.ok(hits > 700);
    // What its place does not see of a body is not there: a rim.
    assert.ok(missed < 0.08 * hits && added < 0.01 * hits, `${missed}, ${added} of ${hits}`);
  });
});
