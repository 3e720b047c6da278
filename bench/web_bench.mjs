// What relighting costs on the page: times of a frame as ratios to the same mesh drawn unlit (its
// base colour alone), measured in one run, for every kind of asset; with light that moves in each
// frame, and with light that stands still while the camera moves.
//
// usage: node web_bench.mjs OUT.csv [KIND…]     (LAMBENT_TOOL, LAMBENT_WEB_MODULES as in tests/web/viewer)
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { sceneGlb } from "../web/three-lambent/test/support/glb.mjs";
import {
  ballScene,
  environmentExr,
  glossyScene,
  mattScene,
  mirrorScene,
  mirrorsScene,
  texelScene,
} from "../web/three-lambent/test/support/scenes.mjs";
import { launch, openPage, serve, tool } from "../tests/web/viewer/session.mjs";

const [output, ...chosen] = process.argv.slice(2);
if (!output) {
  console.error("usage: node web_bench.mjs OUT.csv [KIND…]");
  process.exit(2);
}
const kFrames = 20;
const kRounds = 5; // the median of them is kept

/** A torus of rows × columns quads. */
function torus(rows, columns) {
  const mesh = { name: "torus", positions: [], normals: [], indices: [], material: 0 };
  for (let r = 0; r < rows; ++r)
    for (let c = 0; c < columns; ++c) {
      const [a, b] = [(2 * Math.PI * r) / rows, (2 * Math.PI * c) / columns];
      const normal = [Math.cos(b) * Math.cos(a), Math.sin(b), -Math.cos(b) * Math.sin(a)];
      mesh.normals.push(...normal);
      mesh.positions.push(Math.cos(a) + 0.4 * normal[0], 0.4 * normal[1], -Math.sin(a) + 0.4 * normal[2]);
      const at = (i, j) => (i % rows) * columns + (j % columns);
      mesh.indices.push(at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c), at(r + 1, c + 1), at(r, c + 1));
    }
  const pbrMetallicRoughness = { baseColorFactor: [0.7, 0.7, 0.7, 1], metallicFactor: 0.5, roughnessFactor: 0.5 };
  return sceneGlb([mesh], [{ pbrMetallicRoughness }]);
}

/** Hills of 40 × 40 units, a camera's height above 0 in the middle of one side. */
function hills(cells) {
  const mesh = { name: "hills", positions: [], normals: [], indices: [], material: 0 };
  const height = (x, z) => Math.sin(0.7 * x) * Math.cos(0.5 * z) + 0.4 * Math.sin(1.9 * x + 1.3 * z);
  for (let j = 0; j <= cells; ++j)
    for (let i = 0; i <= cells; ++i) {
      const [x, z] = [40 * (i / cells - 0.5), 40 * (j / cells - 0.5)];
      const e = 1e-3;
      const n = [height(x - e, z) - height(x + e, z), 2 * e, height(x, z - e) - height(x, z + e)];
      const length = Math.hypot(...n);
      mesh.positions.push(x, height(x, z), z);
      mesh.normals.push(...n.map((each) => each / length));
      if (i === cells || j === cells) continue;
      const at = j * (cells + 1) + i;
      mesh.indices.push(at, at + cells + 1, at + 1, at + 1, at + cells + 1, at + cells + 2);
    }
  const pbrMetallicRoughness = { baseColorFactor: [0.5, 0.6, 0.4, 1], metallicFactor: 0, roughnessFactor: 1 };
  return sceneGlb([mesh], [{ pbrMetallicRoughness }]);
}

