// <lambent-viewer> on a page of somebody else's: one script, one tag.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import {
  existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync,
} from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { after, before, describe, it } from "node:test";
import { environmentExr, mattScene } from "../../../web/three-lambent/test/support/scenes.mjs";
import { decodePng, meanDifference } from "./png.mjs";
import { axe, kSize, launch, tool, viewerModules } from "./session.mjs";

const kMost = 250_000; // bytes of lambent-viewer.js, three.js in it, as gzip sends them
const kPage = `<!doctype html><html lang="en"><title>A page</title>
<style>body { margin: 0 } lambent-viewer { width: ${kSize}px; height: ${kSize}px }</style>
<script type="module" src="lambent-viewer.js"></script>
<main><h1 hidden>A page</h1><div id="here"></div></main>`;

let folder, server, browser, page, address;
const complaints = [];

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "lambent-element-"));
  execFileSync(process.execPath, [join(viewerModules, "scripts/pack-element.mjs"), folder]);
  writeFileSync(join(folder, "index.html"), kPage);
  writeFileSync(join(folder, "scene.glb"), mattScene);
  writeFileSync(join(folder, "light.exr"), environmentExr);
  writeFileSync(join(folder, "poster.svg"), '<svg xmlns="http://www.w3.org/2000/svg"/>');
  execFileSync(tool, ["bake", "scene.glb", "-o", "matt.glb", "--directions", "256",
    "--keep-shadowed", "--quiet"], { cwd: folder });
  const types = { html: "text/html", js: "text/javascript", svg: "image/svg+xml" };
  server = createServer((request, response) => {
    const name = request.url.slice(1).replace(/\?.*/, "") || "index.html";
    if (!readdirSync(folder).includes(name)) return response.writeHead(404).end();
    const bytes = readFileSync(join(folder, name));
    response.writeHead(200, {
      "Content-Type": types[name.split(".").pop()] ?? "application/octet-stream",
      "Content-Length": bytes.length,
    });
    response.end(bytes);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  address = `http://127.0.0.1:${server.address().port}/`;
  browser = await launch();
  page = await browser.newPage({ viewport: { width: 640, height: 480 } });
  page.on("console", (message) => {
    const own = !/GPU stall|GL Driver/.test(message.text());
    if (["error", "warning"].includes(message.type()) && own) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(address);
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true });
});

/** Puts one there, and answers the events until it has loaded or failed. */
const put = (attributes) =>
  page.evaluate(async (all) => {
    await customElements.whenDefined("lambent-viewer");
    const element = document.createElement("lambent-viewer");
    const events = [];
    const over = new Promise((resolve) => {
      for (const type of ["progress", "load", "error"])
        element.addEventListener(type, (event) => {
          events.push({ type, ...event.detail });
          if (type !== "progress") resolve();
        });
    });
    for (const [name, value] of Object.entries(all)) element.setAttribute(name, value);
    document.querySelector("#here").replaceChildren(element);
    const posterAtFirst = element.shadowRoot.querySelector(".poster")?.checkVisibility() ?? false;
    if (all.src !== undefined) await over;
    return { events, posterAtFirst };
  }, attributes);
/** Sets attributes, and answers what the element said until nothing moves any more. */
const set = (attributes) =>
  page.evaluate(async (all) => {
    const element = document.querySelector("lambent-viewer");
    const said = [];
    const hear = (event) => said.push({ type: event.type, ...event.detail });
    for (const type of ["load", "error"]) element.addEventListener(type, hear);
    for (const [name, value] of Object.entries(all)) element.setAttribute(name, value);
    await element.updated;
    await element.viewer.settled();
    for (const type of ["load", "error"]) element.removeEventListener(type, hear);
    return said;
  }, attributes);
const view = () => page.evaluate(() => document.querySelector("lambent-viewer").view);

