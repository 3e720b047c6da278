// Pictures of every kind of asset in headless Chromium against those of the CPU: the mean difference
// is at most 1/255 of the tone-mapped range, of the whole picture and of the asset's own pixels.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import {
  ballScene,
  environmentExr,
  glossyScene,
  mattScene,
  mirrorScene,
  texelScene,
} from "./support/scenes.mjs";
import { lambent, noTool } from "./support/tool.mjs";

const kSize = 256;
const kDegree = Math.PI / 180;

/** About the vertical, counter-clockwise seen from above, as the tool's --rotate-y. */
const aboutY = (degrees) => [0, Math.sin((degrees * kDegree) / 2), 0, Math.cos((degrees * kDegree) / 2)];

describe("pictures against the CPU's", { skip: noTool }, () => {
  let folder;
  let browser;
  const keep = process.env.LAMBENT_KEEP_PICTURES;

  before(async () => {
    folder = keep || mkdtempSync(join(tmpdir(), "three-lambent-"));
    const scenes = { matt: mattScene, glossy: glossyScene, mirror: mirrorScene, texel: texelScene, ball: ballScene };
    for (const [name, bytes] of Object.entries(scenes)) writeFileSync(join(folder, `${name}-scene.glb`), bytes);
    writeFileSync(join(folder, "environment.exr"), environmentExr);
    const quick = ["--directions", 512, "--bounces", 1, "--quiet"];
    const bake = (scene, output, ...more) =>
      lambent(folder, "bake", `${scene}-scene.glb`, "-o", `${output}.glb`, ...quick, ...more);
    bake("matt", "matt");
    bake("matt", "matt-shadowed", "--transfer", "shadowed", "--bands", 4);
    bake("glossy", "glossy");
    bake("glossy", "glossy-float", "--encoding", "float32", "--bands", 4, "--glossy-bands", 6, "--transfer", "shadowed");
    bake("mirror", "mirror");
    bake("texel", "texel", "--texels", "sheet=48x40");
    const patch = ["--positions", "24x20", "--views", 4, "--directions", 128, "--bounces", 1, "--quiet"];
    lambent(folder, "rtt", "stucco", "-o", "patch.rtt", ...patch);
    lambent(folder, "rtt", "stucco", "-o", "patch16.rtt", ...patch, "--encoding", "float16", "--bands", 3);
    const spread = ["--directions", 256, "--map-size", 256, "--vertices", 8000, "--mesh", "ball", "--quiet"];
    lambent(folder, "synthesize", "ball-scene.glb", "--rtt", "patch.rtt", "-o", "patch.glb", "--patch-width", 0.5, ...spread);
    lambent(folder, "synthesize", "ball-scene.glb", "--rtt", "patch.rtt", "-o", "patch-shadowed.glb", "--transfer", "shadowed", ...spread);
    lambent(folder, "synthesize", "ball-scene.glb", "--rtt", "patch16.rtt", "-o", "tiled.glb", "--map", "uv", "--tiles", "9x6", ...spread);
    const script = await bundle(readFileSync(new URL("page/pictures.js", import.meta.url), "utf8"));
    browser = await openPage({ script, folder });
    await browser.page.waitForFunction("window.ready");
  });
  after(async () => {
    await browser?.close();
    if (folder && !keep) rmSync(folder, { recursive: true });
  });

  /** The tool's picture and the page's. `options` go to the tool, `state` to the page. */
  async function agree(name, asset, options = [], state = {}, source = "environment.exr") {
    const truth = `truth-${name}.png`;
    lambent(
      folder, "render", asset, "--light", source, "-o", truth, "--backend", "cpu", "--samples", 1,
      "--size", kSize, "--background", "--camera", "auto", "--quiet", ...(options.includes("--exposure") ? [] : ["--exposure", 0]), ...options,
    );
    const found = await browser.page.evaluate((s) => window.compare(s), {
      asset,
      truth,
      size: kSize,
      background: true,
      ...(source.startsWith("environment.exr") && { environment: "environment.exr" }),
      ...state,
    });
    if (keep) writeFileSync(join(folder, `web-${name}.png`), Buffer.from(found.picture.split(",")[1], "base64"));
    console.log(`${name}: ${found.own.toFixed(3)}/255 of the asset's pixels, ${found.all.toFixed(3)}/255 of all`);
    const problems = browser.problems();
    assert.deepEqual(problems, [], `the page complained: ${problems.join("\n")}`);
    assert.equal(found.error, 0, `WebGL error ${found.error}`);
    // A picture that shows nothing agrees with anything.
    assert.ok(found.covered > 0.1 && found.brightness > 10, `covered ${found.covered}, brightness ${found.brightness}`);
    assert.ok(found.own <= 1 && found.all <= 1, `${name}: ${found.own}/255, ${found.all}/255`);
    return found;
  }

  it("diffuse at vertices, with textures and vertex colours", () => agree("matt", "matt.glb"));
  it("… baked shadowed, of another number of bands", () => agree("matt-shadowed", "matt-shadowed.glb"));
  it("glossy at vertices", () => agree("glossy", "glossy.glb"));
  it("… with light fetched per pixel", () => agree("glossy-fetch", "glossy.glb", [], { incident: "fetch" }));
  it("… float32, of more rows than columns", () => agree("glossy-float", "glossy-float.glb"));
  it("… with another lobe", () => agree("glossy-lobe", "glossy.glb", ["--lobe", 40], { asset_: { lobeExponent: 40 } }));
  it("mirrors", () => agree("mirror", "mirror.glb"));
  it("texels, matt and glossy", () => agree("texel", "texel.glb"));
  it("meso-structure with an id map", () => agree("patch", "patch.glb"));
  it("… with light fetched per pixel", () => agree("patch-fetch", "patch.glb", [], { incident: "fetch" }));
  it("… unfiltered", () => agree("patch-nearest", "patch.glb", ["--filter", "off"], { asset_: { filter: false } }));
  it("… without macro-scale transfer", () => agree("patch-macro-off", "patch.glb", ["--macro", "off"], { asset_: { macro: false } }));
  it("… shadowed", () => agree("patch-shadowed", "patch-shadowed.glb", ["--macro", "shadowed"], { asset_: { transfer: "shadowed" } }));
  it("… as pasted on", () => agree("patch-flat", "patch.glb", ["--view-dependence", "off"], { asset_: { viewDependent: false } }));
  it("meso-structure over UVs, float16", () => agree("tiled", "tiled.glb"));

  for (const [name, asset] of [["matt", "matt.glb"], ["glossy", "glossy.glb"], ["mirror", "mirror.glb"], ["texel", "texel.glb"], ["patch", "patch.glb"]]) {
    it(`${name}, the environment turned`, () =>
      agree(`${name}-turned`, asset, ["--rotate-y", 70], { environmentRotation: aboutY(70) }));
    it(`${name}, the object turned and moved`, () =>
      agree(`${name}-moved`, asset, ["--rotate-y", -50], {
        objectRotation: aboutY(50),
        objectTranslation: [3, -1, 2],
      }));
  }

  it("linear tone curve, exposure, a disc in mirrors and in the light", () =>
    agree(
      "mirror-disc",
      "mirror.glb",
      ["--tone", "linear", "--exposure", -1],
      {
        tone: "linear",
        exposure: -1,
        discs: [{
          direction: { x: Math.cos(30 * kDegree) * Math.cos(50 * kDegree), y: Math.sin(50 * kDegree), z: Math.sin(30 * kDegree) * Math.cos(50 * kDegree) },
          diameter: 40 * kDegree,
          radiance: [3, 2, 1],
        }],
      },
      "environment.exr+disc:30,50,40,3/2/1",
    ));

  it("frees what it made", async () => {
    const state = { asset: "patch.glb", truth: "truth-patch.png", size: kSize };
    const first = await browser.page.evaluate((s) => window.compare(s), state);
    const second = await browser.page.evaluate((s) => window.compare(s), state);
    assert.deepEqual(second.memory, first.memory);
    assert.equal(second.memory.geometries, 0);
  });
});
