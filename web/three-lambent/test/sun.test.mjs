// The Sun of the page is the Sun of the library: tests/conventions/sun_positions.json.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { it } from "node:test";
import {
  polynomialDeltaT,
  refraction,
  sunAngularRadius,
  sunIrradianceScale,
  sunPosition,
  worldDirection,
} from "../dist/index.js";

const { positions } = JSON.parse(
  readFileSync(new URL("../../../tests/conventions/sun_positions.json", import.meta.url), "utf8"),
);
const degree = Math.PI / 180;
const minute = degree / 60;

function near(found, expected, tolerance, what) {
  assert.ok(Math.abs(found - expected) <= tolerance, `${what}: ${found}, not ${expected}`);
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

it("the table of Sun positions", () => {
  assert.equal(positions.length, 20);
  for (const row of positions) {
    const sun = sunPosition(
      Date.parse(`${row.utc}Z`),
      row.latitude * degree,
      row.longitude * degree,
    );
    const found = worldDirection(sun.azimuth, sun.elevation);
    const expected = worldDirection(row.azimuth * degree, row.elevation * degree);
    // The page does without leap seconds: up to 7 s of ΔT, .3″.
    const apart = Math.hypot(...found.map((x, i) => x - expected[i]));
    assert.ok(apart < 2e-6, `${row.utc}: ${apart} rad`);
    near(sun.distance / row.distance, 1, 1e-7, `${row.utc} distance`);
    if (row.seenElevation !== null)
      near(
        sun.elevation + refraction(sun.elevation),
        row.seenElevation * degree,
        3e-6,
        `${row.utc} as seen`,
      );
  }
});

it("refraction rises smoothly through the horizon", () => {
  near(-34.5 * minute + refraction(-34.5 * minute), 0, 0.1 * minute, "horizon");
  near(refraction(45 * degree), minute, 0.02 * minute, "45°");
  near(refraction(90 * degree), 0, 1e-9, "zenith");
  near(refraction(0.1, { pressure: 50500 }), refraction(0.1) / 2, 1e-15, "half the air");
  const step = 0.01 * degree;
  let before = refraction(-90 * degree);
  let second;
  let beforeThat = before;
  for (let i = 1; i < 18000; ++i) {
    const h = -90 * degree + i * step;
    const lift = refraction(h);
    assert.ok(h + lift > h - step + before, `${h / degree}`);
    const curvature = (lift - 2 * before + beforeThat) / step ** 2;
    if (i > 2) near(curvature, second, 1, `curvature at ${h / degree}`);
    second = curvature;
    [beforeThat, before] = [before, lift];
  }
});

it("the Sun runs without steps, over every year", () => {
  for (let year = 1600; year <= 2400; year += 10) {
    const start = Date.UTC(year, 11, 31, 23, 59, 59);
    let before;
    for (let second = 0; second < 3; ++second) {
      const { azimuth, elevation, distance } = sunPosition(start + 1000 * second, 0.8, -3);
      const direction = worldDirection(azimuth, elevation);
      if (before) assert.ok(dot(direction, before) > Math.cos(7.4e-5), `${year}`);
      before = direction;
      const scale = sunIrradianceScale(distance);
      assert.ok(scale > 0.96 && scale < 1.04, `${year}: ${scale}`);
      near(sunAngularRadius(distance) / minute, 16, 0.4, `${year} disc`);
    }
  }
});

it("ΔT", () => {
  for (const [year, seconds] of [[1600, 120], [1900, -2.7], [1955, 31.1], [2000, 63.8]])
    near(polynomialDeltaT(year), seconds, 0.1, year);
  for (const year of [1700, 1800, 1860, 1900, 1920, 1941, 1961, 1986, 2005, 2050, 2150])
    near(polynomialDeltaT(year - 1e-9), polynomialDeltaT(year), 0.2, year);
});

it("poles, the date line, and what is refused", () => {
  const time = Date.UTC(2026, 5, 21, 5, 40);
  const east = sunPosition(time, 0.5, Math.PI);
  const west = sunPosition(time, 0.5, -Math.PI);
  near(
    dot(worldDirection(east.azimuth, east.elevation), worldDirection(west.azimuth, west.elevation)),
    1,
    1e-12,
    "one meridian",
  );
  near(sunPosition(time, Math.PI / 2, 1).elevation, sunPosition(time, Math.PI / 2, 2).elevation,
       1e-9, "pole");
  for (const [t, latitude, longitude, what] of [
    [Number.NaN, 0, 0, /time/],
    [Date.UTC(1599, 0, 1), 0, 0, /1600 to 2400/],
    [Date.UTC(2402, 0, 1), 0, 0, /1600 to 2400/],
    [time, 1.6, 0, /latitude/],
    [time, Number.NaN, 0, /latitude/],
    [time, 0, 3.2, /longitude/],
    [time, 0, Number.POSITIVE_INFINITY, /longitude/],
  ])
    assert.throws(() => sunPosition(t, latitude, longitude), { name: "RangeError", message: what });
});
