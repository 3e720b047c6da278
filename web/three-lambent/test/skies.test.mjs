// Skies beside those of the library: data/skies.json is made with data/sky.bin, by lambent_sky_data.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { LambentLight, LambentSky, sunPosition } from "three-lambent";
import { sunCoordinate } from "../dist/sky/factors.js";

const file = readFileSync(new URL("../data/sky.bin", import.meta.url));
const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
const { directions, skies } = JSON.parse(
  readFileSync(new URL("data/skies.json", import.meta.url), "utf8"),
);
const maker = new LambentSky(bytes);
const kDegree = Math.PI / 180;
const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** The Sun's frame (+x towards it) is the world's with the Sun at a bearing of 90°. */
const skyOf = ({ model, turbidity, sunElevation, directNormal, diffuseHorizontal }) =>
  maker.at({
    ...{ model, turbidity, directNormal, diffuseHorizontal },
    sunElevation: sunElevation * kDegree,
    sunAzimuth: Math.PI / 2,
  });

/** Relative, of each channel; of one that is nearly out of the gamut against the luminance. */
function errors(sky, expected) {
  let [sum, most] = [0, 0];
  directions.forEach(([x, y, z], i) => {
    const seen = sky.radiance({ x, y, z });
    const wanted = expected.radiance[i];
    for (let c = 0; c < 3; ++c) {
      const error = (seen[c] - wanted[c]) / Math.max(wanted[c], 0.02 * luminance(wanted), 1e-9);
      sum += error * error;
      most = Math.max(most, Math.abs(error));
    }
  });
  return { rms: Math.sqrt(sum / (3 * directions.length)), most };
}

/** Relative; of a Sun of less than 10 mW m⁻², of that. */
function assertNear(value, expected, share, what) {
  const scale = luminance(expected);
  value.forEach((each, c) => {
    const error = Math.abs(each - expected[c]) / Math.max(expected[c], 0.02 * scale, what === "Sun" ? 0.01 : 1e-9);
    assert.ok(error < share, `${what}, channel ${c}: ${each}, not ${expected[c]}`);
  });
}

