// An asset is an object of three's, and behaves as one: copies, materials, fog, exporters,
// disposal; and nothing stays black without a word. In headless Chromium.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import { glb, parseGlb } from "./support/glb.mjs";
import {
  denseScene,
  glossyScene,
  leafScene,
  mattScene,
  mirrorScene,
} from "./support/scenes.mjs";
import { bakeLayers, bakePatch, lambent, noTool } from "./support/tool.mjs";

/** With names for its materials. */
function named(scene, ...names) {
  const { json, bin } = parseGlb(scene);
  names.forEach((name, i) => (json.materials[i].name = name));
  return glb(json, bin);
}

describe("assets as objects of three's", { skip: noTool }, () => {
  let folder;
  let browser;
  const keep = process.env.LAMBENT_KEEP_PICTURES;

  /** Runs a function in the page; nothing of what it does may make the page complain. */
  async function run(what, ...args) {
    const found = await browser.page.evaluate(what, ...args);
    assert.deepEqual(browser.problems(), []);
    if (keep && found?.pictures)
      for (const [name, url] of Object.entries(found.pictures))
        writeFileSync(join(keep, `${name}.png`), Buffer.from(url.split(",")[1], "base64"));
    return found;
  }

  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "three-lambent-"));
    const matt = named(mattScene, "paint", "tiles");
    const scenes = { matt, glossy: glossyScene, mirror: mirrorScene, leaf: leafScene };
    const quick = ["--directions", 256, "--bounces", 1, "--quiet"];
    writeFileSync(join(folder, "dense-scene.glb"), denseScene);
    const plain = ["--directions", 32, "--bounces", 0, "--bands", 2, "--quiet"];
    lambent(folder, "bake", "dense-scene.glb", "-o", "dense.glb", ...plain);
    for (const [name, bytes] of Object.entries(scenes)) {
      writeFileSync(join(folder, `${name}-scene.glb`), bytes);
      const more = name === "matt" ? ["--keep-shadowed"] : [];
      lambent(folder, "bake", `${name}-scene.glb`, "-o", `${name}.glb`, ...quick, ...more);
    }
    bakePatch(folder);
    bakeLayers(folder);
    const script = await bundle(readFileSync(new URL("page/objects.js", import.meta.url), "utf8"));
    browser = await openPage({ script, folder });
    await browser.page.waitForFunction("window.ready");
  });
  after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true });
  });

  describe("copies", () => {
    for (const file of ["matt.glb", "glossy.glb", "mirror.glb", "patch.glb", "layered.glb"])
      it(`${file}: clones and instances, each turned, as assets loaded apart`, async () => {
        const found = await run(async (file) => {
          const { THREE, lambent, renderer, load, pixels, apart } = window;
          const camera = window.makeCamera(3, 9);
          const disc = { direction: new THREE.Vector3(1, 1.5, 0.4), diameter: 0.01 };
          const sun = { ...disc, radiance: [30000, 25000, 20000] };
          const light = (asset) => {
            asset.setLight(window.makeLight().addDisc(sun));
            asset.setSun(sun);
            asset.setEnvironment({ texture: null, uniform: [0.3, 0.4, 0.6] });
          };
          const turns = [0, 1.9, -0.8, 2.6];
          const places = [-1.7, 1.7, -1.7, 1.7];
          const put = (root, i) => {
            root.rotation.set(0, turns[i], 0);
            root.position.set(places[i], 0, i < 2 ? 0 : -3);
            return root;
          };
          // Each of its own.
          const apartOnes = new THREE.Scene();
          const assets = [];
          for (let i = 0; i < 4; ++i) {
            const { scene, userData } = await load(file);
            apartOnes.add(put(scene, i));
            assets.push(userData.lambent);
            light(userData.lambent);
          }
          // One, two clones of it, made before the first update, and an instance.
          const gltf = await load(file);
          const one = lambent.lambentOf(gltf);
          const scene = new THREE.Scene();
          const clones = [gltf.scene.clone(), window.SkeletonUtils.clone(gltf.scene)];
          light(one);
          const instance = one.instantiate();
          [gltf.scene, ...clones, instance.root].forEach((root, i) => scene.add(put(root, i)));
          const out = {};
          for (const transfer of ["best", "unshadowed"]) {
            one.transfer = instance.transfer = transfer;
            one.update(renderer, camera);
            instance.update(renderer, camera);
            for (const asset of assets) {
              asset.transfer = transfer;
              asset.update(renderer, camera);
            }
            const truth = pixels(renderer, apartOnes, camera);
            const shown = pixels(renderer, scene, camera);
            out[transfer] = apart(truth, shown);
            out.pictures ??= { copies: window.pictureOf(shown, 0.5) };
            // What it would be if the copies were lit as the original.
            clones.forEach((root) => (root.rotation.y = 0));
            out[`${transfer} unturned`] = apart(truth, pixels(renderer, scene, camera));
            clones.forEach((root, i) => put(root, i + 1));
          }
          out.error = renderer.getContext().getError();
          for (const root of clones) lambent.LambentAsset.of(root).dispose();
          for (const asset of [one, instance, ...assets]) asset.dispose();
          return out;
        }, file);
        assert.equal(found.error, 0);
        for (const transfer of ["best", "unshadowed"]) {
          const { mean, most, light, covered } = found[transfer];
          assert.ok(covered > 0.15 && light > 0.1, JSON.stringify(found));
          assert.ok(mean < 1e-6 && most < 1e-3, `${transfer}: ${JSON.stringify(found)}`);
          assert.ok(found[`${transfer} unturned`].mean > 100 * mean);
        }
      });

    it("clones follow light and switches of the original until they have their own", async () => {
      const found = await run(async () => {
        const { THREE, lambent, renderer, load, pixels } = window;
        const { scene, userData } = await load("matt.glb");
        const asset = userData.lambent;
        const copy = scene.clone();
        copy.position.x = 2;
        const clone = lambent.LambentAsset.of(copy);
        const both = new THREE.Scene().add(scene, copy);
        const camera = window.makeCamera();
        const light = (r, g, b) => lambent.LambentLight.uniform([r, g, b]);
        const sums = () => {
          asset.update(renderer);
          scene.visible = false;
          const p = pixels(renderer, both, camera);
          scene.visible = true;
          return [0, 1, 2].map((c) => p.reduce((sum, v, i) => sum + (i % 4 === c ? v : 0), 0));
        };
        const out = {};
        asset.setLight(light(1, 0, 0));
        out.red = sums();
        asset.setLight(light(0, 1, 0));
        out.green = sums();
        clone.setLight(light(0, 0, 1));
        out.own = sums();
        asset.setLight(light(1, 1, 0));
        out.still = sums();
        asset.unlit = true;
        out.unlit = sums();
        clone.unlit = true;
        asset.unlit = false;
        out.after = sums();
        clone.dispose();
        asset.dispose();
        return out;
      });
      const shown = (rgb) => rgb.map((v) => (v > 1 ? 1 : 0)).join("");
      assert.deepEqual(
        Object.fromEntries(Object.entries(found).map(([name, rgb]) => [name, shown(rgb)])),
        { red: "100", green: "010", own: "001", still: "001", unlit: "111", after: "001" },
      );
    });

    it("share what is stored, and the last one frees it", async () => {
      const found = await run(async () => {
        const { renderer, load, counts, lambent } = window;
        const camera = window.makeCamera();
        const { scene, userData } = await load("patch.glb");
        const one = userData.lambent;
        one.setLight(window.makeLight());
        const out = [counts(renderer)];
        const draw = (asset) => {
          asset.update(renderer);
          renderer.render(asset.root, camera);
          out.push(counts(renderer));
        };
        draw(one);
        const two = one.instantiate();
        draw(two);
        one.dispose();
        one.dispose();
        out.push(counts(renderer));
        draw(two);
        const three = lambent.LambentAsset.of(two.root.clone());
        draw(two);
        two.dispose();
        draw(three);
        three.dispose();
        out.push(counts(renderer));
        out.push(await window.thrown(() => three.update(renderer)));
        out.push(scene.parent === null);
        return out;
      });
      const [none, one, two, oneLeft, same, both, last, end, message] = found;
      assert.equal(two.geometries, one.geometries + 1, JSON.stringify(found)); // of its passes
      // Of the floor and of the ball what is lit; maps, meso-structure and transfer are there
      // already.
      assert.equal(two.textures - one.textures, 2, JSON.stringify(found));
      assert.ok(one.textures > 5);
      assert.equal(two.programs, one.programs);
      assert.deepEqual(same, oneLeft);
      assert.deepEqual(last, same);
      assert.ok(both.textures > same.textures);
      assert.deepEqual(end, none);
      assert.match(message, /disposed of/);
    });
  });

  describe("materials", () => {
    it("have the file's names, colours and maps, before the first update and after", async () => {
      const found = await run(async () => {
        const { renderer, load } = window;
        const { scene, userData } = await load("matt.glb");
        const look = () =>
          scene.children.map(({ material }) => ({
            name: material.name,
            color: material.color.toArray().map((v) => Math.round(100 * v) / 100),
            map: material.map?.image?.width ?? 0,
            standard: material.isMeshStandardMaterial,
            roughness: material.roughness,
          }));
        const out = [look()];
        const materials = scene.children.map(({ material }) => material);
        userData.lambent.update(renderer);
        userData.lambent.transfer = "unshadowed";
        userData.lambent.update(renderer);
        out.push(look());
        out.push(scene.children.every(({ material }, i) => material === materials[i]));
        userData.lambent.dispose();
        return out;
      });
      const like = { standard: true, roughness: 1 };
      const expected = [
        { name: "paint", color: [0.9, 0.9, 0.9], map: 0, ...like },
        { name: "tiles", color: [0.8, 0.8, 0.8], map: 16, ...like },
      ];
      assert.deepEqual(found, [expected, expected, true]);
    });

    for (const file of ["matt.glb", "mirror.glb", "patch.glb", "leaf.glb"])
      it(`${file}: who frees a scene without knowing it frees all, and it comes back`, async () => {
        const found = await run(async (file) => {
          const { THREE, lambent, renderer, load, counts, pixels, apart } = window;
          const { scene, userData } = await load(file);
          const asset = userData.lambent;
          const light = window.makeLight();
          const sun = { direction: new THREE.Vector3(1, 1, 0.4), diameter: 0.01 };
          light.addDisc({ ...sun, radiance: [9000, 9000, 9000] });
          asset.setLight(light);
          asset.setSun({ ...sun, radiance: [9000, 9000, 9000] });
          asset.setEnvironment({ texture: null, uniform: [0.5, 0.5, 0.5] });
          const camera = window.makeCamera();
          const before = counts(renderer);
          asset.update(renderer, camera);
          const first = pixels(renderer, scene, camera);
          const between = counts(renderer);
          window.freeAll(scene);
          const after = counts(renderer);
          asset.update(renderer, camera);
          const again = apart(first, pixels(renderer, scene, camera));
          window.freeAll(scene);
          const afterAgain = counts(renderer);
          asset.dispose();
          return { before, between, after, again, afterAgain, end: counts(renderer) };
        }, file);
        const none = { geometries: 0, textures: 0, programs: 0 };
        assert.deepEqual(found.before, none);
        assert.ok(found.between.textures > 2 && found.between.programs > 2);
        for (const when of ["after", "afterAgain", "end"])
          assert.deepEqual(found[when], none, `${when}: ${JSON.stringify(found)}`);
        assert.ok(found.again.most === 0 && found.again.light > 0.1, JSON.stringify(found.again));
      });

    it("fog of a scene lies before them as before three's own", async () => {
      const found = await run(async () => {
        const { THREE, lambent, renderer, load, pixels, apart } = window;
        const camera = window.makeCamera();
        const out = { pictures: {} };
        for (const file of ["matt.glb", "patch.glb"]) {
          const { scene: root, userData } = await load(file);
          const asset = userData.lambent;
          const scene = new THREE.Scene().add(root);
          asset.setLight(window.makeLight());
          asset.update(renderer);
          const plain = pixels(renderer, scene, camera);
          // How much is fog, by a material of three's own at the same places.
          const black = new THREE.MeshBasicMaterial({ color: 0, side: THREE.DoubleSide });
          for (const fog of [new THREE.Fog(0x804020, 6, 10), new THREE.FogExp2(0x804020, 0.1)]) {
            scene.fog = fog;
            const shown = pixels(renderer, scene, camera);
            scene.overrideMaterial = black;
            const share = pixels(renderer, scene, camera);
            scene.overrideMaterial = null;
            const expected = plain.map((v, i) => {
              const c = i % 4;
              if (c === 3) return v;
              const amount = share[4 * (i >> 2)] / fog.color.r;
              return v * (1 - amount) + share[i];
            });
            const name = `${file} ${fog.isFog ? "linear" : "exp2"}`;
            out[name] = { ...apart(expected, shown), changed: apart(plain, shown).mean };
            out.pictures[`fog-${name.replace(".glb ", "-")}`] = window.pictureOf(shown, 0.6);
          }
          black.dispose();
          asset.dispose();
        }
        return out;
      });
      for (const [name, { mean, changed }] of Object.entries(found)) {
        if (name === "pictures") continue;
        assert.ok(mean < 1e-5 && changed > 100 * mean && changed > 1e-3, JSON.stringify(found));
      }
    });

    it("are written by an exporter with names, colours and maps", async () => {
      const found = await run(async () => {
        const { GLTFExporter, renderer, load, heard } = window;
        const { scene, userData } = await load("matt.glb");
        const out = { heard: [] };
        for (const when of ["before", "after"]) {
          if (when === "after") userData.lambent.update(renderer);
          out.heard.push(
            ...(await heard(async () => {
              out[when] = await new GLTFExporter().parseAsync(scene, { binary: false });
            })),
          );
        }
        userData.lambent.dispose();
        const { materials, textures, images } = out.after;
        const same = JSON.stringify(materials) === JSON.stringify(out.before.materials);
        const counts = { textures: textures.length, images: images.length };
        return { materials, same, ...counts, heard: out.heard };
      });
      assert.deepEqual(found.heard, []);
      assert.equal(found.textures, 1);
      assert.equal(found.images, 1);
      assert.ok(found.same);
      assert.deepEqual(
        found.materials.map(({ name }) => name),
        ["paint", "tiles"],
      );
      const [paint, tiles] = found.materials.map((each) => each.pbrMetallicRoughness);
      paint.baseColorFactor.slice(0, 3).forEach((v) => assert.ok(Math.abs(v - 0.9) < 1e-3));
      assert.equal(paint.metallicFactor, 0);
      assert.equal(tiles.baseColorTexture.index, 0);
    });

    it("a closed body has no dots of its back along its silhouette", async () => {
      const [found, both] = await run(async () => {
        const { THREE, lambent, load } = window;
        const renderer = window.makeRenderer({ preserveDrawingBuffer: true });
        const n = 384;
        renderer.setSize(n, n);
        renderer.setClearColor(0xffffff, 1);
        const { scene, userData } = await load("dense.glb");
        userData.lambent.setLight(lambent.LambentLight.uniform([3, 3, 3]));
        userData.lambent.update(renderer);
        const out = [];
        for (const sides of ["its own", "both"]) {
          const [{ material }] = scene.children;
          if (sides === "both") {
            material.side = THREE.DoubleSide;
            material.needsUpdate = true;
          }
          let dots = 0;
          for (let k = 0; k < 16; ++k) {
            const camera = window.makeCamera(1 + 0.2 * k, 3 + 0.25 * k);
            renderer.render(scene, camera);
            const gl = renderer.getContext();
            const bytes = new Uint8Array(4 * n * n);
            gl.readPixels(0, 0, n, n, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
            for (let i = 0; i < bytes.length; i += 4) if (bytes[i] < 40) ++dots;
          }
          out.push(dots);
        }
        userData.lambent.dispose();
        renderer.dispose();
        return out;
      });
      assert.equal(found, 0);
      assert.ok(both > 0, "this view would show them");
    });
  });
});
