// What a person comes with and goes away with: links, what was open before, changes taken back,
// files that were not baked, the full screen, and the page in a folder.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { describe, it } from "node:test";
import { environmentExr, mattScene } from "../../../web/three-lambent/test/support/scenes.mjs";
import { withJson } from "./glb.mjs";
import { decodePng, meanDifference } from "./png.mjs";
import { drop, pageFolder, picture, serve, settled, tool, view, visiting } from "./session.mjs";

let baked;
const visit = visiting("visits", (folder) => {
  writeFileSync(join(folder, "scene.glb"), mattScene);
  writeFileSync(join(folder, "light.exr"), environmentExr);
  execFileSync(tool, ["bake", "scene.glb", "-o", "matt.glb", "--directions", "256", "--quiet"], {
    cwd: folder,
  });
  baked = readFileSync(join(folder, "matt.glb"));
  return ["matt.glb", "light.exr"];
});
const open = (hash = "", options = {}) => visit.open(options, hash);
const shown = (page) =>
  page.evaluate(() => window.lambent.viewer.current.loaded?.name ?? null);
const errors = (page) => page.locator(".message.error p").allTextContents();
const notes = (page) => page.locator(".message.note p").allTextContents();
/** Waits until a note says so (words, or a pattern), and tells what was said if none does. */
async function says(page, what) {
  const heard = new Set();
  const said = (note) => (typeof what === "string" ? note.includes(what) : what.test(note));
  for (const end = Date.now() + 10_000; Date.now() < end; await page.waitForTimeout(50)) {
    for (const note of await notes(page)) heard.add(note);
    if ([...heard].some(said)) return;
  }
  assert.fail(`no note says ${what}: ${[...heard].join(" | ") || "there was none"}`);
}
const change = (page, part) =>
  page.evaluate((all) => window.lambent.viewer.change((v) => Object.assign(v, all)), part);
/** The link that the page's own button makes. */
async function copiedHash(page) {
  await page.getByRole("button", { name: "Copy link" }).click();
  return new URL(page.url()).hash;
}

