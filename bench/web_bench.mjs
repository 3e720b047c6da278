// What relighting costs on the page: times of a frame as ratios to the same mesh drawn unlit (its
// base colour alone), measured in one run, for every kind of asset; with light that moves in each
// frame, and with light that stands still while the camera moves.
//
// usage: node web_bench.mjs OUT.csv     (LAMBENT_TOOL, LAMBENT_WEB_MODULES as in tests/web/viewer)
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
  texelScene,
} from "../web/three-lambent/test/support/scenes.mjs";
import { launch, openPage, serve, tool } from "../tests/web/viewer/session.mjs";

const [output] = process.argv.slice(2);
if (!output) {
  console.error("usage: node web_bench.mjs OUT.csv");
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

const folder = mkdtempSync(join(tmpdir(), "lambent-bench-"));
const lambent = (...args) => execFileSync(tool, [...args.map(String), "--quiet"], { cwd: folder });
const put = (name, bytes) => writeFileSync(join(folder, name), bytes);
put("light.exr", environmentExr);
const bake = (name, scene, ...more) => {
  put(`${name}-scene.glb`, scene);
  lambent("bake", `${name}-scene.glb`, "-o", `${name}.glb`, "--directions", 256, "--bounces", 1, ...more);
};
bake("diffuse", mattScene);
bake("glossy", glossyScene);
bake("texels", texelScene, "--texels", "sheet=48x40");
bake("mirror", mirrorScene);
// Every matrix counts in a frame, whatever was simulated: unshadowed ones take no time to make.
bake("glossy-100000-vertices", torus(400, 250), "--transfer", "unshadowed");
put("ball-scene.glb", ballScene);
lambent("rtt", "weave", "-o", "patch.rtt", "--positions", "32x32", "--views", 4, "--directions", 128);
lambent("synthesize", "ball-scene.glb", "--rtt", "patch.rtt", "-o", "bi-scale.glb", "--mesh", "ball",
  "--directions", 256, "--map-size", 512, "--vertices", 8000);

const browser = await launch();
const rows = ["kind,what,renderer,width,height,vertices,frame_ms,ratio_to_unlit,cpu_ms"];
for (const kind of ["diffuse", "glossy", "texels", "mirror", "bi-scale", "glossy-100000-vertices"]) {
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
}
await browser.close();
rmSync(folder, { recursive: true });
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, rows.join("\n") + "\n");
