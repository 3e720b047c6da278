// Three's WebGPURenderer, on both of its back ends, draws what WebGLRenderer does, by nodes of
// three-lambent/webgpu; what it cannot draw it refuses, with the remedy.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import { parseGlb, glb } from "./support/glb.mjs";
import { glossyScene, leafScene, mattScene, mirrorScene, texelScene } from "./support/scenes.mjs";
import { bakePatch, lambent, noTool } from "./support/tool.mjs";

const page = readFileSync(new URL("page/webgpu.js", import.meta.url), "utf8");
const readme = readFileSync(new URL("../README.md", import.meta.url), "utf8");
const manifest = JSON.parse(readFileSync(new URL("../package.json", import.meta.url), "utf8"));
const sample = readFileSync(new URL("../../../spec/samples/unoccluded-square.glb", import.meta.url));
// One rasteriser for all: pictures then differ by rounding alone.
const kFlags = [
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
];
const keep = process.env.LAMBENT_KEEP_PICTURES;

/** The leaf as a veil, which is there in a share of the sub-samples. */
const veilScene = (() => {
  const { json, bin } = parseGlb(leafScene);
  Object.assign(json.materials[0], { alphaMode: "BLEND" });
  return glb(json, bin);
})();

/**
 * By how much pictures may differ, of 255: in the mean, the share of pixels that differ by more than 2,
 * and the worst one. Derivatives at silhouettes are those of other pixels on WebGPU, whose rows run the
 * other way.
 */
