// Light from every source that LambentLight takes.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import {
  DataTexture,
  DataUtils,
  FloatType,
  HalfFloatType,
  LightProbe,
  RGBAFormat,
  SphericalHarmonics3,
  Texture,
  Vector3,
} from "three";
import { evaluateHarmonics, LambentLight } from "../dist/index.js";
import { floatFromHalf, halfFromFloat } from "../dist/format/half.js";
import { turnSamples } from "../dist/gpu/turn-samples.js";

const directions = Array.from({ length: 50 }, (_, i) => {
  const z = 1 - (2 * i + 1) / 50;
  const r = Math.sqrt(1 - z * z);
  return new Vector3(r * Math.cos(2.4 * i), r * Math.sin(2.4 * i), z);
});

const close = (a, b, tolerance, what = "") =>
  assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a}, not ${b}`);

/** Radiance as a function of direction → an equirectangular image. */
function mapOf(width, height, radiance) {
  const data = new Float32Array(4 * width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const azimuth = 2 * Math.PI * ((x + 0.5) / width - 0.5);
      const elevation = Math.PI * (0.5 - (y + 0.5) / height);
      const [c, s] = [Math.cos(elevation), Math.sin(elevation)];
      data.set(
        [...radiance(c * Math.cos(azimuth), s, c * Math.sin(azimuth)), 1],
        4 * (y * width + x),
      );
    }
  return data;
}

describe("images", () => {
  it("gives back the harmonics that an image was drawn from", () => {
    const width = 512;
    const data = mapOf(width, 256, (x, y, z) => {
      const b = evaluateHarmonics(4, x, y, z);
      return [b[1] + 2 * b[5], b[6] - b[11], 0.5 * b[0] + b[8] + b[15]];
    });
    const image = { data, width, height: 256, channels: 4, encoding: "float32", topRowFirst: true };
    const light = LambentLight.fromEquirectangular(image, 5);
    const expected = new Float64Array(75);
    for (const [i, c, value] of [
      [1, 0, 1],
      [5, 0, 2],
      [6, 1, 1],
      [11, 1, -1],
      [0, 2, 0.5],
      [8, 2, 1],
      [15, 2, 1],
    ])
      expected[3 * i + c] = value;
    light.coefficients.forEach((value, i) => close(value, expected[i], 2e-4, `coefficient ${i}`));
  });

  it("of one radiance is uniform light, to the last digits", () => {
    const image = {
      data: new Float32Array(3 * 8 * 4).fill(2),
      width: 8,
      height: 4,
      channels: 3,
      encoding: "float32",
      topRowFirst: true,
    };
    const uniform = LambentLight.uniform([2, 2, 2], 10).coefficients;
    LambentLight.fromEquirectangular(image, 10).coefficients.forEach((v, i) =>
      close(v, uniform[i], 1e-12),
    );
  });

  it("textures: halves and floats, upside down or not", () => {
    const [width, height] = [32, 16];
    const top = mapOf(width, height, (x, y, z) => [1 + y, 1 + x, 1 + 0.5 * z]);
    const flipped = new Float32Array(top.length);
    for (let y = 0; y < height; ++y)
      flipped.set(top.subarray(y * 4 * width, (y + 1) * 4 * width), (height - 1 - y) * 4 * width);
    const from = (data, type, flipY) => {
      const texture = new DataTexture(data, width, height, RGBAFormat, type);
      texture.flipY = flipY;
      return LambentLight.fromEquirectangular(texture, 3).coefficients;
    };
    const expected = from(top, FloatType, true);
    assert.ok(expected[3] > 0.1, "up is brighter"); // y(1, −1) = 0.4886 y
    from(flipped, FloatType, false).forEach((v, i) => close(v, expected[i], 1e-12));
    const halves = Uint16Array.from(top, (v) => DataUtils.toHalfFloat(v));
    from(halves, HalfFloatType, true).forEach((v, i) => close(v, expected[i], 5e-3));
  });

  it("says what cannot be read", () => {
    assert.throws(() => LambentLight.fromEquirectangular(new Texture()), /not in memory/);
    const short = {
      data: [1, 2, 3],
      width: 2,
      height: 2,
      channels: 3,
      encoding: "float32",
      topRowFirst: true,
    };
    assert.throws(() => LambentLight.fromEquirectangular(short), /needs 12 numbers, and has 3/);
  });
});

describe("three's light probe", () => {
  it("has our basis: what it gives in a direction, and its irradiance", () => {
    const probe = new LightProbe(new SphericalHarmonics3(), 0.5);
    probe.sh.coefficients.forEach((v, i) => v.set(Math.sin(i + 1), Math.cos(3 * i), 0.1 * i));
    const light = LambentLight.fromLightProbe(probe);
    assert.equal(light.bands, 3);
    const truth = new Vector3();
    for (const d of directions) {
      probe.sh.getAt(d, truth).multiplyScalar(0.5);
      light.radiance(d).forEach((v, c) => close(v, truth.getComponent(c), 1e-5));
    }
  });
});

describe("discs that are a Sun or a ground", () => {
  const radiance = [1, 2, 3];
  const limbDarkening = [0, 0.6, 1];

  /** Coefficients of 4 bands by points of equal area over the disc. */
  function sampled(axis, diameter, isSeen) {
    const kRings = 300;
    const [u, v] = [new Vector3(0, 1, 0).cross(axis).normalize(), new Vector3()];
    v.crossVectors(axis, u);
    const out = new Float64Array(48);
    const versine = 2 * Math.sin(diameter / 4) ** 2;
    const area = (2 * Math.PI * versine) / (kRings * 4 * kRings);
    const s = new Vector3();
    for (let i = 0; i < kRings; ++i)
      for (let k = 0; k < 4 * kRings; ++k) {
        const t = (i + 0.5) / kRings;
        const turn = (Math.PI * (k + 0.5)) / (2 * kRings);
        const cosine = 1 - versine * t;
        const sine = Math.sqrt(1 - cosine * cosine);
        s.copy(axis).multiplyScalar(cosine);
        s.addScaledVector(u, sine * Math.cos(turn)).addScaledVector(v, sine * Math.sin(turn));
        if (!isSeen(s)) continue;
        const y = evaluateHarmonics(4, s.x, s.y, s.z);
        for (let c = 0; c < 3; ++c) {
          const value = radiance[c] * (1 - limbDarkening[c] * (1 - Math.sqrt(1 - t))) * area;
          for (let j = 0; j < 16; ++j) out[3 * j + c] += value * y[j];
        }
      }
    return out;
  }

  it("darken towards the limb, and set", () => {
    for (const elevation of [0.4, 0.001, -0.002]) {
      const direction = new Vector3(Math.cos(elevation), Math.sin(elevation), 0);
      const horizon = { up: new Vector3(0, 1, 0), elevation: 0 };
      const disc = { direction, diameter: 0.0093, radiance, limbDarkening, horizon };
      const light = new LambentLight(4).addDisc(disc);
      const expected = sampled(direction, disc.diameter, (s) => s.y >= 0);
      const whole = Math.max(...expected);
      light.coefficients.forEach((v, i) => close(v, expected[i], 2e-4 * whole, `${i}`));
    }
  });

  it("a ground is what a horizon leaves of a disc over everything", () => {
    const down = new Vector3(0, -1, 0);
    const horizon = { up: down, elevation: 0.1 };
    const ground = { direction: down, diameter: 2 * Math.PI, radiance, horizon };
    const cap = { direction: down, diameter: Math.PI - 0.2, radiance };
    const light = new LambentLight(5).addDisc(ground);
    const expected = new LambentLight(5).addDisc(cap);
    light.coefficients.forEach((v, i) => close(v, expected.coefficients[i], 1e-12));
  });
});

describe("sums and windows", () => {
  it("adds, scales, copies, cuts bands", () => {
    const disc = { direction: new Vector3(0, 1, 0), diameter: 1, radiance: [1, 1, 1] };
    const light = new LambentLight(4)
      .addDisc(disc)
      .add(LambentLight.uniform([1, 2, 3], 2))
      .scale(2);
    const same = LambentLight.uniform([2, 4, 6], 4).add(new LambentLight(4).addDisc(disc), 2);
    light.coefficients.forEach((v, i) => close(v, same.coefficients[i], 1e-12));
    const before = light.version;
    light.copy(new LambentLight(9).addDisc(disc));
    assert.ok(light.version > before);
    new LambentLight(4)
      .addDisc(disc)
      .coefficients.forEach((v, i) => close(light.coefficients[i], v, 1e-12));
  });

  it("a disc over the whole sphere is uniform light; one without extent is none", () => {
    const direction = new Vector3(1, 2, 3);
    const whole = new LambentLight(6).addDisc({
      direction,
      diameter: 2 * Math.PI,
      radiance: [1, 1, 1],
    });
    LambentLight.uniform([1, 1, 1], 6).coefficients.forEach((v, i) =>
      close(whole.coefficients[i], v, 1e-12),
    );
    const none = new LambentLight(6).addDisc({ direction, diameter: 0, radiance: [1, 1, 1] });
    assert.ok(none.coefficients.every((v) => v === 0));
  });

  it("the minimal window leaves nothing negative, and takes no more than it must", () => {
    const light = new LambentLight(6).addDisc({
      direction: new Vector3(1, 1, 0),
      diameter: 0.4,
      radiance: [1, 2, 0],
    });
    assert.ok(Math.min(...directions.map((d) => light.radiance(d)[0])) < 0);
    const windowed = light.clone().window("minimal");
    let least = Infinity;
    for (let i = 0; i < 20000; ++i) {
      const z = 1 - (2 * i + 1) / 20000;
      const r = Math.sqrt(1 - z * z);
      least = Math.min(
        least,
        windowed.radiance(new Vector3(r * Math.cos(2.4 * i), r * Math.sin(2.4 * i), z))[0],
      );
    }
    const mean = windowed.coefficients[0] / Math.sqrt(4 * Math.PI);
    assert.ok(least > -1e-6 * mean, `${least} of ${mean}`);
    assert.ok(least < 0.01 * mean, `${least}: more was taken than need be`);
    // Zero where the other window has its width.
    const hann = light.clone().window("hann:3");
    assert.ok(hann.coefficients.subarray(27).every((v) => v === 0));
    assert.equal(light.clone().window("none").version, light.clone().version);
  });

  it("names what it does not take", () => {
    assert.throws(() => new LambentLight(11), /11 bands, where 1 to 10/);
    assert.throws(() => LambentLight.fromCoefficients([1, 2, 3, 4, 5, 6]), /6 numbers/);
    assert.throws(() => LambentLight.fromCoefficients([[1, 2, NaN]]), /not a finite/);
    assert.throws(() => LambentLight.fromJson({ lambent: "view" }), /is not/);
    assert.throws(() => new LambentLight().window("hann:0"), /no window "hann:0"/);
    assert.throws(() => new LambentLight().window("box"), /no window "box"/);
    const disc = { direction: new Vector3(), diameter: 1, radiance: [1, 1, 1] };
    assert.throws(() => new LambentLight().addDisc(disc), /cannot be/);
  });

  it("reads LIGHT.json", () => {
    const json = { lambent: "light", bands: 1, coefficients: [[1, 2, 3]] };
    assert.deepEqual([...LambentLight.fromJson(json).coefficients], [1, 2, 3]);
  });
});

describe("numbers", () => {
  it("halves: every pattern comes back, and rounding is to the nearest, ties to even", () => {
    for (let h = 0; h < 65536; ++h) {
      if ((h & 0x7c00) === 0x7c00) continue;
      assert.equal(halfFromFloat(floatFromHalf(h)), h);
    }
    for (const [value, half] of [
      [1 + 2 ** -11, 0x3c00],
      [1 + 3 * 2 ** -11, 0x3c02],
      [2 ** -25, 0],
      [1.5 * 2 ** -24, 2],
      [70000, 0x7bff],
      [-Infinity, 0xfbff],
      [NaN, 0],
    ])
      assert.equal(halfFromFloat(value), half, String(value));
  });

  it("a band is well told by its values where the turn pass looks", () => {
    const bands = 10;
    const { texels, width } = turnSamples(bands);
    for (let l = 0; l < bands; ++l) {
      let most = 0;
      for (let i = l * l; i < (l + 1) ** 2; ++i) {
        let norm = 0;
        const sums = new Float64Array(bands * bands);
        for (let k = 0; k < 2 * l + 1; ++k) {
          const [x, y, z, share] = texels.subarray(4 * (i * width + k));
          const values = evaluateHarmonics(bands, x, y, z);
          for (let j = l * l; j < (l + 1) ** 2; ++j) sums[j] += share * values[j];
          norm += share * share;
        }
        for (let j = l * l; j < (l + 1) ** 2; ++j)
          close(sums[j], i === j ? 1 : 0, 1e-5, `band ${l}: ${i}, ${j}`);
        most = Math.max(most, Math.sqrt(norm));
      }
      // How much an error of the values can grow.
      assert.ok(most < 10, `band ${l}: ${most}`);
    }
  });
});