describe("<lambent-viewer>", () => {
  it("is one file of at most 250 kB, in a package that is whole", () => {
    const { exports, files, types } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    for (const name of [...files, types, exports["."].default])
      assert.ok(existsSync(join(folder, name)), name);
    const bytes = gzipSync(readFileSync(join(folder, "lambent-viewer.js")), { level: 9 }).length;
    console.log(`lambent-viewer.js: ${(bytes / 1000).toFixed(1)} kB as gzip sends it`);
    assert.ok(bytes <= kMost, `${bytes}`);
    assert.doesNotMatch(readFileSync(join(folder, "lambent-viewer.js"), "utf8"),
      /\bfrom\s*["']\.\/|\bimport\s*["'(]/, "it loads no other script");
  });

  it("shows what its attributes say, as lambent render does", async () => {
    const { events, posterAtFirst } = await put({
      src: "matt.glb?v=2", environment: "light.exr", poster: "poster.svg", rotation: "70",
      exposure: "-0.5", transfer: "shadowed", alt: "A ball on a floor", bare: "",
    });
    assert.ok(await page.evaluate(async () => {
      const { LambentViewerElement } = await import("/lambent-viewer.js");
      return document.querySelector("lambent-viewer") instanceof LambentViewerElement;
    }), "its class is exported");
    assert.ok(posterAtFirst, "the poster is there until there is a picture");
    assert.deepEqual(events.at(-1), { type: "load", src: "matt.glb?v=2", baked: true });
    const shares = events.flatMap((each) => (typeof each.share === "number" ? [each.share] : []));
    assert.ok(shares.length > 0 && shares.every((each) => each > 0 && each <= 1), `${shares}`);
    await set({ alt: "A ball" });
    assert.equal(await page.locator(".poster").isVisible(), false);
    assert.match(await page.locator("#picture").getAttribute("aria-label"), /^A ball\./);
    writeFileSync(join(folder, "view.json"), JSON.stringify(await view()));
    execFileSync(tool, ["render", "matt.glb", "--view", "view.json", "--size", `${kSize}x${kSize}`,
      "-o", "view.png", "--backend", "cpu", "--quiet"], { cwd: folder });
    const seen = decodePng(await page.locator("#picture").screenshot());
    const difference = meanDifference(seen, decodePng(readFileSync(join(folder, "view.png"))));
    console.log(`by lambent render and by the element: ${difference.toFixed(3)}/255`);
    assert.ok(difference < 0.5, `${difference}`);
    await page.evaluate(axe());
    const violations = await page.evaluate(async () =>
      (await window.axe.run(document)).violations.map(({ id, nodes }) =>
        `${id}: ${nodes.map((each) => each.target.flat().join(" "))}`));
    assert.deepEqual(violations.filter((each) => !each.startsWith("page-has-heading-one")), []);
  });

  it("follows its attributes, and says what makes no sense of them", async () => {
    const before = await view();
    assert.deepEqual(await set({ rotation: "0", exposure: "1", transfer: "best" }), []);
    const now = await view();
    const { environment, exposure, transfer } = now;
    assert.deepEqual([environment.rotation, exposure, transfer], [[0, 0, 0, 1], 1, "best"]);
    assert.deepEqual(now.camera, before.camera);
    await set({ environment: "sky:sun-elevation=30,sun-azimuth=200", exposure: "-5" });
    assert.match((await view()).environment.source, /^sky:/);
    const kept = await view();
    for (const [attributes, words] of [
      [{ exposure: "bright" }, /exposure="bright"/],
      [{ transfer: "all" }, /transfer="all".*shadowed/],
      [{ environment: "none.exr" }, /none\.exr.*404/],
      [{ environment: "sky:model=fast" }, /where the Sun stands is missing/],
      [{ src: "none.glb" }, /none\.glb: the server answers 404/],
      [{ src: "light.exr" }, /not a binary glTF/],
    ]) {
      const said = await set(attributes);
      assert.equal(said.at(-1)?.type, "error", JSON.stringify(attributes));
      assert.match(said.at(-1).message, words);
      const { exposure, transfer, environment } = await view();
      assert.deepEqual([transfer, environment], [kept.transfer, kept.environment]);
      await set({ exposure: "-5", transfer: "best", environment: kept.environment.source });
      assert.ok(exposure === kept.exposure || exposure === 0, `${exposure}`);
    }
    assert.deepEqual((await set({ src: "scene.glb" })).at(-1),
      { type: "load", src: "scene.glb", baked: false });
    assert.ok(complaints.every((each) => /404/.test(each)), `${complaints}`);
    complaints.length = 0;
  });

  it("has keys of its own while it has the focus, and the screen", async () => {
    await put({ src: "matt.glb", environment: "uniform:0.5" });
    const first = await view();
    await page.keyboard.press("ArrowLeft");
    assert.deepEqual(await view(), first, "without the focus keys are the page's");
    await page.locator("lambent-viewer").focus();
    await page.keyboard.press("ArrowLeft");
    assert.notDeepEqual((await view()).camera, first.camera);
    await page.keyboard.press("f");
    assert.deepEqual(await view(), first);
    await page.keyboard.press("Shift+F");
    await page.waitForFunction(() => document.fullscreenElement?.localName === "lambent-viewer");
    await page.getByRole("button", { name: "Leave the full screen" }).click();
    await page.waitForFunction(() => document.fullscreenElement === null);
  });

  it("gives everything back when it is taken away, and can come again", async () => {
    for (let i = 0; i < 20; ++i) {
      const { events } = await put({ src: "matt.glb", environment: "uniform:0.5" });
      assert.equal(events.at(-1).type, "load");
    }
    await page.evaluate(async () => {
      const element = document.querySelector("lambent-viewer");
      const { viewer } = element;
      document.querySelector("main").append(element);
      if (element.viewer !== viewer) throw new Error("it was only moved");
      element.remove();
      await Promise.resolve();
      await new Promise((resolve) => setTimeout(resolve));
      if (element.viewer !== null) throw new Error("it still holds a context");
      document.querySelector("#here").append(element);
      await element.updated;
      await element.viewer.settled();
    });
    assert.equal((await view()).environment.source, "uniform:0.5");
    // Taken away while it loads, it says nothing more.
    const said = await page.evaluate(async () => {
      const element = document.createElement("lambent-viewer");
      const events = [];
      for (const type of ["load", "error"]) element.addEventListener(type, () => events.push(type));
      element.setAttribute("src", "matt.glb");
      document.querySelector("#here").replaceChildren(element);
      await Promise.resolve();
      const { updated } = element;
      element.remove();
      await updated;
      return events;
    });
    assert.deepEqual(said, []);
    assert.deepEqual(complaints, []);
  });
});
