// <LambentAsset> of three-lambent/react in Chromium, in React's strict mode, on a canvas that draws
// on demand: shown, given other props, unmounted and freed.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { bundle, openPage } from "./support/browser.mjs";
import { glb, parseGlb } from "./support/glb.mjs";

const read = (path) => readFileSync(new URL(path, import.meta.url));
const square = read("../../../spec/samples/unoccluded-square.glb");
const layouts = read("../../../spec/samples/every-layout.glb");

/** The same without transfer, and with a fault. */
function changed(change) {
  const { json, bin } = parseGlb(square);
  change(json);
  return glb(json, bin);
}
const plain = changed((json) => {
  delete json.extensions;
  delete json.meshes[0].primitives[0].extensions;
});
const damaged = changed((json) => (json.extensions.LAMBENT_radiance_transfer.bands = 11));

describe("a component", () => {
  let browser;
  let page;
  const show = (list) => page.evaluate((l) => globalThis.show(l), list);
  const loaded = (count) => page.evaluate((c) => globalThis.waitForAssets(c), count);
  const picture = () => page.evaluate(() => globalThis.picture());
  const memory = () => page.evaluate(() => globalThis.memory());

  before(async () => {
    const script = await bundle(read("page/react.js").toString());
    const files = { "a.glb": square, "b.glb": layouts, "plain.glb": plain, "bad.glb": damaged };
    browser = await openPage({ script, files });
    ({ page } = browser);
    await page.waitForFunction("globalThis.show");
  });
  after(() => browser?.close());

  it("shows an asset, follows its props, and frees it", async () => {
    await show([]);
    await picture();
    const empty = await memory();
    for (let round = 0; round < 2; ++round) {
      await show([{ url: "/a.glb" }]);
      assert.deepEqual(await loaded(1), { found: 1, failure: null });
      const lit = await picture();
      assert.ok(
        lit.every((half) => half > 20),
        `${lit}`,
      );
      // From the side a square that faces up gets little; turned towards the light it gets more.
      await show([{ url: "/a.glb", light: "side" }]);
      const [lying] = await picture();
      await show([{ url: "/a.glb", light: "side", rotation: [0, 0, -0.7] }]);
      const [leaning] = await picture();
      assert.ok(leaning > 1.3 * lying, `${lying} → ${leaning}`);
      await show([{ url: "/a.glb", light: "side", rotation: [0, 0, -0.7], unlit: true }]);
      const [unlit] = await picture();
      await show([{ url: "/a.glb", light: "side", rotation: [0, 0, -0.7] }]);
      assert.ok(Math.abs((await picture())[0] - leaning) < 0.5, "a prop that is left out again");
      assert.notEqual(unlit, leaning);
      assert.ok((await memory()).geometries > empty.geometries);
      await show([]);
      assert.deepEqual(await picture(), [0, 0]);
      assert.deepEqual(await memory(), empty, `round ${round}`);
    }
  });

  it("shows two assets with lights of their own, and another URL", async () => {
    await show([]);
    await show([{ url: "/a.glb" }, { url: "/a.glb", light: "side", position: [3, 0, 0] }]);
    assert.deepEqual(await loaded(2), { found: 2, failure: null });
    const [left, right] = await picture();
    assert.ok(left > 0 && right > 0 && Math.abs(left - right) > 3, `${left}, ${right}`);
    await show([{ url: "/b.glb" }]);
    assert.equal((await loaded(1)).failure, null);
    const many = await picture();
    assert.ok(Math.max(...many) > 3, `${many}`);
    await show([]);
    await picture();
    assert.equal((await memory()).geometries, 0);
  });

  it("shows what somebody else loaded, who frees it", async () => {
    await page.evaluate(() => globalThis.showLoaded("/a.glb"));
    assert.equal((await loaded(1)).failure, null);
    assert.ok((await picture())[0] > 20);
    await show([]);
    assert.ok((await memory()).geometries > 0);
    await page.evaluate(() => globalThis.given.dispose());
    assert.equal((await memory()).geometries, 0);
  });

  it("throws what fails to the boundary around it", async () => {
    assert.deepEqual(
      browser.problems().filter((text) => !/THREE.Clock/.test(text)),
      [],
    );
    for (const [url, pattern] of [
      ["/none.glb", /404/],
      ["/plain.glb", /carries no transfer.*lambent bake/],
      ["/bad.glb", /LambentFormatError.*bands/],
    ]) {
      await show([]);
      await show([{ url }]);
      const { found, failure } = await loaded(1);
      assert.equal(found, 0, url);
      assert.match(failure, pattern);
    }
    browser.problems();
  });
});
