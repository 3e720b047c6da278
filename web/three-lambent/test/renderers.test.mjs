// Renderers as programs make them, their depth buffers reversed or logarithmic, and of the oldest
// three that the package names: pictures are the same.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import { leafScene, mattScene, mirrorsScene } from "./support/scenes.mjs";
import { bakePatch, lambent, noTool } from "./support/tool.mjs";

const page = readFileSync(new URL("page/objects.js", import.meta.url), "utf8");
const manifest = JSON.parse(readFileSync(new URL("../package.json", import.meta.url), "utf8"));

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
    bakePatch(folder);
    browser = await openPage({ script: await bundle(page), folder });
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

  it("the oldest three that the package names", async () => {
    const { peerDependencies, devDependencies } = manifest;
    assert.equal(peerDependencies.three, `>=${devDependencies["three-oldest"].split("@")[1]}`);
    const script = await bundle(page, "three-oldest");
    const old = await openPage({ script, folder });
    try {
      await old.page.waitForFunction("window.ready");
      const shots = [];
      for (const { page, problems } of [browser, old]) {
        shots.push(await page.evaluate(drawAll));
        assert.deepEqual(problems(), []);
      }
      const [now, then] = shots;
      assert.equal(`>=0.${then.revision}.0`, peerDependencies.three);
      assert.notEqual(now.revision, then.revision);
      for (const file of ["matt.glb", "mirrors.glb", "patch.glb"]) {
        const [a, b] = [now[file], then[file]];
        const light = a.pixels.reduce((sum, v) => sum + v) / a.pixels.length;
        const mean =
          a.pixels.reduce((sum, v, i) => sum + Math.abs(v - b.pixels[i]), 0) / a.pixels.length;
        console.log(`${file}: ${mean} apart, where the mean is ${light}`);
        assert.ok(light > 0.05 && mean < 1e-3 * light, `${file}: ${mean}, ${light}`);
        assert.deepEqual(b.left, { geometries: 0, textures: 0, programs: 0 });
        assert.equal(b.error, 0);
      }
    } finally {
      await old.close();
    }
  });
});

/** In the page: an asset and a clone of it, with everything around them. */
async function drawAll() {
  const { THREE, lambent, load, renderer, pixels, counts } = window;
  const out = { revision: THREE.REVISION };
  for (const file of ["matt.glb", "mirrors.glb", "patch.glb"]) {
    const { scene: root, userData } = await load(file);
    const asset = userData.lambent;
    const copy = root.clone();
    copy.position.set(1.5, 0, -1);
    copy.rotation.y = 1;
    const disc = { direction: new THREE.Vector3(1, 1.5, 0.4), diameter: 0.01 };
    const sun = { ...disc, radiance: [60000, 50000, 40000] };
    const around = { texture: null, uniform: [0.3, 0.5, 0.8] };
    asset.setLight(window.makeLight().addDisc(sun));
    asset.setSun(sun);
    asset.setEnvironment(around);
    asset.mirrorSize = 16;
    const background = new lambent.EnvironmentBackground(around);
    const scene = new THREE.Scene().add(root, copy, background);
    scene.fog = new THREE.Fog(0x804020, 5, 14);
    const camera = window.makeCamera();
    asset.update(renderer, camera);
    const shown = [...pixels(renderer, scene, camera)];
    const error = renderer.getContext().getError();
    background.dispose();
    lambent.LambentAsset.of(copy).dispose();
    asset.dispose();
    out[file] = { pixels: shown, error, left: counts(renderer) };
  }
  return out;
}
