// The small disc of a light whose shadows are sharp: which it is, and the points that stand for it.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { kLargestSun, LambentLight, sunOf, sunPoints } from "three-lambent";

const sun = (more = {}) => ({
  direction: { x: 0.6, y: 0.3, z: -0.5 },
  diameter: 0.0093,
  radiance: [40000, 36000, 30000],
  ...more,
});
const axisOf = ({ direction: { x, y, z } }) => {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
};
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const irradianceOf = (disc) =>
  [...new LambentLight(1).addDisc(disc).coefficients].map((v) => v * Math.sqrt(4 * Math.PI));

describe("a sharp Sun", () => {
  it("is the small disc that brings most light", () => {
    const bright = sun();
    const small = sun({ diameter: 0.001, direction: { x: 0, y: 1, z: 0 } });
    const large = sun({ diameter: 1.01 * kLargestSun });
    const set = sun({
      radiance: [1e9, 1e9, 1e9],
      direction: { x: 1, y: -0.3, z: 0 },
      horizon: { up: { x: 0, y: 1, z: 0 }, elevation: 0 },
    });
    assert.equal(sunOf([small, large, set, bright]), bright);
    assert.equal(sunOf([large, set, sun({ radiance: [0, 0, 0] })]), null);
    assert.equal(sunOf([]), null);
  });

  for (const [name, more] of [
    ["even", {}],
    ["darker towards its limb", { limbDarkening: [0.4, 0.5, 0.6] }],
    [
      "cut by a horizon",
      {
        direction: { x: 1, y: 0.001, z: 0.2 },
        limbDarkening: [0.4, 0.5, 0.6],
        horizon: { up: { x: 0, y: 1, z: 0 }, elevation: 0 },
      },
    ],
    [
      "of which a sliver is left",
      {
        direction: { x: 1, y: -0.00459, z: 0 },
        horizon: { up: { x: 0, y: 1, z: 0 }, elevation: 0 },
      },
    ],
  ])
    it(`${name}: its points bring as much light as it does`, () => {
      const disc = sun(more);
      const [axis, irradiance] = [axisOf(disc), irradianceOf(disc)];
      for (const count of [1, 2, 5, 16, 64]) {
        const points = sunPoints(disc, count);
        assert.equal(points.length, count);
        const sum = [0, 0, 0];
        for (const point of points) {
          assert.ok(Math.abs(Math.hypot(...point.direction) - 1) < 1e-12);
          assert.ok(Math.acos(Math.min(1, dot(point.direction, axis))) <= disc.diameter / 2 + 1e-7);
          if (disc.horizon) assert.ok(point.direction[1] >= -1e-9, `${count}: below the horizon`);
          point.irradiance.forEach((value, c) => (sum[c] += value / count));
        }
        sum.forEach((value, c) =>
          assert.ok(Math.abs(value / irradiance[c] - 1) < 1e-6, `${count}: ${value}`),
        );
      }
    });

  it("stands in the middle with one point, and around it with many", () => {
    const [axis, points] = [axisOf(sun()), sunPoints(sun(), 256)];
    assert.ok(dot(sunPoints(sun(), 1)[0].direction, axis) > 1 - 1e-12);
    const middle = [0, 1, 2].map((i) => points.reduce((s, p) => s + p.direction[i], 0) / 256);
    assert.ok(Math.hypot(...middle.map((v, i) => v - axis[i])) < 0.02 * 0.0093);
    // The first few are spread over it, too: their mean square distance is half the radius'.
    const square = points
      .slice(0, 8)
      .reduce((s, p) => s + (2 - 2 * dot(p.direction, axis)) / (0.0093 / 2) ** 2 / 8, 0);
    assert.ok(Math.abs(square - 0.5) < 0.15, `${square}`);
  });
});

describe("a window's weights", () => {
  it("are what the window does", () => {
    for (const name of ["none", "minimal", "hann:4", "lanczos:3"]) {
      const light = new LambentLight(5).add(LambentLight.uniform([0.2, 0.3, 0.4])).addDisc(sun());
      const weighted = light.clone().attenuate(light.windowWeights(name));
      const windowed = light.clone().window(name);
      assert.deepEqual([...weighted.coefficients], [...windowed.coefficients], name);
    }
  });
});
