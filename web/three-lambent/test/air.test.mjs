// Aerial perspective beside that of the library: data/airs.json is made with data/air.bin, by
// lambent_sky_data.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { LambentAir, LambentSky } from "three-lambent";

const bytesOf = (name) => {
  const file = readFileSync(new URL(name, import.meta.url));
  return file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
};
const skies = new LambentSky(bytesOf("../data/sky.bin"));
const airs = new LambentAir(bytesOf("../data/air.bin"));
const fixture = JSON.parse(readFileSync(new URL("data/airs.json", import.meta.url), "utf8"));
const kDegree = Math.PI / 180;
const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** The Sun's frame (+x towards it) is the world's with the Sun at a bearing of 90°. */
const skyAt = (turbidity, sunElevation) =>
  skies.at({ turbidity, sunElevation: sunElevation * kDegree, sunAzimuth: Math.PI / 2 });

/** Of f, absolute; of L_in, a channel's error over the luminance. */
function errorsOf({ turbidity, sunElevation, extinction, inScattered }) {
  const air = airs.under(skyAt(turbidity, sunElevation));
  const all = { extinction: [], inScattered: [] };
  let i = 0;
  for (const [x, y, z] of fixture.directions)
    for (const metres of fixture.distances) {
      const between = air.between({ x, y, z }, metres);
      for (let c = 0; c < 3; ++c) {
        all.extinction.push(between.extinction[c] - extinction[i][c]);
        all.inScattered.push(
          (between.inScattered[c] - inScattered[i][c]) / luminance(inScattered[i]),
        );
      }
      ++i;
    }
  air.dispose();
  return all;
}
const rms = (values) => Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / values.length);
const most = (values) => values.reduce((found, v) => Math.max(found, Math.abs(v)), 0);

describe("aerial perspective", () => {
  it("is data that, with the skies', takes less than 200 KB", () => {
    const size = (name) => gzipSync(Buffer.from(bytesOf(name)), { level: 9 }).length;
    assert.ok(size("../data/sky.bin") + size("../data/air.bin") < 200e3);
  });

  for (const expected of fixture.airs)
    it(`of turbidity ${expected.turbidity} with the Sun at ${expected.sunElevation}°`, () => {
      const { extinction, inScattered } = errorsOf(expected);
      console.log(
        `turbidity ${expected.turbidity}, Sun ${expected.sunElevation}: f ${rms(extinction).toFixed(4)} rms, ` +
          `${most(extinction).toFixed(4)} most; L_in ${rms(inScattered).toFixed(4)} rms, ` +
          `${most(inScattered).toFixed(4)} most`,
      );
      // The Earth's shadow in the air has an edge, which few components blur.
      const low = expected.sunElevation < 5;
      assert.ok(rms(extinction) < 0.005 && most(extinction) < 0.04, "extinction");
      assert.ok(rms(inScattered) < (low ? 0.1 : 0.07), "in-scattered light");
      assert.ok(most(inScattered) < (low ? 0.7 : 0.25), "in-scattered light at most");
    });

  it("is none at no distance, and takes all in the end", () => {
    const air = airs.under(skyAt(2.5, 30));
    const near = air.between({ x: 0, y: 0, z: 1 }, 0);
    assert.deepEqual(near, { extinction: [1, 1, 1], inScattered: [0, 0, 0] });
    const far = air.between({ x: 0.3, y: -0.1, z: 1 }, 1e9);
    assert.ok(far.extinction.every((f) => f < 1e-6));
    const seen = air.seen([1, 2, 3], { x: 0, y: 0, z: 1 }, 5000);
    assert.ok(seen.every((value, c) => value > (c + 1) * near.extinction[c] * 0.2));
  });

  it("changes without a step while the Sun moves and the air gets hazy", () => {
    const pale = (turbidity, elevation) => {
      const air = airs.under(skyAt(turbidity, elevation));
      const { inScattered } = air.between({ x: -0.4, y: 0.01, z: 1 }, 20000);
      air.dispose();
      return Math.log(luminance(inScattered));
    };
    const bends = (logs) => logs.slice(2).map((v, i) => Math.abs(v - 2 * logs[i + 1] + logs[i]));
    const suns = Array.from({ length: 700 }, (_, i) => pale(2.5, -6 + i / 10));
    assert.ok(most(bends(suns)) < 0.02, `${most(bends(suns))}`);
    const haze = Array.from({ length: 90 }, (_, i) => pale(1 + i / 10, 20));
    assert.ok(most(bends(haze)) < 0.03, `${most(bends(haze))}`);
  });

  it("is refused where the bytes are something else", () => {
    for (const broken of [new ArrayBuffer(0), new ArrayBuffer(99), bytesOf("../data/air.bin").slice(0, 20000)])
      assert.throws(() => new LambentAir(broken), /data\/air\.bin/);
  });
});
