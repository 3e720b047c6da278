// The page of the tests of assets as objects of three's: loads assets, draws them in scenes of its
// own, and hands back pixels.
import * as THREE from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import * as SkeletonUtils from "three/addons/utils/SkeletonUtils.js";
import * as lambent from "three-lambent";

const size = 128;

export async function load(url, incident = "auto") {
  const loader = new GLTFLoader();
  loader.register((parser) => new lambent.LambentLoaderPlugin(parser, { incident }));
  return loader.loadAsync(url);
}

export function makeRenderer(options = {}) {
  const made = new THREE.WebGLRenderer({ antialias: false, ...options });
  made.setPixelRatio(1);
  made.setSize(size, size);
  return made;
}

/** A light with a direction, in five bands. */
export function makeLight() {
  const light = lambent.LambentLight.uniform([0.2, 0.3, 0.4], 5);
  light.addDisc({ direction: { x: 0.5, y: 1, z: 0.7 }, diameter: 0.8, radiance: [9, 7, 5] });
  const direction = { x: -1, y: 0.2, z: 0 };
  return light.addDisc({ direction, diameter: 1.2, radiance: [0.3, 1, 3] });
}

export function makeCamera(height = 2.5, distance = 8) {
  const camera = new THREE.PerspectiveCamera(35, 1, 0.5, 40);
  camera.position.set(0, height, distance);
  camera.lookAt(0, 0.5, 0);
  return camera;
}

/** Linear pixels, four floats each. */
export function pixels(renderer, scene, camera, clear = [0, 0]) {
  const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.setClearColor(...clear);
  renderer.clear();
  renderer.render(scene, camera);
  renderer.setRenderTarget(null);
  const out = new Float32Array(4 * size * size);
  renderer.readRenderTargetPixels(target, 0, 0, size, size, out);
  target.dispose();
  return out;
}

/** How far pictures are apart: in the mean and at most; and how bright the first is. */
export function apart(a, b) {
  let [sum, most, light, count] = [0, 0, 0, 0];
  for (let i = 0; i < a.length; ++i) {
    const difference = Math.abs(a[i] - b[i]);
    sum += difference;
    most = Math.max(most, difference);
    if (i % 4 !== 3 && a[4 * (i >> 2) + 3] > 0) {
      light += a[i];
      ++count;
    }
  }
  const mean = sum / a.length;
  return { mean, most, light: light / Math.max(1, count), covered: count / a.length };
}

/** What is said on the console while something is done. */
export async function heard(what) {
  const said = [];
  const { warn } = console;
  console.warn = (...words) => said.push(words.join(" "));
  try {
    await what();
  } finally {
    console.warn = warn;
  }
  return said;
}

/** What an error says; "" without one. */
export async function thrown(what) {
  try {
    await what();
    return "";
  } catch (error) {
    return `${error.name}: ${error.message}`;
  }
}

/** As a program frees what it knows nothing of. */
export function freeAll(root) {
  root.traverse((object) => {
    if (!object.isMesh) return;
    object.geometry.dispose();
    for (const value of Object.values(object.material)) if (value?.isTexture) value.dispose();
    object.material.dispose();
  });
}

export const counts = (renderer) => ({
  ...renderer.info.memory,
  programs: renderer.info.programs.length,
});

/** A picture as a PNG's URL, brightened. */
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

Object.assign(window, {
  ...{ THREE, GLTFExporter, SkeletonUtils, lambent, load, makeRenderer, makeLight, makeCamera },
  ...{ pixels, apart, heard, thrown, freeAll, counts, pictureOf, size },
});
window.renderer = makeRenderer();
window.ready = true;
