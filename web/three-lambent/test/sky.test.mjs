// A sky, its ground and a setting Sun as WebGL shows them, at every zoom.
import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { Quaternion, Vector3 } from "three";
import { bundle, openPage } from "./support/browser.mjs";

const kSize = 64;

const script = `
import * as THREE from "three";
import { EnvironmentBackground } from "three-lambent";

const renderer = new THREE.WebGLRenderer();
const size = ${kSize};
const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType });

window.draw = ({ rows, width, height, horizon, rotation, discs, look, up, fov, environment }) => {
  const texture = new THREE.DataTexture(
    new Float32Array(rows), width, height, THREE.RGBAFormat, THREE.FloatType);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  const quaternion = (q) => new THREE.Quaternion(...q);
  const background = new EnvironmentBackground({
    texture: null,
    rotation: quaternion(environment),
    sky: { texture, horizon, rotation: quaternion(rotation) },
    discs,
  });
  const camera = new THREE.PerspectiveCamera(fov, 1, 0.1, 10);
  camera.up.set(...up);
  camera.lookAt(...look);
  camera.updateMatrixWorld();
  const scene = new THREE.Scene();
  scene.add(background);
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = new Float32Array(4 * size * size);
  renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
  background.dispose();
  texture.dispose();
  return [...pixels];
};
window.ready = true;
`;

/** Radiance of the sky in its own frame, much brighter towards its horizon and towards +x. */
const glow = (azimuth, above) =>
  (1 + 0.9 * Math.cos(azimuth)) * (0.2 + Math.exp(-6 * Math.max(0, above)));

describe("a sky", () => {
  let browser;
  before(async () => {
    browser = await openPage({ script: await bundle(script) });
    await browser.page.waitForFunction(() => window.ready);
  });
  after(() => browser?.close());

  const ground = [0.3, 0.2, 0.1];
  const [width, height] = [128, 256];

  function rowsOf(horizon) {
    const rows = new Float32Array(4 * width * height);
    for (let r = 0; r < height; ++r)
      for (let x = 0; x < width; ++x) {
        const above = (Math.PI / 2 - horizon) * (r / (height - 1)) ** 2;
        const azimuth = 2 * Math.PI * ((x + 0.5) / width - 0.5);
        rows.fill(glow(azimuth, above), 4 * (r * width + x), 4 * (r * width + x) + 4);
      }
    return [...rows];
  }

  for (const turned of [false, true])
    it(`ends at a sharp horizon at any zoom${turned ? ", turned" : ""}`, async () => {
      const horizon = -0.05;
      const rotation = turned ? new Quaternion(0.1, 0.7, -0.2, 0.4).normalize() : new Quaternion();
      const environment = turned
        ? new Quaternion(0.3, 0.1, 0.5, -0.2).normalize()
        : new Quaternion();
      const up = new Vector3(0, 1, 0).applyQuaternion(rotation);
      const azimuth = 0.4;
      const look = new Vector3(
        Math.cos(horizon) * Math.cos(azimuth),
        Math.sin(horizon),
        Math.cos(horizon) * Math.sin(azimuth),
      ).applyQuaternion(rotation);
      const discs = [
        {
          direction: up.clone().negate(),
          diameter: 2 * Math.PI,
          radiance: ground,
          horizon: { up: up.clone().negate(), elevation: -horizon },
        },
      ];
      for (const fov of [60, 1, 0.05]) {
        const pixels = await browser.page.evaluate((state) => window.draw(state), {
          rows: rowsOf(horizon),
          width,
          height,
          horizon,
          rotation: rotation.toArray(),
          environment: environment.toArray(),
          discs,
          look: look.toArray(),
          up: up.toArray(),
          fov,
        });
        assert.deepEqual(browser.problems(), []);
        // Rows from below. Those beside the middle are ground and sky to the last pixel.
        const half = Math.tan((fov * Math.PI) / 360);
        const x = kSize / 2;
        for (let y = 0; y < kSize; ++y) {
          const red = pixels[4 * (y * kSize + x)];
          if (y < kSize / 2) assert.equal(red, Math.fround(ground[0]), `${fov} row ${y}`);
          else {
            const above = Math.atan((((y + 0.5) / kSize) * 2 - 1) * half);
            const expected = glow(azimuth + Math.atan(half / kSize), above);
            assert.ok(Math.abs(red / expected - 1) < 0.01, `${fov} row ${y}: ${red}, ${expected}`);
          }
        }
      }
    });

  it("a Sun darkens towards its limb and sets", async () => {
    const limbDarkening = [0.5, 0.6, 0.7];
    const [diameter, horizon] = [0.01, { up: new Vector3(0, 1, 0), elevation: -0.002 }];
    const sun = { direction: new Vector3(1, 0, 0), diameter, radiance: [3, 2, 1] };
    const pixels = await browser.page.evaluate((state) => window.draw(state), {
      rows: [0, 0, 0, 1],
      width: 1,
      height: 1,
      horizon: 0,
      rotation: [0, 0, 0, 1],
      environment: [0, 0, 0, 1],
      discs: [{ ...sun, limbDarkening, horizon }],
      look: [1, 0, 0],
      up: [0, 1, 0],
      fov: 0.72,
    });
    assert.deepEqual(browser.problems(), []);
    const half = Math.tan((0.36 * Math.PI) / 180);
    for (let y = 0; y < kSize; ++y)
      for (let x = 0; x < kSize; ++x) {
        const [px, py] = [x, y].map((v) => (((v + 0.5) / kSize) * 2 - 1) * half);
        const share = Math.hypot(px, py) / (diameter / 2);
        if (Math.abs(share - 1) < 0.01 || Math.abs(py + 0.002) < 1e-6) continue;
        const mu = Math.sqrt(Math.max(0, 1 - share * share));
        const seen = share < 1 && py > -0.002;
        sun.radiance.forEach((center, c) => {
          const expected = seen ? center * (1 - limbDarkening[c] * (1 - mu)) : 0;
          const value = pixels[4 * (y * kSize + x) + c];
          assert.ok(Math.abs(value - expected) < 0.01, `${x} ${y}: ${value}, not ${expected}`);
        });
      }
  });
});
