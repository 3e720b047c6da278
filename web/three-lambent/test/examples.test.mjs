// The programs of examples/, as they are, with a sample of the format as their baked.glb.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, it } from "node:test";
import { fileURLToPath } from "node:url";
import { bundle, openPage } from "./support/browser.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const [sample, square] = ["every-layout", "unoccluded-square"].map((name) =>
  readFileSync(new URL(`../../../spec/samples/${name}.glb`, import.meta.url)),
);

/** The largest of the differences between pixels that a canvas shows and its corner. */
async function contrast(page) {
  const png = (await page.screenshot()).toString("base64");
  return page.evaluate(async (data) => {
    const bitmap = await createImageBitmap(
      await (await fetch(`data:image/png;base64,${data}`)).blob(),
    );
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const pixels = context.getImageData(0, 0, bitmap.width, bitmap.height).data;
    return pixels.reduce((most, v, i) => Math.max(most, v - pixels[i % 4]), 0);
  }, png);
}

async function shows(path, { prepare = "", baked = sample, beside = /THREE.Clock/ } = {}) {
  const script = await bundle(`${prepare} await import("../examples/${path}");`);
  const browser = await openPage({ script, files: { "baked.glb": baked } });
  try {
    await browser.page.setViewportSize({ width: 128, height: 96 });
    let most = 0;
    for (let i = 0; i < 100 && most < 60; ++i) {
      await new Promise((done) => setTimeout(done, 100));
      most = await contrast(browser.page);
    }
    assert.ok(most >= 60, `${path} shows nothing`);
    const said = browser.problems().filter((text) => !beside.test(text));
    assert.deepEqual(said, []);
  } finally {
    await browser.close();
  }
}

describe("examples", () => {
  it("three", () => shows("three/main.js"));
  // Chromium as it comes has no WebGPU here, and says so.
  it("three, by WebGPURenderer", () =>
    shows("three/webgpu.js", { baked: square, beside: /WebGPU|adapter/ }));
  it("react", () =>
    shows("react/main.tsx", {
      prepare:
        'document.body.insertAdjacentHTML("beforeend", `<div id="root" style="height:100vh">`);',
    }));

  it("are strict TypeScript", () => {
    const file = join(root, "tsconfig.examples.json");
    const compilerOptions = {
      ...{ target: "ES2022", module: "ESNext", moduleResolution: "bundler", strict: true },
      ...{ jsx: "react-jsx", noEmit: true, skipLibCheck: true, types: [] },
      ...{ allowJs: true, checkJs: true, lib: ["ES2022", "DOM"] },
      paths: { "three-lambent": ["./dist/index.d.ts"], "three-lambent/*": ["./dist/*/index.d.ts"] },
    };
    const files = ["examples/three/main.js", "examples/three/webgpu.js", "examples/react/main.tsx"];
    writeFileSync(file, JSON.stringify({ compilerOptions, files }));
    try {
      execFileSync("node", [join(root, "node_modules/typescript/bin/tsc"), "-p", file], {
        encoding: "utf8",
      });
    } catch (error) {
      assert.fail(`${error.stdout ?? error}`);
    } finally {
      rmSync(file);
    }
  });
});