const kBounds = {
  webgpu: { mean: 0.01, above: 3e-4, most: 255 },
  fallback: { mean: 1e-4, above: 0, most: 0.02 },
};

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
      veil: [veilScene],
    };
    for (const [name, [bytes, ...options]] of Object.entries(bakes)) {
      writeFileSync(join(folder, `${name}-scene.glb`), bytes);
      lambent(folder, "bake", `${name}-scene.glb`, "-o", `${name}.glb`, ...quick, ...options);
    }
    bakePatch(folder);
    writeFileSync(join(folder, "square.glb"), sample);
    for (const name of ["sky.bin", "air.bin"])
      writeFileSync(join(folder, name), readFileSync(new URL(`../data/${name}`, import.meta.url)));
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
        if (!there) test.skip("this Chromium has no WebGPU adapter: WebGL 2 alone is tested");
        return there;
      }

      async function agrees(test, file, changes = {}, bounds = kBounds[kind]) {
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
        assert.ok(found.most <= bounds.most, JSON.stringify(found));
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

      it("blends, in the mean of many sub-samples", (test) =>
        agrees(test, "veil.glb", { frames: 16 }, { mean: 0.5, above: 0.05, most: 80 }));

      it("names, colours and sides stay, and nothing of an asset is left after dispose()", async (test) => {
        if (!(await has(test))) return;
        const found = await browser.page.evaluate(async (kind) => {
          const { THREE, load, renderers, makeLight, makeCamera, pixels } = window;
          const renderer = renderers[kind];
          const memory = () => {
            const { geometries, textures } = renderer.info.memory;
            return { geometries, textures };
          };
          const once = async () => {
            const { scene: root, userData } = await load("glossy.glb");
            const asset = userData.lambent;
            asset.setLight(makeLight());
            const scene = new THREE.Scene().add(root);
            const camera = makeCamera();
            const [first, second] = [1, 2].map(() => asset.update(renderer, camera));
            await pixels(renderer, scene, camera);
            const { material } = root.children[0];
            const { isMeshStandardMaterial, side } = material;
            const during = memory();
            const other = asset.instantiate();
            other.update(renderer, camera);
            asset.dispose();
            // What is shared is there for who is left.
            scene.add(other.root);
            const left = (await pixels(renderer, scene, camera)).reduce((sum, v) => sum + v);
            other.dispose();
            const colour = material.color.getHexString();
            return { first, second, isMeshStandardMaterial, side, colour, during, left };
          };
          await once(); // what three itself keeps
          const before = memory();
          const seen = await once();
          return { ...seen, before, after: memory() };
        }, kind);
        assert.deepEqual(browser.problems(), []);
        assert.deepEqual([found.first, found.second], [true, false]);
        assert.equal(found.isMeshStandardMaterial, true);
        assert.equal(found.side, 0); // of a body
        assert.match(found.colour, /^(?!ffffff)/);
        assert.ok(found.left > 100);
        assert.ok(found.during.textures > found.before.textures);
        assert.deepEqual(found.after, found.before);
      });

      it("is advised as WebGLRenderer's programs are", async (test) => {
        if (!(await has(test))) return;
        const said = await browser.page.evaluate(async (kind) => {
          const { THREE, load, renderers, makeCamera, pixels } = window;
          const { scene: root, userData } = await load("matt.glb");
          const scene = new THREE.Scene().add(root, new THREE.DirectionalLight());
          userData.lambent.update(renderers[kind]);
          await pixels(renderers[kind], scene, makeCamera());
          userData.lambent.dispose();
        }, kind);
        assert.equal(said, undefined);
        const [words, ...rest] = browser.problems();
        assert.match(words, /has no light: three's own lights \(DirectionalLight\) do not reach it/);
        assert.deepEqual(rest, []);
      });

      it("refuses what there are no nodes for, in a sentence with the remedy", async (test) => {
        if (!(await has(test))) return;
        const found = await browser.page.evaluate(async (kind) => {
          const { THREE, lambent, load, renderers, thrown } = window;
          const renderer = renderers[kind];
          const refused = async (file, change = () => {}, options = undefined) => {
            const { userData } = await load(file, options);
            const asset = userData.lambent;
            change(asset);
            const words = await thrown(() => asset.update(renderer));
            asset.dispose();
            return words;
          };
          const disc = { direction: new THREE.Vector3(0, 1, 0), diameter: 0.01 };
          const sky = (await lambent.LambentSky.load("sky.bin")).at({ sunElevation: 0.5 });
          const air = (await lambent.LambentAir.load("air.bin")).under(sky);
          const mapper = new lambent.ToneMapper();
          return {
            plain: await refused("matt.glb", undefined, {}),
            mirrors: await refused("mirror.glb"),
            patches: await refused("patch.glb"),
            sun: await refused("matt.glb", (asset) =>
              asset.setSun({ ...disc, radiance: [1e4, 1e4, 1e4] }),
            ),
            air: await refused("matt.glb", (asset) => asset.setAir(air)),
            tone: await thrown(() => mapper.render(renderer, new THREE.Texture())),
          };
        }, kind);
        const expected = {
          plain: /^TypeError: .*without their nodes.*three-lambent\/webgpu.*or use THREE\.WebGLRenderer/,
          mirrors: /^Error: .*no mirrors here: use THREE\.WebGLRenderer/,
          patches: /no meso-structure here: use THREE\.WebGLRenderer/,
          sun: /no sharp Sun \(setSun\) here: use THREE\.WebGLRenderer/,
          air: /no air \(setAir\) here: use THREE\.WebGLRenderer/,
          tone: /^TypeError: .*ToneMapper cannot draw by WebGPURenderer.*toneMapping/,
        };
        for (const [name, words] of Object.entries(expected)) assert.match(found[name], words);
        assert.deepEqual(browser.problems(), []);
      });
    });

  it("the oldest three that the nodes are for, and one that is older", async () => {
    const { kOldestThree } = await import("../dist/webgpu/index.js");
    const { devDependencies } = manifest;
    assert.equal(devDependencies["three-nodes-oldest"], `npm:three@0.${kOldestThree}.0`);
    assert.match(readme, new RegExp(`three 0\\.${kOldestThree}\\.0`));
    const script = await bundle(page, "three-nodes-oldest");
    const older = script.replace(`REVISION = "${kOldestThree}"`, `REVISION = "${kOldestThree - 1}"`);
    assert.notEqual(older, script);
    for (const each of [script, older]) {
      const old = await openPage({ script: each, folder, flags: kFlags });
      try {
        await old.page.waitForFunction("window.ready");
        const found = await old.page.evaluate(async () => {
          const { makeRenderer, draw, apart, thrown } = window;
          const truth = await draw(await makeRenderer("webgl"), "texel.glb");
          const out = [];
          for (const kind of ["webgpu", "fallback"]) {
            const renderer = await makeRenderer(kind);
            let now = truth;
            const drawn = async () => (now = await draw(renderer, "texel.glb"));
            const refused = renderer && (await thrown(drawn));
            out.push({ refused, ...apart(now, truth) });
          }
          return { out, revision: window.THREE.REVISION };
        });
        console.log(JSON.stringify(found));
        for (const { refused, mean, light } of found.out) {
          if (refused === null) continue;
          if (each === script) assert.equal(refused, "");
          else assert.match(refused, /needs three 0\.\d+\.0 or later, and this is r\d+: update three/);
          assert.ok(light > 5 && mean < 1e-4, `${mean}`);
        }
      } finally {
        await old.close();
      }
    }
  });

  it("says that a renderer is not initialised, and what of the package it does not draw", async () => {
    const found = await browser.page.evaluate(async () => {
      const { THREE, WebGPURenderer, lambent, load, renderers, makeCamera, pixels, thrown } = window;
      const { userData } = await load("matt.glb");
      const refused = await thrown(() => userData.lambent.update(new WebGPURenderer()));
      const scene = new THREE.Scene().add(new lambent.EnvironmentBackground({ uniform: [1, 1, 1] }));
      for (let i = 0; i < 2; ++i) await pixels(renderers.fallback, scene, makeCamera());
      return refused;
    });
    assert.match(found, /before WebGPURenderer has a device: await renderer\.init\(\) first/);
    const said = browser.problems().filter((text) => /EnvironmentBackground/.test(text));
    assert.equal(said.length, 1);
  });
});
