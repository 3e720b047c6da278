// The page of the tests of three's WebGPURenderer: the same asset, under the same light, by it on each
// of its back ends and by WebGLRenderer.
import * as THREE from "three";
import { RenderTarget, WebGPURenderer } from "three/webgpu";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import * as lambent from "three-lambent";
import { nodes } from "three-lambent/webgpu";

const size = 96;

export async function load(url, options = { nodes }) {
  const loader = new GLTFLoader();
  loader.register((parser) => new lambent.LambentLoaderPlugin(parser, options));
  return loader.loadAsync(url);
}

/** How a renderer is made; null where there is none. */
export async function makeRenderer(kind) {
  if (kind === "webgl") return prepared(new THREE.WebGLRenderer({ antialias: false }));
  const renderer = new WebGPURenderer({ antialias: false, forceWebGL: kind === "fallback" });
  await renderer.init();
  if (kind === "webgpu" && !renderer.backend.isWebGPUBackend) {
    renderer.dispose();
    return null;
  }
  return prepared(renderer);
}

function prepared(renderer) {
  renderer.setPixelRatio(1);
  renderer.setSize(size, size);
  return renderer;
}

/** Linear pixels, four floats each, the lowest row first. */
export async function pixels(renderer, scene, camera) {
  const Target = renderer.isWebGPURenderer ? RenderTarget : THREE.WebGLRenderTarget;
  const target = new Target(size, size, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.setClearColor(0x000000, 0);
  renderer.clear();
  renderer.render(scene, camera);
  renderer.setRenderTarget(null);
  const out = new Float32Array(4 * size * size);
  if (renderer.isWebGPURenderer) {
    const read = await renderer.readRenderTargetPixelsAsync(target, 0, 0, size, size);
    for (let y = 0; y < size; ++y)
      out.set(read.subarray((size - 1 - y) * 4 * size, (size - y) * 4 * size), y * 4 * size);
    // WebGPU has the highest row first, and so has its fallback.
    if (!renderer.backend.isWebGPUBackend) out.set(read);
  } else renderer.readRenderTargetPixels(target, 0, 0, size, size, out);
  target.dispose();
  return out;
}

/** A light with a direction, in five bands. */
export function makeLight() {
  const light = lambent.LambentLight.uniform([0.2, 0.3, 0.4], 5);
  light.addDisc({ direction: { x: 0.5, y: 1, z: 0.7 }, diameter: 0.8, radiance: [9, 7, 5] });
  const direction = { x: -1, y: 0.2, z: 0 };
  return light.addDisc({ direction, diameter: 1.2, radiance: [0.3, 1, 3] });
}

export function makeCamera(orthographic = false) {
  const camera = orthographic
    ? new THREE.OrthographicCamera(-2, 2, 2, -2, 0.5, 40)
    : new THREE.PerspectiveCamera(35, 1, 0.5, 40);
  camera.position.set(0.4, 2.5, 6);
  camera.lookAt(0, 0.5, 0);
  camera.updateMatrixWorld();
  return camera;
}

export async function thrown(what) {
  try {
    await what();
    return "";
  } catch (error) {
    return `${error.name}: ${error.message}`;
  }
}

/** Pictures of linear pixels as screens show them: their mean difference and the largest, in 1/255. */
export function apart(a, b) {
  const shown = (v) => 255 * Math.min(1, Math.max(0, v)) ** (1 / 2.2);
  let [sum, most, light, above] = [0, 0, 0, 0];
  for (let p = 0; p < a.length; p += 4) {
    let worst = 0;
    for (let c = 0; c < 3; ++c) {
      const difference = Math.abs(shown(a[p + c]) - shown(b[p + c]));
      sum += difference / 3;
      worst = Math.max(worst, difference);
      light += shown(b[p + c]) / 3;
    }
    most = Math.max(most, worst);
    if (worst > 2) ++above;
  }
  const count = a.length / 4;
  return { mean: sum / count, most, light: light / count, above: above / count };
}

/** A picture as a PNG's URL. */
export function pictureOf(values, factor = 1) {
  const canvas = Object.assign(document.createElement("canvas"), { width: size, height: size });
  const context = canvas.getContext("2d");
  const image = context.createImageData(size, size);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x)
      for (let c = 0; c < 4; ++c) {
        const value = c === 3 ? 1 : values[4 * ((size - 1 - y) * size + x) + c] * factor;
        image.data[4 * (y * size + x) + c] = 255 * Math.min(1, Math.max(0, value)) ** (1 / 2.2);
      }
  context.putImageData(image, 0, 0);
  return canvas.toDataURL("image/png");
}

/**
 * What a renderer shows of a file.
 *
 * @param changes { switches, objects, orthographic, fog, frames }; objects: the
 *   asset turned, a clone of it, and an instance with a light of its own
 */
export async function draw(renderer, file, changes = {}) {
  const { switches, objects = false, orthographic = false, fog = false, frames = 1 } = changes;
  const { scene: root, userData } = await load(file);
  const asset = userData.lambent;
  const light = makeLight();
  asset.setLight(light);
  Object.assign(asset, switches);
  const scene = new THREE.Scene().add(root);
  if (fog) scene.fog = new THREE.Fog(0x804020, 4, 9);
  const made = [asset];
  if (objects) {
    root.position.set(-0.5, 0, 0);
    root.rotation.y = 0.7;
    root.scale.setScalar(0.6);
    const copy = root.clone();
    copy.position.set(0.8, 0.5, -0.5);
    copy.rotation.z = 0.5;
    const other = asset.instantiate();
    other.root.position.set(0, 1.1, 0.3);
    const turn = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), 1.3);
    other.setLight(makeLight().rotate(turn));
    scene.add(copy, other.root);
    made.push(lambent.LambentAsset.of(copy), other);
  }
  const camera = makeCamera(orthographic);
  const sum = new Float32Array(4 * size * size);
  asset.samples = frames;
  for (let i = 0; i < frames; ++i) {
    asset.sample = i;
    for (const each of made) each.update(renderer, camera);
    const shown = await pixels(renderer, scene, camera);
    shown.forEach((v, k) => (sum[k] += v / frames));
  }
  for (const each of made.reverse()) each.dispose();
  return sum;
}

Object.assign(window, {
  ...{ THREE, lambent, nodes, load, makeRenderer, makeLight, makeCamera, pixels, apart },
  ...{ WebGPURenderer, draw, thrown, pictureOf, size },
});
window.ready = true;
