// What the page shows over a surface with meso-structure of how its patch lies.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, it } from "node:test";
import { ballScene } from "../../../web/three-lambent/test/support/scenes.mjs";
import { decodePng } from "./png.mjs";
import { picture, settled, tool, visiting } from "./session.mjs";

let report;
const visit = visiting("overlays", (folder) => {
  const lambent = (...all) =>
    execFileSync(tool, [...all.map(String), "--quiet"], { cwd: folder, encoding: "utf8" });
  writeFileSync(join(folder, "ball-scene.glb"), ballScene);
  lambent("rtt", "weave", "-o", "weave.rtt", "--positions", "24x24", "--views", 4,
    "--directions", 128, "--bounces", 1);
  report = JSON.parse(lambent("synthesize", "ball-scene.glb", "--rtt", "weave.rtt", "-o", "ball.glb",
    "--directions", 128, "--map-size", 512, "--vertices", 8000, "--mesh", "ball", "--json"));
  return ["ball.glb"];
});

/** Of few samples: meso-structure is slow without a GPU. */
const open = async () => {
  const page = await visit.open();
  await page.evaluate(() => window.lambent.viewer.change((view) => (view.samples = 2)));
  return page;
};
const shot = async (page) => {
  await settled(page);
  return decodePng(await picture(page));
};
/** Pixels that differ by more than a quarter of the range in some channel. */
function changed(a, b) {
  let count = 0;
  for (let i = 0; i < a.rgb.length; i += 3)
    count += [0, 1, 2].some((c) => Math.abs(a.rgb[i + c] - b.rgb[i + c]) > 64);
  return count;
}
const marks = (page) => page.evaluate(() => window.lambent.viewer.current.marks?.found ?? null);

describe("how a patch lies", () => {
  it("is shown and hidden by a key", async () => {
    const page = await open();
    const bare = await shot(page);
    assert.equal(await marks(page), null, "nothing is looked for before somebody asks");
    await page.keyboard.press("l");
    const over = await shot(page);
    const count = changed(bare, over);
    assert.ok(count > 1000, `${count} pixels`);
    await page.keyboard.press("l");
    assert.equal(changed(bare, await shot(page)), 0);
    assert.deepEqual(visit.opened.complaints, []);
  });
  it("is shown and hidden by switches, each for itself", async () => {
    const page = await open();
    const bare = await shot(page);
    for (const name of ["Field", "Singularities", "Cuts"]) {
      const control = page.getByRole("switch", { name, exact: true });
      await control.check();
      const count = changed(bare, await shot(page));
      assert.ok(count > 20, `${name}: ${count} pixels`);
      await control.uncheck();
      assert.equal(changed(bare, await shot(page)), 0, name);
    }
  });
  it("has the colours that it has, whatever the exposure", async () => {
    const page = await open();
    const cyan = async (exposure) => {
      await page.evaluate((to) => {
        // One sample: where marks cover half a pixel, the other half is the picture's.
        window.lambent.viewer.change((view) => Object.assign(view, { exposure: to, samples: 1 }));
        window.lambent.viewer.setOverlay("field", true);
      }, exposure);
      const { rgb } = await shot(page);
      let count = 0;
      for (let i = 0; i < rgb.length; i += 3) count += rgb[i + 1] - rgb[i] > 90;
      return count;
    };
    const [dark, bright] = [await cyan(-3), await cyan(2)];
    assert.ok(dark > 300 && Math.abs(dark / bright - 1) < 0.1, `${dark} and ${bright} pixels`);
  });
  it("is what the library found when it laid the patch", async () => {
    const page = await open();
    await page.keyboard.press("l");
    await settled(page);
    const [lay, ...others] = await marks(page);
    assert.equal(others.length, 0);
    const mesh = report.surfaces[0];
    assert.equal(lay.singularities.length, mesh.singularities, JSON.stringify(report));
    assert.equal(lay.turns, mesh.patch_symmetry.turns);
    assert.ok(lay.singularities.every(({ index }) => index === 1));
    assert.ok(lay.cuts.length > 10 && lay.field.length > 1600 && lay.field.length < 2400,
      `${lay.cuts.length} cuts, ${lay.field.length} strokes`);
  });
  it("is not offered where there is none", async () => {
    const page = await open();
    await page.evaluate(() => window.lambent.viewer.openAsset(1));
    await page.keyboard.press("l");
    await settled(page);
    assert.equal(await marks(page), null);
    assert.ok(await page.getByRole("switch", { name: "Seams", exact: true }).isDisabled());
  });
});
