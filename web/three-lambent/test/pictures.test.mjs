// Pictures of every kind of asset in headless Chromium against those of the CPU: the mean difference
// is at most 1/255 of the tone-mapped range, of the whole picture and of the asset's own pixels; where
// mirrors see mirrors, of which captures know one side, at most kMirrorsBound.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { Quaternion, Vector3 } from "three";
import { kMostDiscs, LambentLight } from "../dist/index.js";
import { bundle, openPage } from "./support/browser.mjs";
import {
  ballScene,
  environmentExr,
  glossyScene,
  leafScene,
  mattScene,
  mirrorScene,
  mirrorsScene,
  ringScene,
  sheetScene,
  texelScene,
} from "./support/scenes.mjs";
import { lambent, noTool } from "./support/tool.mjs";

const kSize = 256;
const kMirrorsBound = 5;
const kDegree = Math.PI / 180;

/** About the vertical, counter-clockwise seen from above, as the tool's --rotate-y. */
const aboutY = (degrees) => [
  0,
  Math.sin((degrees * kDegree) / 2),
  0,
  Math.cos((degrees * kDegree) / 2),
];

describe("pictures against the CPU's", { skip: noTool }, () => {
  let folder;
  let browser;
  const keep = process.env.LAMBENT_KEEP_PICTURES;

  before(async () => {
    folder = keep || mkdtempSync(join(tmpdir(), "three-lambent-"));
    const scenes = {
      matt: mattScene,
      glossy: glossyScene,
      mirror: mirrorScene,
      mirrors: mirrorsScene,
      ring: ringScene,
      sheet: sheetScene,
      leaf: leafScene,
      texel: texelScene,
      ball: ballScene,
    };
    for (const [name, bytes] of Object.entries(scenes))
      writeFileSync(join(folder, `${name}-scene.glb`), bytes);
    writeFileSync(join(folder, "environment.exr"), environmentExr);
    const quick = ["--directions", 512, "--bounces", 1, "--quiet"];
    const bake = (scene, output, ...more) =>
      lambent(folder, "bake", `${scene}-scene.glb`, "-o", `${output}.glb`, ...quick, ...more);
    bake("matt", "matt");
    bake("matt", "matt-shadowed", "--transfer", "shadowed", "--bands", 4);
    bake("matt", "matt-kept", "--keep-shadowed");
    bake("texel", "texel-kept", "--texels", "sheet=48x40", "--keep-shadowed");
    bake("glossy", "glossy");
    bake(
      "glossy",
      "glossy-float",
      "--encoding",
      "float32",
      "--bands",
      4,
      "--glossy-bands",
      6,
      "--transfer",
      "shadowed",
    );
    bake("matt", "matt-unshadowed", "--transfer", "unshadowed");
    bake("glossy", "glossy-unshadowed", "--transfer", "unshadowed");
    bake("mirror", "mirror");
    bake("mirrors", "mirrors", "--keep-shadowed");
    bake("ring", "ring");
    bake("sheet", "sheet");
    bake("leaf", "leaf");
    bake("texel", "texel", "--texels", "sheet=48x40");
    bake("matt", "matt-auto", "--texels", "auto", "--texel-budget", 4096);
    const patch = [
      "--positions",
      "24x20",
      "--views",
      4,
      "--directions",
      128,
      "--bounces",
      1,
      "--quiet",
    ];
    lambent(folder, "rtt", "stucco", "-o", "patch.rtt", ...patch);
    lambent(
      folder,
      "rtt",
      "stucco",
      "-o",
      "patch16.rtt",
      ...patch,
      "--encoding",
      "float16",
      "--bands",
      3,
    );
    const spread = [
      "--directions",
      256,
      "--map-size",
      256,
      "--vertices",
      8000,
      "--mesh",
      "ball",
      "--quiet",
    ];
    lambent(
      folder,
      "synthesize",
      "ball-scene.glb",
      "--rtt",
      "patch.rtt",
      "-o",
      "patch.glb",
      "--patch-width",
      0.5,
      ...spread,
    );
    lambent(
      folder,
      "synthesize",
      "ball-scene.glb",
      "--rtt",
      "patch.rtt",
      "-o",
      "patch-shadowed.glb",
      "--transfer",
      "shadowed",
      ...spread,
    );
    lambent(
      folder,
      "synthesize",
      "ball-scene.glb",
      "--rtt",
      "patch16.rtt",
      "-o",
      "tiled.glb",
      "--map",
      "uv",
      "--tiles",
      "9x6",
      ...spread,
    );
    const script = await bundle(readFileSync(new URL("page/pictures.js", import.meta.url), "utf8"));
    const data = (name) => readFileSync(new URL(`../data/${name}`, import.meta.url));
    const files = { "sky.bin": data("sky.bin"), "air.bin": data("air.bin") };
    browser = await openPage({ script, folder, files });
    await browser.page.waitForFunction("window.ready");
  });
  after(async () => {
    await browser?.close();
    if (folder && !keep) rmSync(folder, { recursive: true });
  });

  /** The tool's picture, as a PNG. */
  function renderTruth(truth, asset, source, options = [], background = true) {
    lambent(
      folder,
      "render",
      asset,
      "--light",
      source,
      "-o",
      truth,
      ...(options.includes("--backend") ? [] : ["--backend", "cpu"]),
      "--samples",
      1,
      "--size",
      kSize,
      "--camera",
      "auto",
      "--quiet",
      ...(background ? ["--background"] : []),
      ...(options.includes("--exposure") ? [] : ["--exposure", 0]),
      ...options,
    );
  }

  /** The tool's picture and the page's. `options` go to the tool, `state` to the page. */
  async function agree(
    name,
    asset,
    options = [],
    state = {},
    source = "environment.exr",
    bound = 1,
  ) {
    const truth = `truth-${name}.png`;
    renderTruth(truth, asset, source, options, state.background !== false);
    const found = await browser.page.evaluate((s) => window.compare(s), {
      asset,
      truth,
      size: kSize,
      background: true,
      ...(source.startsWith("environment.exr") && { environment: "environment.exr" }),
      ...state,
    });
    if (keep)
      writeFileSync(
        join(folder, `web-${name}.png`),
        Buffer.from(found.picture.split(",")[1], "base64"),
      );
    console.log(
      `${name}: ${found.own.toFixed(3)}/255 of the asset's pixels, ${found.all.toFixed(3)}/255 of all`,
    );
    const problems = browser.problems();
    assert.deepEqual(problems, [], `the page complained: ${problems.join("\n")}`);
    assert.equal(found.error, 0, `WebGL error ${found.error}`);
    // A picture that shows nothing agrees with anything.
    assert.ok(
      found.covered > 0.1 && found.brightness > 10,
      `covered ${found.covered}, brightness ${found.brightness}`,
    );
    assert.ok(found.own <= bound && found.all <= bound, `${name}: ${found.own}/255, ${found.all}/255`);
    return found;
  }

  it("diffuse at vertices, with textures and vertex colours", () => agree("matt", "matt.glb"));
  it("… baked shadowed, of another number of bands", () =>
    agree("matt-shadowed", "matt-shadowed.glb"));
  it("glossy at vertices", () => agree("glossy", "glossy.glb"));
  it("… with light fetched per pixel", () =>
    agree("glossy-fetch", "glossy.glb", [], { incident: "fetch" }));
  it("… float32, of more rows than columns", () => agree("glossy-float", "glossy-float.glb"));
  it("… with another lobe", () =>
    agree("glossy-lobe", "glossy.glb", ["--lobe", 40], { asset_: { lobeExponent: 40 } }));
  it("mirrors", () => agree("mirror", "mirror.glb"));
  it("a mirror around a body that stands in its middle", async () => {
    const { own } = await agree("ring", "ring.glb");
    const without = await browser.page.evaluate((s) => window.compare(s), {
      ...{ asset: "ring.glb", truth: "truth-ring.png", size: kSize, background: true },
      ...{ environment: "environment.exr", asset_: { mirrorSize: 0 } },
    });
    console.log(`ring: ${without.own.toFixed(3)}/255 with the environment alone`);
    assert.ok(without.own > 1.5 * own, `${own}/255, ${without.own}/255 without`);
  });
  it("two sides", () => agree("sheet", "sheet.glb"));
  it("holes", () => agree("leaf", "leaf.glb"));
  it("texels, matt and glossy", () => agree("texel", "texel.glb"));
  it("texels on a second set of texture coordinates", () => agree("matt-auto", "matt-auto.glb"));
  it("meso-structure with an id map", () => agree("patch", "patch.glb"));
  it("… with light fetched per pixel", () =>
    agree("patch-fetch", "patch.glb", [], { incident: "fetch" }));
  it("… unfiltered", () =>
    agree("patch-nearest", "patch.glb", ["--filter", "off"], { asset_: { filter: false } }));
  it("… without macro-scale transfer", () =>
    agree("patch-macro-off", "patch.glb", ["--macro", "off"], { asset_: { macro: false } }));
  it("… shadowed", () =>
    agree("patch-shadowed", "patch-shadowed.glb", ["--macro", "shadowed"], {
      asset_: { transfer: "shadowed" },
    }));
  it("… as pasted on", () =>
    agree("patch-flat", "patch.glb", ["--view-dependence", "off"], {
      asset_: { viewDependent: false },
    }));
  it("meso-structure over UVs, float16", () => agree("tiled", "tiled.glb"));

  for (const [name, asset] of [
    ["matt", "matt.glb"],
    ["glossy", "glossy.glb"],
    ["mirror", "mirror.glb"],
    ["texel", "texel.glb"],
    ["patch", "patch.glb"],
  ]) {
    it(`${name}, the environment turned`, () =>
      agree(`${name}-turned`, asset, ["--rotate-y", 70], { environmentRotation: aboutY(70) }));
    it(`${name}, the object turned and moved`, () =>
      agree(`${name}-moved`, asset, ["--rotate-y", -50], {
        objectRotation: aboutY(50),
        objectTranslation: [3, -1, 2],
      }));
  }

  // What an asset shows unshadowed is what was baked so.
  for (const kind of ["matt", "glossy"])
    it(`${kind}, unshadowed`, async () => {
      const state = { asset: `${kind}.glb`, asset_: { transfer: "unshadowed" } };
      await agree(`${kind}-unshadowed`, `${kind}-unshadowed.glb`, [], state);
    });

  // About any axis: the tool is given the light that such a turn leaves.
  for (const kind of ["matt", "glossy", "texel", "patch"])
    it(`${kind}, turned about a slanted axis`, async () => {
      const q = new Quaternion(0.4, -0.3, 0.6, 0.5).normalize();
      const light = new LambentLight(5).add(LambentLight.uniform([0.2, 0.3, 0.4]));
      light.addDisc({ direction: new Vector3(0.3, 1, 0.6), diameter: 0.9, radiance: [8, 7, 5] });
      light.addDisc({ direction: new Vector3(-1, 0.2, 0.4), diameter: 1.2, radiance: [0.5, 1, 3] });
      const written = (name, { coefficients, bands }) => {
        const rows = Array.from({ length: bands * bands }, (_, i) => [
          ...coefficients.subarray(3 * i, 3 * i + 3),
        ]);
        writeFileSync(
          join(folder, name),
          JSON.stringify({ lambent: "light", bands, coefficients: rows }),
        );
        return name;
      };
      const world = written("world-light.json", light);
      const turned = written("turned-light.json", light.clone().rotate(q.clone().invert()));
      await agree(
        `${kind}-slanted`,
        `${kind}.glb`,
        [],
        {
          light: world,
          objectRotation: q.toArray(),
          objectTranslation: [-2, 5, 1],
          background: false,
        },
        turned,
      );
    });

  it("linear tone curve, exposure, a disc in mirrors and in the light", () =>
    agree(
      "mirror-disc",
      "mirror.glb",
      ["--tone", "linear", "--exposure", -1],
      {
        tone: "linear",
        exposure: -1,
        discs: [
          {
            direction: {
              x: Math.cos(30 * kDegree) * Math.cos(50 * kDegree),
              y: Math.sin(50 * kDegree),
              z: Math.sin(30 * kDegree) * Math.cos(50 * kDegree),
            },
            diameter: 40 * kDegree,
            radiance: [3, 2, 1],
          },
        ],
      },
      "environment.exr+disc:30,50,40,3/2/1",
    ));

  // A small bright disc, through a map of its shadows. Borders of shadows differ by parts of a texel.
  const sunAt = (azimuth, elevation, diameter = 0.53) => ({
    source: `environment.exr+disc:${azimuth},${elevation},${diameter},160000/144000/120000`,
    disc: {
      direction: {
        x: Math.cos(azimuth * kDegree) * Math.cos(elevation * kDegree),
        y: Math.sin(elevation * kDegree),
        z: Math.sin(azimuth * kDegree) * Math.cos(elevation * kDegree),
      },
      diameter: diameter * kDegree,
      radiance: [160000, 144000, 120000],
    },
  });
  for (const [name, asset, azimuth, elevation, options, choices] of [
    ["high", "matt-kept.glb", 30, 70],
    ["low", "matt-kept.glb", -60, 12],
    ["shadowed", "matt-shadowed.glb", 140, 35],
    ["kept-shadowed", "matt-kept.glb", 30, 40, ["--transfer", "shadowed"], { transfer: "shadowed" }],
    ["unshadowed", "matt-unshadowed.glb", 30, 40],
    ["texels", "texel-kept.glb", 100, 50],
    ["soft", "matt-kept.glb", 30, 40, ["--sun-shadow", "soft"], {}],
  ])
    it(`the Sun's sharp shadow: ${name}`, async () => {
      const { source, disc } = sunAt(azimuth, elevation);
      const state = { discs: [disc], sharpSun: name !== "soft", asset_: choices, exposure: -3 };
      const more = ["--exposure", -3, ...(options ?? [])];
      const found = await agree(`sun-${name}`, asset, more, state, source);
      // What is beside it: without it, and with its harmonics alone.
      const other = await browser.page.evaluate((s) => window.compare(s), {
        ...{ asset, truth: `truth-sun-${name}.png`, size: kSize, background: true },
        ...{ environment: "environment.exr", ...state, sharpSun: !state.sharpSun },
      });
      const apart = name === "unshadowed" ? 0.2 : 1; // where nothing is hidden little is
      assert.ok(other.own > 5 * found.own && other.own > apart, `soft and sharp are ${other.own}/255 apart`);
    });

  it("the Sun's sharp shadow, the object turned and moved", () => {
    const { source, disc } = sunAt(30, 40);
    // The tool turns the light; here the object is turned the other way, and the Sun is the world's.
    return agree(
      "sun-moved",
      "matt-kept.glb",
      ["--rotate-y", -50, "--exposure", -3],
      {
        ...{ discs: [disc], sharpSun: true, exposure: -3 },
        ...{ objectRotation: aboutY(50), objectTranslation: [3, -1, 2] },
      },
      source,
    );
  });

  // Seen through the air of a sky, near and far. The tool's air is the library's own table.
  for (const [name, asset, elevation, metresPerUnit, exposure, shafts] of [
    ["near-noon", "matt-kept.glb", 55, 20, -5, false],
    ["far-noon", "matt-kept.glb", 55, 2000, -5, false],
    ["far-low", "matt-kept.glb", 4, 2000, -3, false],
    ["far-mirror", "mirror.glb", 30, 1500, -4.5, false],
    ["far-patch", "patch.glb", 30, 1500, -4.5, false],
    ["shafts-noon", "matt-kept.glb", 55, 2000, -5, true],
    ["shafts-afternoon", "matt-kept.glb", 42, 1800, -3.5, true],
  ])
    it(`through the air: ${name}`, async () => {
      const source = `sky:sun-elevation=${elevation},sun-azimuth=140`;
      const state = {
        sky: { sunElevation: elevation * kDegree, sunAzimuth: 140 * kDegree },
        air: { metresPerUnit, shafts },
        ...{ sharpSun: true, exposure },
      };
      const options = ["--air", "--metres-per-unit", metresPerUnit, "--exposure", exposure];
      // Shadows in the air by a map, as here: beyond what is seen the map knows of none.
      if (shafts) options.push("--shafts", "--backend", "gl");
      const found = await agree(`air-${name}`, asset, options, state, source);
      if (metresPerUnit < 1000) return;
      const shown = { asset, size: kSize, background: true };
      if (shafts) {
        const truth = `truth-air-${name}-without.png`;
        renderTruth(truth, asset, source, options.filter((each) => each !== "--shafts"));
        const { change, apart } = await browser.page.evaluate(
          ([before, after]) => window.compareChange(before, after),
          [
            { ...shown, ...state, air: { metresPerUnit }, truth },
            { ...shown, ...state, truth: `truth-air-${name}.png` },
          ],
        );
        console.log(`shafts change ${change.toFixed(3)}/255, here ${apart.toFixed(3)}/255 otherwise`);
        // Codes are whole numbers, and the change is a fraction of one: without shafts it would be 1.
        assert.ok(apart < 0.6 * change, `shafts change ${change}/255, here ${apart}/255 otherwise`);
        return;
      }
      const other = await browser.page.evaluate((s) => window.compare(s), {
        ...shown, ...state, air: null, truth: `truth-air-${name}.png`,
      });
      assert.ok(other.all > 3 * found.all, `${other.all}/255 without, ${found.all}/255 with`);
    });

  // Mirrors between coloured things: each picture, and that it is what the captures make it.
  for (const [name, options, state, source] of [
    ["as they stand", [], {}],
    ["the environment turned", ["--rotate-y", 70], { environmentRotation: aboutY(70) }],
    [
      "the object turned and moved",
      ["--rotate-y", -50],
      { objectRotation: aboutY(50), objectTranslation: [3, -1, 2] },
    ],
    [
      "under a sharp Sun",
      ["--exposure", -3],
      { exposure: -3, discs: [sunAt(200, 50).disc], sharpSun: true },
      sunAt(200, 50).source,
    ],
    [
      "through the air",
      ["--air", "--metres-per-unit", 1000, "--exposure", -4.5],
      {
        sky: { sunElevation: 30 * kDegree, sunAzimuth: 140 * kDegree },
        air: { metresPerUnit: 1000 },
        ...{ sharpSun: true, exposure: -4.5 },
      },
      "sky:sun-elevation=30,sun-azimuth=140",
    ],
  ])
    it(`mirrors that see the asset, ${name}`, async () => {
      const stem = `mirrors-${name.replaceAll(" ", "-")}`;
      const found = await agree(stem, "mirrors.glb", options, state, source, kMirrorsBound);
      const without = await browser.page.evaluate((s) => window.compare(s), {
        ...{ asset: "mirrors.glb", truth: `truth-${stem}.png`, size: kSize, background: true },
        ...(!state.sky && { environment: "environment.exr" }),
        ...state,
        asset_: { mirrorSize: 0 },
      });
      console.log(`${stem}: ${without.own.toFixed(3)}/255 with the environment alone`);
      assert.ok(without.own > 1.5 * found.own, `${found.own}/255, ${without.own}/255 without`);
    });

  // Beside and upon each other, a sun, half of the sphere, and all of it.
  for (const turn of [0, 70])
    it(`as many discs as there can be${turn ? ", the map turned" : ""}`, () => {
      const discs = Array.from({ length: kMostDiscs }, (_, i) => ({
        azimuth: 35 + 7 * (i % 4),
        elevation: 30 + 9 * Math.floor(i / 4),
        diameter: 3 + 2 * i,
        radiance: [0.1 * i, 0.4, 1.6 - 0.1 * i],
      }));
      discs[1] = { azimuth: 200, elevation: 65, diameter: 180, radiance: [0.2, 0.1, 0.4] };
      discs[2] = { azimuth: -20, elevation: 10, diameter: 360, radiance: [0.1, 0.2, 0.1] };
      discs[3] = { azimuth: 75, elevation: 20, diameter: 0.53, radiance: [90, 80, 70] };
      const source = discs.map(
        ({ azimuth, elevation, diameter, radiance }) =>
          `disc:${azimuth},${elevation},${diameter},${radiance.join("/")}`,
      );
      return agree(
        `mirror-discs-${turn}`,
        "mirror.glb",
        ["--rotate-y", turn, "--exposure", -1],
        {
          exposure: -1,
          environmentRotation: aboutY(turn),
          discs: discs.map(({ azimuth, elevation, diameter, radiance }) => {
            // The tool turns all of the light; here the discs stand in the world.
            const [a, e] = [azimuth * kDegree, elevation * kDegree];
            const { x, y, z } = new Vector3(
              Math.cos(e) * Math.cos(a),
              Math.sin(e),
              Math.cos(e) * Math.sin(a),
            ).applyQuaternion(new Quaternion(...aboutY(turn)));
            return { direction: { x, y, z }, diameter: diameter * kDegree, radiance };
          }),
        },
        ["environment.exr", ...source].join("+"),
      );
    });

  it("says so where there are more discs", async () => {
    const message = await browser.page.evaluate((count) => {
      const { THREE, lambent } = window;
      const disc = { direction: new THREE.Vector3(0, 1, 0), diameter: 0.1, radiance: [1, 1, 1] };
      try {
        new lambent.EnvironmentBackground({ texture: null, discs: Array(count).fill(disc) });
        return "";
      } catch (error) {
        return String(error.message);
      }
    }, kMostDiscs + 1);
    assert.match(message, new RegExp(`${kMostDiscs + 1} discs, where ${kMostDiscs} can be shown`));
  });

  it("fetches per pixel when told to, and by itself where varyings are few", async () => {
    const layouts = await browser.page.evaluate(async () => {
      const found = {};
      for (const incident of ["auto", "varyings", "fetch"]) {
        const { userData, scene } = await window.load("glossy.glb", incident);
        userData.lambent.update(window.renderer);
        found[incident] = scene.children.map((mesh) =>
          mesh.geometry.hasAttribute("lambentCorners"),
        );
        userData.lambent.dispose();
      }
      const { maxVaryings } = window.renderer.capabilities;
      window.renderer.capabilities.maxVaryings = 15;
      const { userData, scene } = await window.load("glossy.glb");
      userData.lambent.update(window.renderer);
      found.few = scene.children.map((mesh) => mesh.geometry.hasAttribute("lambentCorners"));
      userData.lambent.dispose();
      window.renderer.capabilities.maxVaryings = maxVaryings;
      return found;
    });
    const all = (value) => [value, value, value];
    assert.deepEqual(layouts, {
      auto: all(false),
      varyings: all(false),
      fetch: all(true),
      few: all(true),
    });
  });

  it("stays an ordinary three object: bounds, picking, finding the asset again", async () => {
    const found = await browser.page.evaluate(async () => {
      const { THREE, lambent } = window;
      const { scene, userData } = await window.load("matt.glb");
      scene.position.set(10, 0, 0);
      scene.updateMatrixWorld();
      const ray = new THREE.Raycaster(new THREE.Vector3(10, 5, 0), new THREE.Vector3(0, -1, 0));
      const [hit] = ray.intersectObject(scene);
      const box = new THREE.Box3().setFromObject(scene);
      const asset = lambent.LambentAsset.of(hit.object);
      const result = {
        hit: hit.point.toArray(),
        name: hit.object.name,
        same: asset === userData.lambent,
        middle: box.getCenter(new THREE.Vector3()).x,
        kinds: [...asset.kinds],
        offers: ["best", "unshadowed", "shadowed", "interreflected"].map((c) => asset.offers(c)),
        info: asset.info,
      };
      asset.dispose();
      result.after = lambent.LambentAsset.of(scene) === undefined;
      return result;
    });
    assert.ok(Math.abs(found.hit[1] - 1.4) < 0.01, `${found.hit}`);
    assert.equal(found.name, "ball");
    assert.ok(found.same && found.after);
    assert.ok(Math.abs(found.middle - 10) < 1e-3);
    assert.deepEqual(found.kinds, ["diffuse"]);
    assert.deepEqual(found.offers, [true, true, false, true]);
    assert.equal(found.info.bands, 5);
  });

  it("shows the shadowed transfer that is kept beside, half of what an open square has", async () => {
    const sample = new URL("../../../spec/samples/kept-shadowed.glb", import.meta.url);
    writeFileSync(join(folder, "kept-shadowed.glb"), readFileSync(sample));
    const { offers, sums } = await browser.page.evaluate(async () => {
      const { THREE, lambent, renderer } = window;
      const { scene, userData } = await window.load("kept-shadowed.glb");
      const asset = userData.lambent;
      asset.setLight(lambent.LambentLight.uniform([1, 1, 1]));
      asset.softLobes = false; // the numbers as they are stored
      const camera = new THREE.PerspectiveCamera();
      lambent.frameAutomatically(scene, camera, 1);
      const target = new THREE.WebGLRenderTarget(64, 64, { type: THREE.FloatType });
      const sums = {};
      for (const choice of ["best", "unshadowed", "shadowed", "interreflected"]) {
        asset.transfer = choice;
        asset.update(renderer);
        renderer.setRenderTarget(target);
        renderer.setClearColor(0, 0);
        renderer.clear();
        renderer.render(scene, camera);
        renderer.setRenderTarget(null);
        const pixels = new Float32Array(4 * 64 * 64);
        renderer.readRenderTargetPixels(target, 0, 0, 64, 64, pixels);
        sums[choice] = pixels.reduce((sum, v, i) => sum + (i % 4 === 3 ? 0 : v), 0);
      }
      target.dispose();
      const choices = ["shadowed", "interreflected"];
      const offers = choices.map((choice) => asset.offers(choice));
      asset.dispose();
      return { offers, sums };
    });
    assert.deepEqual(offers, [true, true]);
    assert.ok(sums.shadowed > 1);
    assert.ok(Math.abs(sums.unshadowed / sums.shadowed - 2) < 1e-3, JSON.stringify(sums));
    assert.equal(sums.best, sums.interreflected);
    assert.ok(sums.interreflected > sums.shadowed);
  });

  it("relights only when something changed", async () => {
    const updates = await browser.page.evaluate(async () => {
      const { lambent, renderer } = window;
      const { scene, userData } = await window.load("glossy.glb");
      const asset = userData.lambent;
      const light = lambent.LambentLight.uniform([1, 1, 1]);
      asset.setLight(light);
      const out = [asset.update(renderer), asset.update(renderer)];
      light.scale(2);
      out.push(asset.update(renderer), asset.update(renderer));
      scene.rotation.y = 1;
      out.push(asset.update(renderer), asset.update(renderer));
      scene.position.x = 3; // light is far away
      out.push(asset.update(renderer));
      asset.lobeExponent = 3;
      out.push(asset.update(renderer), asset.update(renderer));
      asset.transfer = "unshadowed";
      out.push(asset.update(renderer), asset.update(renderer));
      asset.unlit = true;
      out.push(asset.update(renderer));
      asset.unlit = false;
      out.push(asset.update(renderer));
      asset.dispose();
      return out;
    });
    const [yes, no] = [true, false];
    assert.deepEqual(updates, [yes, no, yes, no, yes, no, no, yes, no, yes, no, no, yes]);
  });

  it("captures what mirrors see when that changes, not when the camera or the object moves", async () => {
    const found = await browser.page.evaluate(async () => {
      const { THREE, lambent, renderer } = window;
      const { scene, userData } = await window.load("mirror.glb");
      const asset = userData.lambent;
      const camera = new THREE.PerspectiveCamera();
      lambent.frameAutomatically(scene, camera, 1);
      const light = lambent.LambentLight.uniform([1, 1, 1]).addDisc({
        ...{ direction: new THREE.Vector3(1, 1, 0), diameter: 0.5, radiance: [9, 9, 9] },
      });
      asset.setLight(light);
      /** What a change takes in pictures, of which a capture is six. */
      const out = {};
      const takes = (name, change) => {
        change();
        const before = renderer.info.render.frame;
        asset.update(renderer, camera);
        out[name] = renderer.info.render.frame - before;
      };
      takes("first", () => {});
      takes("nothing", () => {});
      takes("the camera", () => camera.position.multiplyScalar(0.9));
      takes("the object", () => scene.position.set(3, 0, 1));
      takes("samples", () => ((asset.samples = 4), (asset.sample = 3)));
      takes("the light as it was", () => asset.setLight(light.clone()));
      takes("the environment, of one mirror", () => asset.setEnvironment({ texture: null, uniform: [1, 2, 3] }));
      takes("the light", () => light.scale(2) && asset.setLight(light));
      takes("its turn", () => (scene.rotation.y = 1));
      takes("size", () => (asset.mirrorSize = 64));
      takes("a mesh", () => (scene.children[1].visible = false));
      takes("a choice", () => (asset.transfer = "unshadowed"));
      takes("off", () => (asset.mirrorSize = 0));
      takes("on", () => (asset.mirrorSize = 32));
      asset.dispose();
      return out;
    });
    const relit = found["the light as it was"]; // a pass for each mesh that is not a mirror
    assert.equal(relit, 2);
    assert.deepEqual(found, {
      ...{ first: relit + 6, nothing: 0, "the camera": 0, "the object": 0, samples: 0 },
      ...{ "the light as it was": relit, "the environment, of one mirror": 0 },
      ...{ "the light": relit + 6, "its turn": relit + 6, size: 6, "a mesh": 6 },
      ...{ "a choice": relit + 6, off: relit, on: relit + 6 },
    });
  });

  it("captures again where mirrors see mirrors, and with the environment", async () => {
    const found = await browser.page.evaluate(async () => {
      const { lambent, renderer } = window;
      const { scene, userData } = await window.load("mirrors.glb");
      const asset = userData.lambent;
      asset.setLight(lambent.LambentLight.uniform([1, 1, 1]));
      const out = [];
      for (const change of [
        () => {},
        () => asset.setEnvironment({ texture: null, uniform: [1, 2, 3] }),
        () => asset.setEnvironment({ texture: null, uniform: [1, 2, 3] }),
        () => scene.position.set(1, 2, 3),
        () => scene.rotateY(1),
      ]) {
        change();
        const before = renderer.info.render.frame;
        const relit = asset.update(renderer);
        out.push([relit, renderer.info.render.frame - before]);
      }
      asset.dispose();
      return out;
    });
    const passes = found[0][1] - 18; // one capture, the other, and the first with what that shows
    assert.deepEqual(found, [
      [true, passes + 18],
      [false, 18],
      [false, 0],
      [false, 0],
      [true, passes + 18],
    ]);
    assert.ok(passes >= 4 && passes < 10, `${passes} passes`);
  });

  it("leaves the renderer as it was", async () => {
    const [before, after] = await browser.page.evaluate(async () => {
      const { THREE, lambent } = window;
      const renderer = new THREE.WebGLRenderer();
      const gl = renderer.getContext();
      renderer.setSize(64, 48);
      const { userData } = await window.load("mirrors.glb");
      const asset = userData.lambent;
      asset.setLight(lambent.LambentLight.uniform([1, 1, 1]));
      const cube = new THREE.WebGLCubeRenderTarget(32);
      renderer.setViewport(3, 4, 50, 40);
      renderer.setScissor(5, 6, 30, 20);
      renderer.setScissorTest(true);
      renderer.setClearColor(0x336699, 0.25);
      renderer.toneMapping = THREE.ReinhardToneMapping;
      renderer.toneMappingExposure = 3;
      renderer.autoClear = true;
      renderer.xr.enabled = true;
      renderer.clippingPlanes = [new THREE.Plane(new THREE.Vector3(0, 1, 0), 0.1)];
      const state = () => ({
        target: renderer.getRenderTarget() === cube,
        face: renderer.getActiveCubeFace(),
        viewport: renderer.getViewport(new THREE.Vector4()).toArray(),
        currentViewport: renderer.getCurrentViewport(new THREE.Vector4()).toArray(),
        scissor: renderer.getScissor(new THREE.Vector4()).toArray(),
        scissorTest: renderer.getScissorTest(),
        clear: [renderer.getClearColor(new THREE.Color()).getHex(), renderer.getClearAlpha()],
        tone: [renderer.toneMapping, renderer.toneMappingExposure, renderer.outputColorSpace],
        clears: [renderer.autoClear, renderer.autoClearColor, renderer.autoClearDepth],
        xr: renderer.xr.enabled,
        planes: renderer.clippingPlanes.length,
        gl: [...gl.getParameter(gl.VIEWPORT), ...gl.getParameter(gl.SCISSOR_BOX)],
      });
      const all = [[], []];
      for (const target of [null, cube]) {
        renderer.setRenderTarget(target, target ? 2 : 0);
        renderer.clear();
        all[0].push(state());
        asset.mirrorSize = target ? 16 : 32; // captured anew
        asset.update(renderer);
        all[1].push(state());
      }
      asset.dispose();
      cube.dispose();
      renderer.dispose();
      return all;
    });
    assert.deepEqual(after, before);
  });

  it("shows the environment alone where halves cannot be drawn", async () => {
    const [without, off, on] = await browser.page.evaluate(async () => {
      const { renderer } = window;
      const state = { asset: "mirrors.glb", size: 64, environment: "environment.exr", background: true };
      const sum = async (more) => (await window.draw({ ...state, ...more })).bytes.join();
      const { has } = renderer.extensions;
      renderer.extensions.has = (name) => !name.startsWith("EXT_color_buffer") && has(name);
      const without = await sum({});
      renderer.extensions.has = has;
      return [without, await sum({ asset_: { mirrorSize: 0 } }), await sum({})];
    });
    assert.equal(without, off);
    assert.notEqual(on, off);
  });

  it("has no word of mirrors in the programs of assets without them", async () => {
    const found = await browser.page.evaluate(async () => {
      const out = {};
      for (const name of ["matt", "patch", "mirror"]) {
        const { scene, userData } = await window.load(`${name}.glb`);
        userData.lambent.update(window.renderer);
        out[name] = scene.children.map(({ material: { shaders } }) =>
          shaders.fragment.includes("bool capturing"),
        );
        userData.lambent.dispose();
      }
      return out;
    });
    assert.ok(![...found.matt, ...found.patch].includes(true));
    assert.ok(!found.mirror.includes(false));
  });

  for (const file of ["patch.glb", "mirrors.glb"])
    it(`comes back after the context was lost: ${file}`, async () => {
      const [before, after] = await browser.page.evaluate(async (file) => {
        const { THREE, lambent } = window;
        const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
        renderer.setSize(64, 64);
        const { scene, userData } = await window.load(file);
        const asset = userData.lambent;
        asset.setLight(lambent.LambentLight.uniform([1, 1, 1]));
        asset.mirrorSize = 32;
        const camera = new THREE.PerspectiveCamera();
        lambent.frameAutomatically(scene, camera, 1);
        const draw = () => {
          asset.update(renderer);
          renderer.render(scene, camera);
          const gl = renderer.getContext();
          const bytes = new Uint8Array(4 * 64 * 64);
          gl.readPixels(0, 0, 64, 64, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
          return bytes.reduce((a, b) => a + b, 0);
        };
        const sums = [draw()];
        const restored = new Promise((done) =>
          renderer.domElement.addEventListener("webglcontextrestored", () => setTimeout(done, 0)),
        );
        renderer.forceContextLoss();
        await new Promise((done) => setTimeout(done, 50));
        renderer.forceContextRestore();
        await restored;
        sums.push(draw());
        asset.dispose();
        renderer.dispose();
        return sums;
      }, file);
      browser.problems(); // three tells of the loss itself
      assert.ok(before > 64 * 64 * 255, "something was lit");
      assert.equal(after, before);
    });

  it("a damaged file is an error of the load, in words", async () => {
    const messages = await browser.page.evaluate(async () => {
      const whole = new Uint8Array(await (await fetch("glossy.glb")).arrayBuffer());
      const found = [];
      for (const change of [
        (b) => b.subarray(0, b.length >> 1),
        (b) => b.subarray(0, 10),
        (b) => b.fill(0xff, b.length - 5000, b.length),
      ]) {
        const url = URL.createObjectURL(new Blob([change(whole.slice())]));
        found.push(
          await window.load(url).then(
            () => "loaded",
            (error) => String(error.message ?? error),
          ),
        );
        URL.revokeObjectURL(url);
      }
      return found;
    });
    assert.match(messages[0], /end of its buffer|Invalid typed array length|out of bounds/i);
    assert.notEqual(messages[1], "loaded");
    assert.match(messages[2], /not finite/);
    browser.problems();
  });

  it("three's own probe of the environment, made on the GPU, lights as the environment does", async () => {
    const [own, probe] = await browser.page.evaluate(async () => {
      const { THREE, lambent, renderer } = window;
      const map = await window.environmentOf("environment.exr");
      map.mapping = THREE.EquirectangularReflectionMapping;
      const cube = new THREE.WebGLCubeRenderTarget(64, {
        type: THREE.FloatType,
        magFilter: THREE.NearestFilter,
        minFilter: THREE.NearestFilter,
      });
      cube.fromEquirectangularTexture(renderer, map);
      const { LightProbeGenerator } = await window.probes;
      const made = await LightProbeGenerator.fromCubeRenderTarget(renderer, cube);
      const out = [
        lambent.LambentLight.fromEquirectangular(map, 3),
        lambent.LambentLight.fromLightProbe(made),
      ];
      map.dispose();
      cube.dispose();
      return out.map((light) => [...light.coefficients]);
    });
    const size = Math.hypot(...own);
    own.forEach((value, i) =>
      assert.ok(
        Math.abs(value - probe[i]) < 0.01 * size,
        `coefficient ${i}: ${probe[i]}, not ${value}`,
      ),
    );
  });

  it("frees what it made", async () => {
    const sunny = {
      ...{ asset: "matt-kept.glb", background: true, sharpSun: true },
      sky: { sunElevation: 0.5 },
      air: { metresPerUnit: 100, shafts: true },
    };
    for (const what of [{ asset: "patch.glb" }, { asset: "mirrors.glb", asset_: { mirrorSize: 32 } }, sunny]) {
      const state = { ...what, truth: "truth-patch.png", size: kSize };
      const first = await browser.page.evaluate((s) => window.compare(s), state);
      const second = await browser.page.evaluate((s) => window.compare(s), state);
      assert.deepEqual(second.memory, first.memory);
      assert.equal(second.memory.geometries, 0);
    }
  });
});
