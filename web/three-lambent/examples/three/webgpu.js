// A baked asset by three's WebGPURenderer, on WebGPU or, where there is none, on WebGL 2.
//
//   lambent bake model.glb -o baked.glb
//   npm install three three-lambent && npx vite
import { Color, PerspectiveCamera, Scene, Vector3, WebGPURenderer } from "three/webgpu";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { frameAutomatically, LambentLight, LambentLoaderPlugin } from "three-lambent";
import { nodes } from "three-lambent/webgpu";

const renderer = new WebGPURenderer({ antialias: true });
document.body.append(renderer.domElement);
await renderer.init();

const loader = new GLTFLoader().register((parser) => new LambentLoaderPlugin(parser, { nodes }));
const gltf = await loader.loadAsync("baked.glb");
const asset = gltf.userData.lambent;
const scene = new Scene().add(gltf.scene);
scene.background = new Color(0x223344);
const camera = new PerspectiveCamera();

function resize() {
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  frameAutomatically(gltf.scene, camera, innerWidth / innerHeight);
}
addEventListener("resize", resize);
resize();

const light = LambentLight.uniform([0.25, 0.35, 0.5], asset.info.bands);
light.addDisc({ direction: new Vector3(1, 0.8, 0.4), diameter: 0.6, radiance: [9, 8, 6] });
asset.setLight(light);

renderer.setAnimationLoop(() => {
  gltf.scene.rotation.y += 0.01;
  asset.update(renderer, camera);
  renderer.render(scene, camera);
});