describe("skies", () => {
  it("are data of less than 200 KB", () => {
    assert.ok(gzipSync(file, { level: 9 }).length < 130e3);
    assert.ok(file.length < 240e3);
  });

  for (const expected of skies) {
    const { model, turbidity, sunElevation, directNormal, diffuseHorizontal } = expected;
    const simulated = model === "fast";
    const measured =
      directNormal === undefined ? "" : ` and ${directNormal} + ${diffuseHorizontal} W/m²`;
    it(`${model} of turbidity ${turbidity} with the Sun at ${sunElevation}°${measured}`, () => {
      const sky = skyOf(expected);
      const { rms, most } = errors(sky, expected);
      // In the last of twilight, where there is next to no light, a little more.
      assert.ok(rms < (!simulated ? 0.001 : sunElevation < -12 ? 0.025 : 0.02), `rms ${rms}`);
      assert.ok(most < (simulated ? 0.15 : 0.01), `most ${most}`);
      assertNear(sky.ground, expected.ground, simulated ? 0.025 : 0.002, "ground");
      assertNear(sky.sun.irradiance, expected.sun, 0.01, "Sun");
      const light = sky.light(5);
      let [off, all] = [0, 0];
      expected.coefficients.forEach((row, i) =>
        row.forEach((value, c) => {
          off += (value - light.coefficients[3 * i + c]) ** 2;
          all += value * value;
        }),
      );
      assert.ok(Math.sqrt(off / Math.max(all, 1e-12)) < (simulated ? 0.012 : 0.002), `SH ${Math.sqrt(off / all)}`);
    });
  }

  it("change without a step while the Sun moves", () => {
    for (const model of ["fast", "preetham"]) {
      const logs = [];
      for (let tenth = -178; tenth <= 200; ++tenth) {
        const sky = maker.at({ model, sunElevation: (tenth / 10) * kDegree });
        const zenith = sky.radiance({ x: 0, y: 1, z: 0 });
        logs.push(Math.log(luminance(zenith)));
        assert.ok(zenith.every((value) => value >= 0 && Number.isFinite(value)));
      }
      for (let i = 2; i < logs.length; ++i) {
        assert.ok(logs[i] > logs[i - 1], `${model} ${i}: falls while the Sun rises`);
        // Preetham's twilight has a kink at sunset.
        if (model === "fast")
          assert.ok(Math.abs(logs[i] - 2 * logs[i - 1] + logs[i - 2]) < 0.01, `${i}`);
      }
    }
  });

  it("have nodes where the library has them", () => {
    const header = new TextDecoder().decode(file.subarray(12, 12 + file.readUInt32LE(8)));
    JSON.parse(header).sunElevations.forEach((elevation, i) =>
      assert.ok(Math.abs(sunCoordinate(elevation) - i) < 1e-5),
    );
  });

  it("stand where the Sun of a moment does", () => {
    const date = Date.UTC(2026, 5, 21, 3, 40);
    const [latitude, longitude] = [46.2 * kDegree, 6.1 * kDegree];
    const sky = maker.at({ date, latitude, longitude });
    const airless = sunPosition(date, latitude, longitude);
    assert.equal(sky.sun.azimuth, airless.azimuth);
    assert.ok(sky.sun.elevation > airless.elevation);
    const { x, y, z } = { x: sky.sun.direction[0], y: 0.05, z: sky.sun.direction[2] };
    const towards = luminance(sky.radiance({ x, y, z }));
    assert.ok(towards > 3 * luminance(sky.radiance({ x: -x, y, z: -z })), "brightest at the Sun");
    // Summer: the Sun is farther away than on the average.
    assert.ok(sky.sun.angularRadius < 0.0046);
  });

  it("are lights: all of it, or without the Sun", () => {
    const sky = maker.at({ sunElevation: 0.7, sunAzimuth: 2 });
    const all = sky.light(10);
    const rest = sky.light(10, { without: "sun" }).addDisc(sky.sun.disc);
    all.coefficients.forEach((value, i) =>
      assert.ok(Math.abs(value - rest.coefficients[i]) < 1e-9),
    );
    const light = new LambentLight(3).setSky(sky);
    assert.deepEqual([...light.coefficients], [...sky.light(3).coefficients]);
    assert.equal(sky.environment.discs.length, 2);
    assert.equal(maker.at({ sunElevation: -0.1 }).environment.discs.length, 1);
    assert.equal(maker.at({ sunElevation: 0.7, model: "cie-overcast" }).sun.disc, null);
    sky.dispose();
  });

  it("are refused where there is none", () => {
    for (const [request, words] of [
      [{ sunElevation: -0.4 }, /night/],
      [{ sunElevation: 2 }, /elevation/],
      [{ sunElevation: NaN }, /elevation/],
      [{ sunElevation: 1, turbidity: 11 }, /turbidity/],
      [{ sunElevation: 1, model: "cie:16" }, /model/],
      [{ sunElevation: 1, model: "exact" }, /takes the tool: lambent sky/],
      [{ sunElevation: 1, model: "perez", directNormal: -1 }, /irradiance/],
      [{ sunElevation: 1, model: "asrc-cie", diffuseHorizontal: NaN }, /irradiance/],
      [{ sunElevation: 1, directNormal: 500 }, /perez and asrc-cie/],
      [{ sunElevation: 1, date: 0, latitude: 0, longitude: 0 }, /one of the two/],
      [{ date: 0 }, /latitude/],
      [{ date: 0, latitude: 2, longitude: 0 }, /latitude/],
      [{ date: Date.UTC(2500, 1), latitude: 1, longitude: 0 }, /1600/],
      [{}, /sunElevation/],
    ])
      assert.throws(() => maker.at(request), (error) => {
        assert.ok(error instanceof RangeError, String(error));
        assert.match(error.message, words);
        return true;
      });
    for (const broken of [new ArrayBuffer(0), new ArrayBuffer(99), bytes.slice(0, 50000)])
      assert.throws(() => new LambentSky(broken), /LambentSky/);
  });
});