describe("a link", () => {
  it("names its asset and opens it, of the list or from an address", async () => {
    let page = await open();
    await page.evaluate(() => window.lambent.viewer.openAsset(1));
    await change(page, { exposure: -2 });
    const saved = await view(page);
    const hash = await copiedHash(page);
    assert.match(hash, /asset=Still\+life/);
    await visit.opened.context.close();
    page = await open(hash);
    assert.deepEqual([await shown(page), await view(page)], ["Still life", saved]);
    // The address is edited: another asset, another view.
    const other = new URLSearchParams({ src: "files/asset.glb", view: JSON.stringify(saved) });
    await page.evaluate((text) => (location.hash = text), String(other));
    await page.waitForFunction(() => window.lambent.viewer.current.loaded.name === "asset.glb");
    await page.evaluate(() => (location.hash = "asset=matt.glb"));
    await page.waitForFunction(() => window.lambent.viewer.current.loaded.name === "matt.glb");
    assert.deepEqual(visit.opened.complaints, []);
    await page.evaluate(() => (location.hash = "src=http://127.0.0.1:9/x.glb"));
    await page.locator(".message.error").waitFor();
    assert.match((await errors(page)).join(), /127\.0\.0\.1:9 .*content policy.*Download/);
    assert.equal(await shown(page), "matt.glb", "what was shown stays");
  });

  it("that is damaged, or newer, says so over the page's own scene", async () => {
    for (const [i, [hash, words]] of [
      ["#view=%7B%22lambent%22%3A", /cannot be read.*part of the link is missing/],
      ["#src=files/none.glb", /none\.glb: the server answers 404/],
      ["#asset=matt.glb&view=%7B%22lambent%22%3A%22view%22%2C%22version%22%3A2%7D", /newer page/],
      ["#view=%7B%22lambent%22%3A%22view%22%2C%22exposure%22%3A%22much%22%7D", /"exposure"/],
      ["#nonsense", /neither an asset nor a view/],
      [`#view=${encodeURIComponent('{"lambent":"view","environment":{"source":"sky:hue=1"}}')}`,
        /no key 'hue'/],
    ].entries()) {
      const { page } = visit.opened ?? {};
      if (i >= 2) {
        await page.evaluate((text) => {
          window.lambent.viewer.messages.clearErrors();
          location.hash = text;
        }, hash);
        await page.locator(".message.error").waitFor();
      } else {
        await visit.opened?.context.close();
        await open(hash);
      }
      assert.match((await errors(visit.opened.page)).join(), words, hash);
      assert.equal(await shown(visit.opened.page), "matt.glb", hash);
    }
  });

  it("to a file of a disk says that it has to be opened by hand, and waits for it", async () => {
    let page = await open();
    const light = { name: "mine.exr", bytes: environmentExr };
    await drop(page, light, { name: "mine.glb", bytes: baked });
    await page.waitForFunction(() => window.lambent.viewer.current.loaded.name === "mine.glb");
    await change(page, { exposure: 0.7 });
    const hash = await copiedHash(page);
    await says(page, /mine\.glb and mine\.exr.*by hand/);
    assert.match(hash, /file=mine\.glb.*light=mine\.exr/);
    const saved = await view(page);
    await visit.opened.context.close();
    page = await open(hash);
    assert.equal(await shown(page), "matt.glb");
    await says(page, /shows mine\.glb and mine\.exr.*open the files here/);
    await drop(page, { name: "mine.glb", bytes: baked });
    await page.waitForFunction(() => window.lambent.viewer.current.loaded.name === "mine.glb");
    assert.notEqual((await view(page)).exposure, 0.7, "the light is missing yet");
    await drop(page, { name: "mine.exr", bytes: environmentExr });
    await page.waitForFunction(() => window.lambent.view().exposure === 0.7);
    assert.deepEqual(await view(page), saved);
    assert.deepEqual(visit.opened.complaints, []);
    // A light of another server's list.
    const other = { ...saved, exposure: -1, environment: { source: "other.exr" } };
    const link = new URLSearchParams({ asset: "matt.glb", view: JSON.stringify(other) });
    await page.evaluate((text) => (location.hash = text), String(link));
    await page.locator(".message.error").waitFor();
    assert.match((await errors(page)).join(), /other\.exr: the page has no such light.*Drop/);
    await drop(page, { name: "other.exr", bytes: environmentExr });
    await page.waitForFunction(() => window.lambent.view().exposure === -1);
    assert.equal(await shown(page), "matt.glb");
  });
});

describe("a saved view", () => {
  it("of the page's own light is what lambent render --view shows", async () => {
    const page = await open("", { viewport: { width: 200, height: 200 } });
    await page.keyboard.press("h");
    await page.evaluate(() => window.lambent.viewer.openSource("assets/studio.hdr"));
    await change(page, { samples: 9 });
    await settled(page);
    const seen = decodePng(await page.screenshot());
    writeFileSync(join(visit.folder, "view.json"), JSON.stringify(await view(page)));
    execFileSync(tool, ["render", "matt.glb", "--view", "view.json", "--size", "200x200", "-o",
      "view.png", "--backend", "cpu", "--quiet"], { cwd: visit.folder });
    const difference = meanDifference(seen, decodePng(readFileSync(join(visit.folder, "view.png"))));
    assert.ok(difference < 0.5, `${difference}`);
  });
});

