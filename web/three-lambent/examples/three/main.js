// A baked asset on a page: orbit it with the mouse, and its light goes round it.
//
//   lambent bake model.glb -o baked.glb --keep-shadowed
//   npm install three three-lambent && npx vite
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { frameAutomatically, LambentLight, LambentLoaderPlugin } from "three-lambent";

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.toneMapping = THREE.NeutralToneMapping;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x223344);
const camera = new THREE.PerspectiveCamera();
const controls = new OrbitControls(camera, renderer.domElement);

const loader = new GLTFLoader().register((parser) => new LambentLoaderPlugin(parser));
const gltf = await loader.loadAsync("baked.glb");
const asset = gltf.userData.lambent;
scene.add(gltf.scene);

// A sky that is brighter above, and a large lamp; as many bands as the asset has.
const light = new LambentLight(asset.info.bands);
const up = new THREE.Vector3(0, 1, 0);
const lamp = new THREE.Vector3(1, 0.8, 0);
/** @type {import("three-lambent").Disc[]} */
const discs = [
  { direction: up, diameter: Math.PI, radiance: [0.25, 0.35, 0.5] },
  { direction: lamp, diameter: 0.6, radiance: [9, 8, 6] },
];
asset.setLight(light);

function frame() {
  lamp.applyAxisAngle(up, 0.01);
  light.scale(0);
  for (const disc of discs) light.addDisc(disc);
  asset.setEnvironment({ discs }); // what mirrors show where they do not see the asset
  controls.update();
  asset.update(renderer, camera); // relights, if light or asset have changed
  renderer.render(scene, camera);
}

function resize() {
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener("resize", resize);
resize();
controls.target.copy(frameAutomatically(gltf.scene, camera, camera.aspect));
renderer.setAnimationLoop(frame);
