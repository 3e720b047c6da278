// Renderers as programs make them: their depth buffers reversed or logarithmic, and pictures the
// same.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import { leafScene, mattScene, mirrorsScene } from "./support/scenes.mjs";
import { lambent, noTool } from "./support/tool.mjs";

describe("renderers", { skip: noTool }, () => {
  let folder;
  let browser;
  const keep = process.env.LAMBENT_KEEP_PICTURES;

  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "three-lambent-"));
    const quick = ["--directions", 128, "--bounces", 1, "--keep-shadowed", "--quiet"];
    const scenes = { matt: mattScene, mirrors: mirrorsScene, leaf: leafScene };
    for (const [name, bytes] of Object.entries(scenes)) {
      writeFileSync(join(folder, `${name}-scene.glb`), bytes);
      lambent(folder, "bake", `${name}-scene.glb`, "-o", `${name}.glb`, ...quick);
    }
    const script = await bundle(readFileSync(new URL("page/objects.js", import.meta.url), "utf8"));
    browser = await openPage({ script, folder });
    await browser.page.waitForFunction("window.ready");
  });
  after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true });
  });

  for (const file of ["matt.glb", "mirrors.glb", "leaf.glb"])
    it(`${file}: a sharp Sun, mirrors and a background, whatever the depth buffer`, async () => {
      const found = await browser.page.evaluate(async (file) => {
        const { THREE, lambent, load, makeRenderer, pixels, apart } = window;
        const draw = async (options, sunny = true) => {
          const renderer = makeRenderer(options);
          const { scene: root, userData } = await load(file);
          const asset = userData.lambent;
          const sun = { direction: new THREE.Vector3(1, 1.5, 0.4), diameter: 0.01 };
          const disc = { ...sun, radiance: [60000, 50000, 40000] };
          const around = { texture: null, uniform: [0.3, 0.5, 0.8] };
          asset.setLight(window.makeLight().addDisc(disc));
          asset.setSun(sunny ? disc : null);
          asset.setEnvironment(around);
          asset.mirrorSize = 48;
          const background = new lambent.EnvironmentBackground(around);
          const scene = new THREE.Scene().add(root, background);
          // Something of three's own between.
          const post = new THREE.Mesh(
            new THREE.BoxGeometry(0.1, 2, 0.1).translate(0.3, 1, 0.2),
            new THREE.MeshBasicMaterial({ color: 0xff8800 }),
          );
          scene.add(post);
          const camera = window.makeCamera(2.5, 6);
          let shown;
          for (let i = 0; i < 2; ++i) {
            asset.update(renderer, camera);
            shown = pixels(renderer, scene, camera);
          }
          const { reversedDepthBuffer } = renderer.capabilities;
          const error = renderer.getContext().getError();
          background.dispose();
          asset.dispose();
          post.geometry.dispose();
          post.material.dispose();
          renderer.dispose();
          return { shown, reversedDepthBuffer, error };
        };
        const ordinary = await draw({});
        const reversed = await draw({ reversedDepthBuffer: true });
        const logarithmic = await draw({ logarithmicDepthBuffer: true });
        const soft = await draw({}, false);
        const stem = file.replace(".glb", "");
        return {
          can: reversed.reversedDepthBuffer,
          errors: [ordinary, reversed, logarithmic].map(({ error }) => error),
          reversed: apart(ordinary.shown, reversed.shown),
          logarithmic: apart(ordinary.shown, logarithmic.shown),
          soft: apart(ordinary.shown, soft.shown),
          pictures: {
            [`${stem}-ordinary`]: window.pictureOf(ordinary.shown, 0.15),
            [`${stem}-reversed`]: window.pictureOf(reversed.shown, 0.15),
          },
        };
      }, file);
      if (keep)
        for (const [name, url] of Object.entries(found.pictures))
          writeFileSync(join(keep, `${name}.png`), Buffer.from(url.split(",")[1], "base64"));
      delete found.pictures;
      console.log(`${file}: ${JSON.stringify(found)}`);
      assert.deepEqual(browser.problems(), []);
      assert.deepEqual(found.errors, [0, 0, 0]);
      assert.ok(found.can, "this device reverses depths");
      for (const how of ["reversed", "logarithmic"])
        assert.ok(found[how].mean < 2e-3 * found.soft.light, JSON.stringify(found));
      assert.ok(found.soft.mean > 10 * found.reversed.mean, JSON.stringify(found));
    });
});
