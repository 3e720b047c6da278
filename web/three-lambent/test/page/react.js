// The page of react.test.mjs: components that are mounted, given other props and unmounted.
import { Component, createElement as h, StrictMode, useLayoutEffect } from "react";
import { createRoot } from "react-dom/client";
import { Canvas } from "@react-three/fiber";
import { Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { frameAutomatically, LambentLight } from "three-lambent";
import { extendLambent, LambentAsset } from "three-lambent/react";

const uniform = LambentLight.uniform([1, 1, 1], 5);
const side = new LambentLight(5).addDisc({
  direction: new Vector3(1, 0.2, 0),
  diameter: 0.5,
  radiance: [20, 20, 20],
});
const lights = { uniform, side };

let state;
let root;
let failure = null;
let generation = 0; // a boundary that failed is replaced when nothing is shown
let assets = new Set();

class Boundary extends Component {
  state = { failed: false };
  static getDerivedStateFromError = () => ({ failed: true });
  componentDidCatch(error) {
    failure = String(error);
  }
  render() {
    return this.state.failed ? null : this.props.children;
  }
}

let rendered = 0;
let committed = 0;

/** Tells when the canvas has the props of the render that it belongs to. */
function Committed({ number }) {
  useLayoutEffect(() => void (committed = number), [number]);
  return null;
}

async function render(children) {
  const number = ++rendered;
  const canvas = h(
    Canvas,
    {
      frameloop: "demand",
      flat: true,
      onCreated: (created) => (state = created),
    },
    h(Boundary, { key: generation }, ...children),
    h(Committed, { number }),
  );
  root.render(h(StrictMode, null, canvas));
  while (committed < number) await new Promise((done) => setTimeout(done, 5));
}

const propsOf = ({ light, ...rest }) => ({
  ...rest,
  light: light === undefined ? uniform : lights[light],
  environment: null, // darkness that is asked for
  onLoad: (asset) => assets.add(asset),
});

/** Mounts a canvas with one <LambentAsset> for each of `list`; light is named. */
globalThis.show = (list) => {
  root ??= createRoot(document.body.appendChild(document.createElement("div")));
  document.body.firstElementChild.style.cssText = "width:256px;height:256px";
  failure = null;
  if (list.length === 0) ++generation;
  return render(list.map((props, i) => h(LambentAsset, { key: i, ...propsOf(props) })));
};

/** Shows what somebody else has loaded. */
globalThis.showLoaded = async (url) => {
  const loader = new GLTFLoader();
  extendLambent(loader);
  const asset = (await loader.loadAsync(url)).userData.lambent;
  globalThis.given = asset;
  await render([
    h(LambentAsset, { key: "given", asset, light: uniform, environment: null, onLoad: (a) => assets.add(a) }),
  ]);
};

globalThis.waitForAssets = async (count) => {
  for (let i = 0; i < 500; ++i) {
    if (failure || assets.size >= count) break;
    await new Promise((done) => setTimeout(done, 20));
  }
  const found = assets.size;
  assets.clear();
  return { found, failure };
};

/** Renders what is mounted, by R3F's own loop; mean green of what is lit, left and right. */
globalThis.picture = async () => {
  const { gl, scene, camera, advance, size } = state;
  frameAutomatically(scene, camera, size.width / size.height);
  camera.updateMatrixWorld();
  advance(performance.now());
  const context = gl.getContext();
  const { drawingBufferWidth: w, drawingBufferHeight: hgt } = context;
  const pixels = new Uint8Array(4 * w * hgt);
  context.readPixels(0, 0, w, hgt, context.RGBA, context.UNSIGNED_BYTE, pixels);
  const halves = [
    { sum: 0, lit: 0 },
    { sum: 0, lit: 0 },
  ];
  for (let y = 0; y < hgt; ++y)
    for (let x = 0; x < w; ++x) {
      const green = pixels[4 * (y * w + x) + 1];
      if (green === 0) continue;
      const half = halves[x < w / 2 ? 0 : 1];
      half.sum += green;
      half.lit += 1;
    }
  return halves.map(({ sum, lit }) => sum / Math.max(lit, 1));
};

globalThis.memory = () => ({
  ...state.gl.info.memory,
  programs: state.gl.info.programs.length,
  objects: state.scene.children.length,
});