describe("the page", () => {
  it("remembers what was open, and goes back to how it began", async () => {
    const page = await open();
    const first = await view(page);
    await page.reload();
    await page.evaluate(() => window.lambent.ready);
    assert.deepEqual(await notes(page), [], "nothing was changed: nothing is remembered");
    await page.evaluate(() => window.lambent.viewer.openAsset(2));
    await change(page, { exposure: 1.5 });
    const left = await view(page);
    await page.reload();
    await page.evaluate(() => window.lambent.ready);
    assert.deepEqual([await shown(page), await view(page)], ["Woven knot", left]);
    await says(page, /as it was left/);
    await page.locator(".message").getByRole("button", { name: "Start afresh" }).click();
    await page.waitForFunction(() => window.lambent.viewer.current.loaded.name === "matt.glb");
    assert.deepEqual(await view(page), first);
    await page.reload();
    await page.evaluate(() => window.lambent.ready);
    assert.deepEqual([await notes(page), await view(page)], [[], first]);
    // What is no use any more is forgotten, not fallen over.
    await change(page, { exposure: 1.5 });
    await page.evaluate(() => {
      dispatchEvent(new Event("pagehide"));
      for (const key of Object.keys(localStorage))
        localStorage.setItem(key, localStorage.getItem(key).replace("matt.glb&", "gone.glb&"));
    });
    await page.reload();
    await page.evaluate(() => window.lambent.ready);
    assert.deepEqual([await shown(page), await view(page)], ["matt.glb", first]);
    await says(page, /before is no longer there/);
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("takes changes back and makes them again, a drag as one", async () => {
    const page = await open();
    const first = await view(page);
    const drag = async (x) => {
      await page.mouse.move(200, 200);
      await page.mouse.down();
      for (let i = 1; i <= 8; ++i) await page.mouse.move(200 + (x * i) / 8, 200);
      await page.mouse.up();
      return view(page);
    };
    const [left, right] = [await drag(-80), await drag(120)];
    await page.keyboard.press("t");
    await page.keyboard.press("u");
    await page.evaluate(() => window.lambent.viewer.openAsset(1));
    const other = await view(page);
    const step = async (key, name) => {
      await page.keyboard.press(key);
      await page.waitForFunction((to) => window.lambent.viewer.current.loaded.name === to, name);
      await page.evaluate(() => window.lambent.viewer.drawn());
      return view(page);
    };
    assert.equal((await step("Control+z", "matt.glb")).tone, "linear");
    assert.ok(await page.evaluate(() => window.lambent.viewer.unlit));
    await step("Control+z", "matt.glb");
    assert.ok(!(await page.evaluate(() => window.lambent.viewer.unlit)));
    assert.deepEqual(await step("Control+z", "matt.glb"), right);
    assert.deepEqual(await step("Control+z", "matt.glb"), left);
    assert.deepEqual(await step("Control+z", "matt.glb"), first);
    assert.ok(await page.getByRole("button", { name: "Undo" }).isDisabled());
    for (let i = 0; i < 4; ++i) await step("Control+Shift+Z", "matt.glb");
    assert.deepEqual(await step("Control+Shift+Z", "Still life"), other);
    assert.ok(await page.getByRole("button", { name: "Redo" }).isDisabled());
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("shows what is not baked as three.js does, and how to bake it", async () => {
    const page = await open();
    await change(page, { samples: 1 });
    await drop(page, { name: "my scene.glb", bytes: mattScene });
    await page.waitForFunction(() => window.lambent.viewer.current.loaded.name === "my scene.glb");
    const line = "lambent bake 'my scene.glb' -o 'my scene-baked.glb'";
    await says(page, line);
    assert.equal(await page.locator(".bake code").textContent(), line);
    assert.ok(await page.getByLabel("Shadows", { exact: true }).isDisabled());
    const shot = async () => decodePng(await picture(page));
    const lit = await shot();
    const mean = lit.rgb.reduce((sum, each) => sum + each, 0) / lit.rgb.length;
    assert.ok(mean > 20 && mean < 235, `${mean}`);
    // Light that is turned comes from where it comes from on a baked asset.
    const turned = async (degrees) => {
      const half = (degrees * Math.PI) / 360;
      const { environment } = await view(page);
      environment.rotation = [0, Math.sin(half), 0, Math.cos(half)];
      await change(page, { environment });
      return shot();
    };
    const [right, wrong] = [await turned(80), await turned(-80)];
    await page.evaluate(() => window.lambent.viewer.openAsset(0));
    const truth = await turned(80);
    const off = (each) => meanDifference(truth, each, null);
    assert.ok(2 * off(right) < off(wrong), `${off(right)} ${off(wrong)}`);
    await page.evaluate(() => window.lambent.viewer.openAsset(3));
    await turned(0);
    await page.evaluate(() => window.lambent.viewer.addDisc());
    assert.ok(meanDifference(lit, await shot()) > 1, "a disc of light lights it");
    await page.evaluate(() => window.lambent.viewer.openSource("uniform:0.2"));
    assert.ok(meanDifference(lit, await shot()) > 5, "another environment does");
    for (const [name, part] of [
      ["generator.glb", { asset: { version: "2.0", generator: "Lambent 1.3" } }],
      ["extras.glb", { asset: { version: "2.0", extras: { lambent: { baked: "1.3" } } } }],
    ]) {
      await drop(page, { name, bytes: withJson(mattScene, part) });
      await page.waitForFunction((to) => window.lambent.viewer.current.loaded.name === to, name);
      await says(page, new RegExp(`${name}.*stripped by an optimiser`));
    }
    await page.evaluate(() => window.lambent.viewer.openAsset(0));
    await settled(page);
    assert.equal(await page.locator(".bake").isVisible(), false);
    assert.doesNotMatch((await notes(page)).join(), /stripped/, "that is said no longer");
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("is given what is not baked by lambent view --web as well", async () => {
    const other = await serve(visit.folder, ["scene.glb"]);
    const { assets } = await (await fetch(`${other.url}manifest.json`)).json();
    assert.equal(assets[0].name, "scene.glb");
    assert.equal(await other.stop(), 0);
  });

  it("fills the screen and leaves it, by its button and its key", async () => {
    const page = await open();
    const full = (on) =>
      page.waitForFunction((wanted) => (document.fullscreenElement !== null) === wanted, on);
    await page.getByRole("button", { name: "Fill the screen" }).click();
    await full(true);
    await page.keyboard.press("Shift+F");
    await full(false);
    await page.locator("#picture").focus();
    await page.keyboard.press("Shift+F");
    await full(true);
    await page.getByRole("button", { name: "Leave the full screen" }).click();
    await full(false);
  });

  it("moves nothing by itself where a browser asks for that", async () => {
    const page = await open("", { reducedMotion: "reduce" });
    await page.keyboard.press("a");
    assert.equal(await page.evaluate(() => window.lambent.viewer.playing), false);
    await says(page, /reduced motion/);
    assert.ok(await page.getByLabel("Let it go round").isDisabled());
    const moving = await page.evaluate(() => {
      const all = [document, document.querySelector("lambent-viewer").shadowRoot].flatMap((root) =>
        [...root.querySelectorAll("*")]);
      const still = /^(0s|0s(, 0s)*)$/;
      return all.filter((each) => {
        const { transitionDuration, animationName } = getComputedStyle(each);
        return !still.test(transitionDuration) || animationName !== "none";
      }).length;
    });
    assert.equal(moving, 0);
  });

  it("from a folder says what to do", async () => {
    const context = await visit.browser.newContext();
    const page = await context.newPage();
    await page.goto(pathToFileURL(join(pageFolder, "index.html")).href);
    const sorry = page.locator(".from-folder");
    assert.ok(await sorry.isVisible());
    assert.match(await sorry.textContent(), /opened from a folder.*lambent view --web/s);
    const box = await sorry.boundingBox();
    assert.ok(box.width > 600 && box.x === 0, JSON.stringify(box));
    await context.close();
    const served = await open();
    assert.equal(await served.locator(".from-folder").isVisible(), false);
  });
});
