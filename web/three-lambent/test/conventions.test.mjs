// The table of conventions (tests/conventions/table.json, made from definitions) that C++, GLSL and
// TypeScript all pass.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { it } from "node:test";
import { Quaternion, Vector3 } from "three";
import {
  clampedCosineMoments,
  evaluateHarmonics,
  filmic,
  HarmonicRotation,
  LambentLight,
  leastSofteningOfZonal,
  phongLobeMoments,
  srgbDecode,
  srgbEncode,
} from "../dist/index.js";
import { shownLobe } from "../dist/sh/lobe.js";

const table = JSON.parse(
  readFileSync(new URL("../../../tests/conventions/table.json", import.meta.url), "utf8"),
);

function near(found, expected, tolerance, what) {
  assert.equal(found.length, expected.length, what);
  expected.forEach((value, i) =>
    assert.ok(Math.abs(found[i] - value) <= tolerance, `${what} [${i}]: ${found[i]}, not ${value}`),
  );
}

it("harmonics", () => {
  for (const { direction, bands, values } of table.harmonics)
    near(evaluateHarmonics(bands, ...direction), values, 1e-12, `y(${direction})`);
});

it("rotation of harmonics", () => {
  const { bands, dstFromSrc, before, after } = table.rotation;
  const out = new Float64Array(after.length);
  new HarmonicRotation(bands).set(dstFromSrc.flat()).apply(before, out, bands);
  near(out, after, 1e-12, "rotated");
});

it("cosine factors and lobe moments", () => {
  near(clampedCosineMoments(table.cosineFactors.length), table.cosineFactors, 1e-12, "cosine");
  for (const { exponent, values } of table.lobeMoments)
    near(phongLobeMoments(values.length, exponent), values, 1e-12, `lobe ${exponent}`);
  for (const { bands, exponent, window, gain } of table.softLobes) {
    const plain = phongLobeMoments(bands, exponent);
    near(leastSofteningOfZonal(plain), window, 1e-9, `soft ${exponent}`);
    const shown = shownLobe(bands, exponent, { soft: true, horizon: true });
    near(shown.moments, plain.map((moment, l) => window[l] * moment), 1e-9, `shown ${exponent}`);
    const { gain: c } = shown;
    const found = gain.map(([mu]) => 1 + mu * (c[0] + mu * (c[1] + mu * (c[2] + mu * c[3]))));
    near(found, gain.map(([, value]) => value), 2e-4, `gain ${exponent}`);
  }
});

it("discs", () => {
  for (const { diameter, zonal } of table.disc) {
    const light = new LambentLight(zonal.length).addDisc({
      direction: new Vector3(0, 0, 2),
      diameter: (diameter * Math.PI) / 180,
      radiance: [1, 0, 0.5],
    });
    zonal.forEach((value, l) => {
      for (const [c, factor] of [1, 0, 0.5].entries())
        assert.ok(Math.abs(light.coefficients[3 * (l * l + l) + c] - factor * value) < 1e-12);
    });
  }
});

it("tone curve and sRGB", () => {
  for (const [linear, shown] of table.filmic)
    near([filmic(linear)], [shown], 1e-7, `filmic ${linear}`);
  for (const [linear, code] of table.srgb) {
    near([srgbEncode(linear)], [code], 1e-6, `sRGB of ${linear}`);
    near([srgbDecode(code)], [linear], 1e-5, `linear of ${code}`);
  }
});

it("latitude-longitude: a bright pixel lights from its direction", () => {
  // A map that is a cosine lobe about the direction: its linear band points there.
  const [width, height] = [128, 64];
  for (const { direction, uv } of table.latLong) {
    const data = new Float32Array(3 * width * height);
    const x = Math.min(Math.floor(uv[0] * width), width - 1) % width;
    const y = Math.min(Math.floor(uv[1] * height), height - 1);
    data.fill(1000, 3 * (y * width + x), 3 * (y * width + x) + 3);
    const image = { data, width, height, channels: 3, encoding: "float32", topRowFirst: true };
    const { coefficients } = LambentLight.fromEquirectangular(image, 2);
    const towards = new Vector3(coefficients[9], coefficients[3], coefficients[6]).normalize();
    assert.ok(towards.dot(new Vector3(...direction)) > 0.995, `${direction}: ${towards.toArray()}`);
  }
});

it("quaternions turn light as they turn directions", () => {
  const q = new Quaternion(0.3, -0.5, 0.2, 0.7).normalize();
  const direction = new Vector3(1, 2, -0.5);
  const disc = { direction, diameter: 0.8, radiance: [1, 2, 3] };
  const turned = new LambentLight(10).addDisc(disc).rotate(q);
  disc.direction = direction.clone().applyQuaternion(q);
  near(turned.coefficients, new LambentLight(10).addDisc(disc).coefficients, 1e-12, "turned disc");
});