const folder = mkdtempSync(join(tmpdir(), "lambent-bench-"));
const lambent = (...args) => execFileSync(tool, [...args.map(String), "--quiet"], { cwd: folder });
const put = (name, bytes) => writeFileSync(join(folder, name), bytes);
put("light.exr", environmentExr);
const wanted = (kind) => chosen.length === 0 || chosen.includes(kind);
const bake = (name, scene, ...more) => {
  if (!wanted(name)) return;
  put(`${name}-scene.glb`, scene);
  lambent("bake", `${name}-scene.glb`, "-o", `${name}.glb`, "--directions", 256, "--bounces", 1, ...more);
};
bake("diffuse", mattScene);
bake("glossy", glossyScene);
bake("texels", texelScene, "--texels", "sheet=48x40");
bake("mirror", mirrorScene);
bake("two-mirrors", mirrorsScene);
// Every matrix counts in a frame, whatever was simulated: unshadowed ones take no time to make.
bake("glossy-100000-vertices", torus(400, 250), "--transfer", "unshadowed");
bake("landscape", hills(120), "--transfer", "shadowed");
if (wanted("bi-scale")) {
  put("ball-scene.glb", ballScene);
  lambent("rtt", "weave", "-o", "patch.rtt", "--positions", "32x32", "--views", 4, "--directions", 128);
  lambent("synthesize", "ball-scene.glb", "--rtt", "patch.rtt", "-o", "bi-scale.glb", "--mesh", "ball",
    "--directions", 256, "--map-size", 512, "--vertices", 8000);
}

/**
 * What the Sun's shadow, the air and its shafts cost where half of the picture is the sky's: `z`, where
 * the camera stands. From one side near hills are drawn over far ones, from the other behind them.
 */
async function landscape(name, z) {
  const server = await serve(folder, ["landscape.glb"]);
  const { page, context } = await openPage(browser, server.url, {
    viewport: { width: 640, height: 480 },
  });
  await page.keyboard.press("h");
  const found = await page.evaluate(
    async ({ frames, rounds, z }) => {
      const { viewer, showView } = window.lambent;
      const camera = { position: [0, 2.5, z], target: [0, 2.2, 0], verticalFov: 50 };
      const environment = { source: "sky:sun-elevation=20,sun-azimuth=200" };
      await showView({ lambent: "view", camera, environment, exposure: -4 });
      await viewer.sky.showAir(true);
      const stage = viewer.current;
      const gl = stage.renderer.getContext();
      const pixel = new Uint8Array(4);
      const run = ({ sun = "soft", air = null, empty = false, unlit = false }) => {
        stage.apply({ ...structuredClone(viewer.view), sunShadow: sun }, unlit, air);
        stage.loaded.asset.root.visible = !empty;
        const began = performance.now();
        for (let i = 0; i < frames; ++i) {
          stage.drawMoving({ ...viewer.camera(), position: [1e-4 * i, 2.5, z] });
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        }
        return (performance.now() - began) / frames;
      };
      const through = (shafts) => ({ metresPerUnit: 1000, shafts });
      const ways = {
        unlit: { unlit: true },
        "the sky alone": { empty: true },
        "without air": {},
        "through the air": { air: through(false) },
        "a sharp Sun": { sun: "sharp" },
        "a sharp Sun, through the air": { sun: "sharp", air: through(false) },
        "a sharp Sun and its shafts": { sun: "sharp", air: through(true) },
      };
      const times = Object.fromEntries(Object.keys(ways).map((way) => [way, []]));
      for (const way of Object.values(ways)) run(way);
      for (let round = 0; round < rounds; ++round)
        for (const [name, way] of Object.entries(ways)) times[name].push(run(way));
      const info = gl.getExtension("WEBGL_debug_renderer_info");
      return {
        renderer: gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER),
        vertices: stage.loaded.asset.info.vertices,
        times: Object.fromEntries(
          Object.entries(times).map(([way, all]) => [way, all.sort((a, b) => a - b)[all.length >> 1]])),
      };
    },
    { frames: 6, rounds: kRounds, z },
  );
  await context.close();
  await server.stop();
  const { times } = found;
  for (const [way, frame] of Object.entries(times)) {
    rows.push([name, way, `"${found.renderer}"`, 640, 480, found.vertices, frame.toFixed(3),
      (frame / times.unlit).toFixed(2), ""].join(","));
    console.log(`${name}, ${way}: ${frame.toFixed(2)} ms`);
  }
  console.log(`${name}: through the air ${(times["through the air"] / times["without air"]).toFixed(2)} × ` +
    "without it");
}

