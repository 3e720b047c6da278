// What a program probably did not mean is said: once, with what to do. Nothing stays black without
// a word, and what is meant is not spoken of.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import { glossyScene, mirrorScene } from "./support/scenes.mjs";
import { lambent, noTool } from "./support/tool.mjs";

describe("advice", { skip: noTool }, () => {
  let folder;
  let browser;

  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "three-lambent-"));
    const quick = ["--directions", 64, "--bounces", 0, "--quiet"];
    for (const [name, bytes] of Object.entries({ glossy: glossyScene, mirror: mirrorScene })) {
      writeFileSync(join(folder, `${name}-scene.glb`), bytes);
      lambent(folder, "bake", `${name}-scene.glb`, "-o", `${name}.glb`, ...quick);
    }
    const page = readFileSync(new URL("page/objects.js", import.meta.url), "utf8");
    const script = await bundle(`${page}\nwindow.webgpu = () => import("three/webgpu");`);
    browser = await openPage({ script, folder });
    await browser.page.waitForFunction("window.ready");
    await browser.page.evaluate(() => {
      const { THREE, renderer, load, heard, makeCamera } = window;
      renderer.setSize(32, 32);
      /** What is said while two frames of a changed scene are drawn. */
      window.saidOf = async (file, change = () => {}) => {
        const { scene: root, userData } = await load(file);
        const asset = userData.lambent;
        const scene = new THREE.Scene().add(root);
        const said = await heard(() => {
          const update = change({ asset, root, scene }) !== "no update";
          for (let i = 0; i < 2; ++i) {
            if (update) asset.update(renderer);
            renderer.render(scene, makeCamera());
          }
        });
        asset.dispose();
        return said;
      };
      window.lit = ({ asset }) => {
        asset.setLight(window.makeLight());
        asset.setEnvironment({ texture: null, uniform: [1, 1, 1] });
      };
    });
  });
  after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true });
  });

  async function said(expected, what) {
    const found = await browser.page.evaluate(what);
    assert.deepEqual(browser.problems(), []);
    assert.equal(found.length, expected.length, found.join("\n"));
    expected.forEach((words, i) => assert.match(found[i], words));
  }

  it("says nothing where nothing is amiss", () =>
    said([], async () => {
      const { saidOf, lit, lambent } = window;
      const rest = [
        (it) => {
          lit(it);
          it.root.position.set(1e5, 3, -7);
          it.root.rotation.set(1, 2, 3);
          it.root.scale.setScalar(0.01);
        },
        ({ asset }) => void (asset.unlit = true),
        // Darkness that was asked for.
        ({ asset }) => (asset.setLight(null), asset.setEnvironment(null)),
        // Clones of single meshes that are turned as the original is.
        (it) => {
          lit(it);
          for (const mesh of [...it.root.children]) {
            const copy = mesh.clone();
            copy.position.x = 3;
            it.scene.add(copy);
          }
        },
        (it) => {
          lit(it);
          const copy = it.root.clone();
          copy.rotation.y = 1;
          it.scene.add(copy);
        },
      ];
      const out = [];
      for (const file of ["glossy.glb", "mirror.glb"])
        for (const change of rest) out.push(...(await saidOf(file, change)));
      return out;
    }));

  it("no update", () =>
    said([/drawn before it was ever relit: call asset\.update\(renderer\) once a frame/], () =>
      window.saidOf("glossy.glb", () => "no update"),
    ));

  it("no light", () =>
    said([/has no light: call asset\.setLight\(\) with a LambentLight/], () =>
      window.saidOf("glossy.glb"),
    ));

  it("three's lights alone", () =>
    said([/three's own lights \(DirectionalLight, AmbientLight\) do not reach it: call/], () =>
      window.saidOf("glossy.glb", ({ scene }) => {
        const { THREE } = window;
        scene.add(new THREE.DirectionalLight(), new THREE.AmbientLight());
      }),
    ));

  it("an environment of the scene's alone, of glossy surfaces and of mirrors", () =>
    said(
      [
        /scene\.environment does not light it: call asset\.setLight.*fromEquirectangular/,
        /mirrors.*scene\.environment is not looked at: call asset\.setEnvironment\(\{ texture/,
        /scene\.environment does not light it/,
      ],
      async () => {
        const { THREE, saidOf } = window;
        const map = new THREE.DataTexture(new Float32Array(32), 4, 2, undefined, THREE.FloatType);
        map.mapping = THREE.EquirectangularReflectionMapping;
        map.needsUpdate = true;
        const change = ({ scene }) => void (scene.environment = map);
        const found = [...(await saidOf("glossy.glb", change))];
        found.push(...(await saidOf("mirror.glb", change)));
        map.dispose();
        return found;
      },
    ));

  it("mirrors with nothing around them", () =>
    said([/has mirrors, and nothing that they show/], () =>
      window.saidOf("mirror.glb", ({ asset }) => asset.setLight(window.makeLight())),
    ));

  it("a mirrored root, a stretched one, one that stands nowhere", () =>
    said([/is mirrored .*bake the mirrored/, /is scaled unevenly/, /stands nowhere/], async () => {
      const { saidOf, lit } = window;
      const out = [];
      for (const change of [
        (root) => (root.scale.x = -1),
        (root) => (root.scale.y = 2),
        (root) => (root.position.x = NaN),
      ])
        out.push(...(await saidOf("glossy.glb", (it) => (lit(it), void change(it.root)))));
      return out;
    }));

  it("a part that moves by itself", () =>
    said([/part that moved by itself, mesh "satin"/, /part that moved.*"metal"/], async () => {
      const { saidOf, lit } = window;
      const out = [];
      for (const change of [
        ({ children: [satin] }) => (satin.position.y = 0.1),
        ({ children: [, metal] }) => (metal.rotation.x = 0.1),
      ])
        out.push(...(await saidOf("glossy.glb", (it) => (lit(it), void change(it.root)))));
      return out;
    }));

  it("a copy of single meshes that is turned otherwise", () =>
    said([/copy of mesh "satin" that is turned otherwise.*asset\.instantiate\(\)/], () =>
      window.saidOf("glossy.glb", (it) => {
        window.lit(it);
        const copy = it.root.children[0].clone();
        copy.rotation.y = 1;
        it.scene.add(copy);
      }),
    ));

  it("a name in front, where the root has one", () =>
    said([/^three-lambent: "chair" has no light/], () =>
      window.saidOf("glossy.glb", ({ root }) => void (root.name = "chair")),
    ));

  it("errors of what cannot be", async () => {
    const found = await browser.page.evaluate(async () => {
      const { THREE, lambent, renderer, load, thrown } = window;
      const { userData } = await load("glossy.glb");
      const asset = userData.lambent;
      const { WebGPURenderer } = await window.webgpu();
      const nan = window.makeLight();
      nan.coefficients[4] = NaN;
      const out = {
        directional: await thrown(() => asset.setLight(new THREE.DirectionalLight())),
        ambient: await thrown(() => asset.setLight(new THREE.AmbientLight())),
        probe: await thrown(() => asset.setLight(new THREE.LightProbe())),
        texture: await thrown(() => asset.setLight(new THREE.DataTexture())),
        nothing: await thrown(() => asset.setLight(undefined)),
        number: await thrown(() => asset.setLight(3)),
        transfer: await thrown(() => (asset.transfer = "bouncy")),
        kept: asset.transfer,
        webgpu: await thrown(() => asset.update(new WebGPURenderer())),
        none: await thrown(() => asset.update()),
        plain: await thrown(() => lambent.lambentOf({ userData: {} })),
        finite: await thrown(() => (asset.setLight(nan), asset.update(renderer))),
      };
      out.found = lambent.lambentOf({ userData }) === asset;
      asset.dispose();
      return out;
    });
    browser.problems(); // of a device without WebGPU
    const expected = {
      directional: /^TypeError.*not DirectionalLight: three's lights do not.* Use .*addDisc/,
      ambient: /not AmbientLight: use LambentLight\.uniform/,
      probe: /not LightProbe: use LambentLight\.fromLightProbe/,
      texture: /not DataTexture: use LambentLight\.fromEquirectangular/,
      nothing: /a LambentLight or null, not undefined/,
      number: /not 3: make one/,
      transfer: /^RangeError.*no transfer "bouncy": best, unshadowed, shadowed or interreflected/,
      kept: /^best$/,
      webgpu: /WebGPURenderer cannot draw relit assets.*use THREE\.WebGLRenderer/,
      none: /wants a THREE\.WebGLRenderer/,
      plain: /nothing to relight in this file: bake it/,
      finite: /coefficient that is not a finite number/,
      found: /true/,
    };
    for (const [name, words] of Object.entries(expected)) assert.match(`${found[name]}`, words);
  });
});
