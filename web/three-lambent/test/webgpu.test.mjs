// Three's WebGPURenderer, on both of its back ends, draws what WebGLRenderer does, by nodes of
// three-lambent/webgpu; what it cannot draw it refuses, with the remedy.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import { glossyScene, leafScene, mattScene, mirrorScene, texelScene } from "./support/scenes.mjs";
import { bakePatch, lambent, noTool } from "./support/tool.mjs";

const page = readFileSync(new URL("page/webgpu.js", import.meta.url), "utf8");
const sample = readFileSync(new URL("../../../spec/samples/unoccluded-square.glb", import.meta.url));
// One rasteriser for all: pictures then differ by rounding alone.
const kFlags = [
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
];
const keep = process.env.LAMBENT_KEEP_PICTURES;

/** By how much pictures may differ, of 255; `above`: pixels that differ by more than 2. */
const kBounds = { mean: 0.02, above: 5e-4 };

describe("WebGPURenderer", { skip: noTool }, () => {
  let folder;
  let browser;

  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "three-lambent-"));
    const quick = ["--directions", 128, "--bounces", 1, "--quiet"];
    const bakes = {
      matt: [mattScene],
      glossy: [glossyScene, "--encoding", "float32", "--keep-shadowed"],
      leaf: [leafScene],
      mirror: [mirrorScene],
      texel: [texelScene, "--texels", "sheet=24x20"],
    };
    for (const [name, [bytes, ...options]] of Object.entries(bakes)) {
      writeFileSync(join(folder, `${name}-scene.glb`), bytes);
      lambent(folder, "bake", `${name}-scene.glb`, "-o", `${name}.glb`, ...quick, ...options);
    }
    bakePatch(folder);
    writeFileSync(join(folder, "square.glb"), sample);
    browser = await openPage({ script: await bundle(page), folder, flags: kFlags });
    await browser.page.waitForFunction("window.ready");
    await browser.page.evaluate(async () => {
      window.renderers = {};
      for (const kind of ["webgl", "webgpu", "fallback"])
        window.renderers[kind] = await window.makeRenderer(kind);
    });
    browser.problems(); // of a device without WebGPU
  });
  after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true });
  });

  for (const kind of ["webgpu", "fallback"])
    describe(kind === "webgpu" ? "on WebGPU" : "on WebGL 2", () => {
      /** Whether there is such a device. Where Chromium has no WebGPU the test says so. */
      async function has(test) {
        const there = await browser.page.evaluate((kind) => !!window.renderers[kind], kind);
        assert.ok(there || kind === "webgpu", "WebGPURenderer has no WebGL 2");
        if (!there) test.skip("this Chromium has no WebGPU adapter: the other back end alone is tested");
        return there;
      }

      async function agrees(test, file, changes = {}, bounds = kBounds) {
        if (!(await has(test))) return;
        const found = await browser.page.evaluate(
          async ({ kind, file, changes }) => {
            const { draw, renderers, apart, pictureOf } = window;
            const now = await draw(renderers[kind], file, changes);
            const truth = await draw(renderers.webgl, file, changes);
            const pictures = { now: pictureOf(now), truth: pictureOf(truth) };
            return { ...apart(now, truth), pictures };
          },
          { kind, file, changes },
        );
        if (keep)
          for (const [name, url] of Object.entries(found.pictures)) {
            const stem = test.name.replace(/\W+/g, "-");
            const bytes = Buffer.from(url.split(",")[1], "base64");
            writeFileSync(join(keep, `${kind}-${stem}-${name}.png`), bytes);
          }
        delete found.pictures;
        console.log(`${kind}, ${test.name}: ${JSON.stringify(found)}`);
        assert.deepEqual(browser.problems(), []);
        assert.ok(found.light > 5, JSON.stringify(found));
        assert.ok(found.mean < bounds.mean, JSON.stringify(found));
        assert.ok(found.above <= bounds.above, JSON.stringify(found));
      }

      it("matt, with a texture", (test) => agrees(test, "matt.glb"));
      it("matt, of three channels, without shadows, by an orthographic camera", (test) =>
        agrees(test, "matt.glb", { switches: { transfer: "unshadowed" }, orthographic: true }));
      it("glossy", (test) => agrees(test, "glossy.glb"));
      it("glossy, its lobes as they are, shadowed, behind fog", (test) => {
        const switches = { softLobes: false, transfer: "shadowed", lobeExponent: 20 };
        return agrees(test, "glossy.glb", { switches, fog: true });
      });
      it("texels, matt and glossy", (test) => agrees(test, "texel.glb"));
      it("masks", (test) => agrees(test, "leaf.glb"));
      it("vectors of a sample", (test) => agrees(test, "square.glb"));
      it("unlit, of all kinds", async (test) => {
        const changes = { switches: { unlit: true } };
        for (const file of ["glossy.glb", "mirror.glb"]) await agrees(test, file, changes);
      });
      it("a clone, and an instance with a light of its own", (test) =>
        agrees(test, "matt.glb", { objects: true }));
    });
});