const browser = await launch();
const rows = ["kind,what,renderer,width,height,vertices,frame_ms,ratio_to_unlit,cpu_ms"];
for (const kind of ["diffuse", "glossy", "texels", "mirror", "two-mirrors", "bi-scale", "glossy-100000-vertices"]) {
  if (!wanted(kind)) continue;
  const server = await serve(folder, [`${kind}.glb`, "light.exr"]);
  const { page, context } = await openPage(browser, server.url, {
    viewport: { width: 640, height: 480 },
  });
  await page.keyboard.press("h");
  const found = await page.evaluate(
    async ({ frames, rounds }) => {
      const { viewer } = window.lambent;
      viewer.change((view) => (view.background = false));
      await viewer.settled();
      const stage = viewer.current;
      const { asset } = stage.loaded;
      const gl = stage.renderer.getContext();
      const view = structuredClone(viewer.view);
      const pixel = new Uint8Array(4);
      const camera = viewer.camera();
      let turn = 0;
      /** Milliseconds of a frame until a pixel of it can be read, and of the page's own work. */
      const measure = (moveLight) => {
        const began = performance.now();
        let work = 0;
        for (let i = 0; i < frames; ++i) {
          const start = performance.now();
          if (moveLight) {
            turn += 0.01;
            view.environment.rotation = [0, Math.sin(turn), 0, Math.cos(turn)];
            stage.apply(view);
          }
          stage.drawMoving({ ...camera, position: camera.position.map((each) => each + 1e-4 * i) });
          work += performance.now() - start;
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        }
        return { frame: (performance.now() - began) / frames, work: work / frames };
      };
      const ways = {
        unlit: () => ((asset.unlit = true), measure(false)),
        "light stands still": () => ((asset.unlit = false), measure(false)),
        "light moves": () => ((asset.unlit = false), measure(true)),
      };
      // What it costs that mirrors see the asset: a look-up in each frame, captures where light moves.
      const environmentAlone = (moveLight) => {
        asset.unlit = false;
        const size = asset.mirrorSize;
        asset.mirrorSize = 0;
        const found = measure(moveLight);
        asset.mirrorSize = size;
        return found;
      };
      if (asset.kinds.has("mirror")) {
        ways["light stands still; environment alone"] = () => environmentAlone(false);
        ways["light moves; environment alone"] = () => environmentAlone(true);
      }
      const times = Object.fromEntries(Object.keys(ways).map((way) => [way, []]));
      for (const way of Object.values(ways)) way(); // shaders are compiled
      for (let round = 0; round < rounds; ++round)
        for (const [way, run] of Object.entries(ways)) times[way].push(run());
      asset.unlit = false;
      const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];
      const info = gl.getExtension("WEBGL_debug_renderer_info");
      return {
        renderer: gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER),
        width: gl.drawingBufferWidth,
        height: gl.drawingBufferHeight,
        vertices: asset.info.vertices,
        times: Object.fromEntries(
          Object.entries(times).map(([way, all]) => [
            way,
            { frame: median(all.map((each) => each.frame)), work: median(all.map((each) => each.work)) },
          ])),
      };
    },
    { frames: kFrames, rounds: kRounds },
  );
  await context.close();
  await server.stop();
  for (const [way, { frame, work }] of Object.entries(found.times)) {
    const ratio = frame / found.times.unlit.frame;
    rows.push([kind, way, `"${found.renderer}"`, found.width, found.height, found.vertices,
      frame.toFixed(3), ratio.toFixed(2), work.toFixed(3)].join(","));
    console.log(`${kind}, ${way}: ${frame.toFixed(2)} ms, ${ratio.toFixed(2)} × unlit; ` +
      `${work.toFixed(2)} ms of it on the CPU's side`);
  }
  for (const way of ["light stands still", "light moves"]) {
    const without = found.times[`${way}; environment alone`];
    if (without)
      console.log(`${kind}, ${way}: ${(found.times[way].frame / without.frame).toFixed(2)} × ` +
        "with mirrors that show the environment alone");
  }
}
if (wanted("landscape")) {
  await landscape("landscape far first", 19);
  await landscape("landscape near first", -19);
}
await browser.close();
rmSync(folder, { recursive: true });
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, rows.join("\n") + "\n");
