// The page of the picture tests: loads an asset, sets it up as it is told, draws it as the tool does,
// and compares with the tool's picture.
import * as THREE from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import * as lambent from "three-lambent";

const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
document.body.appendChild(renderer.domElement);

export async function load(url, incident = "auto") {
  const loader = new GLTFLoader();
  loader.register((parser) => new lambent.LambentLoaderPlugin(parser, { incident }));
  return loader.loadAsync(url);
}

async function environmentOf(url) {
  return new EXRLoader().setDataType(THREE.FloatType).loadAsync(url);
}

async function pixelsOf(url) {
  const bitmap = await createImageBitmap(await (await fetch(url)).blob(), {
    colorSpaceConversion: "none",
    premultiplyAlpha: "none",
  });
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext("2d");
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
}

function shown(size) {
  const bytes = new Uint8Array(4 * size * size);
  const gl = renderer.getContext();
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  const out = new Uint8ClampedArray(bytes.length); // top row first
  for (let y = 0; y < size; ++y)
    out.set(bytes.subarray((size - 1 - y) * 4 * size, (size - y) * 4 * size), y * 4 * size);
  return out;
}

const skies = lambent.LambentSky.load("sky.bin");
const airs = lambent.LambentAir.load("air.bin");

/** Draws what `state` says; returns what is on the canvas, and which pixels the asset covers. */
async function draw(state) {
  const { size = 256, environment, light: lightUrl, discs = [] } = state;
  renderer.setPixelRatio(1);
  renderer.setSize(size, size);
  const gltf = await load(state.asset, state.incident);
  const asset = gltf.userData.lambent;
  const scene = new THREE.Scene();
  scene.add(gltf.scene);
  const camera = new THREE.PerspectiveCamera();
  if (state.camera) {
    const { position, target, verticalFov } = state.camera;
    camera.fov = verticalFov;
    camera.position.set(...position);
    camera.lookAt(...target);
    camera.updateProjectionMatrix();
  } else lambent.frameAutomatically(gltf.scene, camera, 1);

  const turned = new THREE.Quaternion(...(state.objectRotation ?? [0, 0, 0, 1]));
  const moved = new THREE.Vector3(...(state.objectTranslation ?? [0, 0, 0]));
  const worldFromEnvironment = new THREE.Quaternion(...(state.environmentRotation ?? [0, 0, 0, 1]));
  // The whole of it is moved, and the camera with it: the picture is that of a light that is
  // turned the other way.
  gltf.scene.quaternion.copy(turned);
  gltf.scene.position.copy(moved);
  camera.position.applyQuaternion(turned).add(moved);
  camera.quaternion.premultiply(turned);
  camera.updateMatrixWorld();
  lambent.fitClipping(camera, gltf.scene);

  const map = environment ? await environmentOf(environment) : null;
  const bands = asset.info.bands;
  let light = new lambent.LambentLight(bands);
  if (map)
    light = lambent.LambentLight.fromEquirectangular(map, bands).rotate(worldFromEnvironment);
  if (lightUrl) light.add(lambent.LambentLight.fromJson(await (await fetch(lightUrl)).json()));
  for (const disc of discs) light.addDisc(disc);
  const sky = state.sky ? (await skies).at(state.sky) : null;
  if (sky) light.add(sky.light(bands));
  asset.setLight(light);
  const around = sky?.environment ?? { texture: map, rotation: worldFromEnvironment, discs };
  asset.setEnvironment(around);
  if (state.sharpSun) asset.setSun(lambent.sunOf(around.discs));
  const air = state.air ? (await airs).under(sky) : null;
  if (air) asset.setAir(air, state.air);
  Object.assign(asset, state.asset_ ?? {});
  asset.update(renderer, camera);

  const target = new THREE.WebGLRenderTarget(size, size, {
    type: THREE.FloatType,
    minFilter: THREE.NearestFilter,
    magFilter: THREE.NearestFilter,
    samples: 0,
  });
  const drawInto = () => {
    renderer.setRenderTarget(target);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
  };
  drawInto();
  const floats = new Float32Array(4 * size * size);
  renderer.readRenderTargetPixels(target, 0, 0, size, size, floats);
  const covered = new Uint8Array(size * size);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x)
      covered[y * size + x] = floats[4 * ((size - 1 - y) * size + x) + 3] > 0 ? 1 : 0;
  let background = null;
  if (state.background) {
    background = new lambent.EnvironmentBackground(around);
    background.setAsset(asset);
    scene.add(background);
    drawInto();
  }
  const mapper = new lambent.ToneMapper();
  mapper.exposure = state.exposure ?? 0;
  mapper.curve = state.tone ?? "filmic";
  mapper.render(renderer, target.texture);
  const bytes = shown(size);

  const error = renderer.getContext().getError();
  background?.dispose();
  mapper.dispose();
  target.dispose();
  map?.dispose();
  sky?.dispose();
  air?.dispose();
  asset.dispose();
  return { bytes, covered, error, memory: { ...renderer.info.memory } };
}

/** The mean absolute difference to the tool's PNG, in 1/255: of all pixels, and of the asset's. */
export async function compare(state) {
  const { bytes, covered, error, memory } = await draw(state);
  const truth = await pixelsOf(state.truth);
  let all = 0;
  let own = 0;
  let brightness = 0;
  let count = 0;
  for (let p = 0; p < covered.length; ++p) {
    let difference = 0;
    for (let c = 0; c < 3; ++c) difference += Math.abs(bytes[4 * p + c] - truth[4 * p + c]) / 3;
    all += difference;
    if (!covered[p]) continue;
    own += difference;
    ++count;
    for (let c = 0; c < 3; ++c) brightness += truth[4 * p + c] / 3;
  }
  return {
    all: all / covered.length,
    own: own / Math.max(1, count),
    brightness: brightness / Math.max(1, count),
    covered: count / covered.length,
    error,
    memory,
    picture: renderer.domElement.toDataURL("image/png"),
  };
}

/**
 * What a choice changes here and in the tool's PNGs, mean absolute in 1/255: in theirs, and how far the two
 * changes are apart.
 */
export async function compareChange(before, after) {
  const [here, there] = [[], []];
  for (const state of [before, after]) {
    here.push((await draw(state)).bytes);
    there.push(await pixelsOf(state.truth));
  }
  let change = 0;
  let apart = 0;
  for (let i = 0; i < here[0].length; ++i) {
    const right = there[1][i] - there[0][i];
    change += Math.abs(right);
    apart += Math.abs(here[1][i] - here[0][i] - right);
  }
  return { change: change / here[0].length, apart: apart / here[0].length };
}

window.compare = compare;
window.compareChange = compareChange;
window.draw = draw;
window.THREE = THREE;
window.lambent = lambent;
window.load = load;
window.renderer = renderer;
window.environmentOf = environmentOf;
window.probes = import("three/addons/lights/LightProbeGenerator.js");
window.ready = true;
