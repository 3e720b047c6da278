// The page as a person meets it: what it asks of the network, what it does with files that are no
// good, keys, fingers, a narrow window, and a graphics context that goes away.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { join } from "node:path";
import { describe, it } from "node:test";
import { environmentExr, mattScene } from "../../../web/three-lambent/test/support/scenes.mjs";
import { withJson } from "./glb.mjs";
import { decodePng, meanDifference } from "./png.mjs";
import { drop, launch, openPage, picture, settled, tool, view, visiting } from "./session.mjs";

/** As Draco's encoders declare it. */
const withDraco = (glb) => {
  const name = "KHR_draco_mesh_compression";
  return withJson(glb, { extensionsUsed: [name], extensionsRequired: [name] });
};

const visit = visiting("page", (folder) => {
  writeFileSync(join(folder, "scene.glb"), mattScene);
  writeFileSync(join(folder, "light.exr"), environmentExr);
  execFileSync(tool, ["bake", "scene.glb", "-o", "matt.glb", "--directions", "256", "--quiet"], {
    cwd: folder,
  });
  return ["matt.glb", "light.exr"];
});
const open = (options) => visit.open(options);
const shot = async (page) => decodePng(await picture(page));
const message = (page) => page.locator(".message.error p").last().textContent({ timeout: 10_000 });

describe("the server", () => {
  const ask = (path, options = {}) =>
    new Promise((resolve, reject) => {
      const sent = request({ host: "127.0.0.1", port: visit.server.port, path, ...options }, (answer) => {
        let body = "";
        answer.on("data", (part) => (body += part));
        answer.on("end", () => resolve({ status: answer.statusCode, headers: answer.headers, body }));
      });
      sent.on("error", reject);
      sent.end();
    });

  it("answers with its policies, and keeps nothing in caches", async () => {
    const { status, headers } = await ask("/");
    assert.equal(status, 200);
    assert.match(headers["content-type"], /^text\/html/);
    assert.match(headers["content-security-policy"], /default-src 'none'/);
    assert.doesNotMatch(headers["content-security-policy"], /unsafe/);
    assert.equal(headers["x-content-type-options"], "nosniff");
    assert.equal(headers["cache-control"], "no-store");
    assert.equal((await ask("/files/asset.glb")).headers["content-type"], "model/gltf-binary");
  });
  it("has the asset and the light that were named, under fixed names", async () => {
    const manifest = JSON.parse((await ask("/manifest.json")).body);
    assert.equal(manifest.assets[0].name, "matt.glb");
    assert.deepEqual(manifest.environments[0].files, { "light.exr": "files/environment-0-0.exr" });
    assert.ok(manifest.assets.length > 1, "the page's own assets are still there");
  });
  it("gives nothing that is not on its list", async () => {
    for (const path of [
      "/../../../../../../etc/passwd",
      "/%2e%2e/%2e%2e/etc/passwd",
      "/files/../../scene.glb",
      "/files/scene.glb",
      "/scene.glb",
      "//etc/passwd",
      "/code/",
      "/files/asset.glb%00.html",
    ]) {
      const { status, body } = await ask(path);
      assert.ok(status >= 400 && !body.includes("root:"), `${path}: ${status}`);
    }
  });
  it("gives everything whole to a browser's tabs at once, whoever of them gives up", async () => {
    const context = await visit.browser.newContext();
    const failed = [];
    const tabs = await Promise.all([0, 1, 2, 3].map(async () => {
      const tab = await context.newPage();
      tab.on("requestfailed", (request) => {
        if (!request.url().endsWith("given-up")) failed.push(request.url());
      });
      await tab.goto(`${visit.server.url}icon.svg`);
      return tab;
    }));
    const wrong = await Promise.all(tabs.map((tab) => tab.evaluate(async () => {
      const sizes = new Map();
      const found = [];
      const names = ["assets/still-life.glb", "assets/studio.hdr", "sky.bin", "air.bin",
        "lambent-viewer.js", "manifest.json", "index.html", "assets/woven-knot.glb"];
      for (let round = 0; round < 5; ++round) {
        const stop = new AbortController();
        const left = fetch("/assets/still-life.glb?given-up", { signal: stop.signal })
          .then((answer) => answer.arrayBuffer())
          .catch(() => {});
        await Promise.all(names.map(async (name) => {
          try {
            const answer = await fetch(`/${name}`);
            const { byteLength } = await answer.arrayBuffer();
            const before = sizes.get(name) ?? byteLength;
            if (before !== byteLength) found.push(`${name}: ${byteLength}, ${before}`);
            sizes.set(name, byteLength);
          } catch (error) {
            found.push(`${name}: ${error}`);
          }
          stop.abort();
        }));
        await left;
      }
      return found;
    })));
    assert.deepEqual([wrong.flat(), failed], [[], []]);
    await context.close();
  });
  it("answers to no other name, and takes nothing in", async () => {
    for (const host of ["evil.example", `evil.example:${visit.server.port}`, "127.0.0.1", "localhost:1"])
      assert.equal((await ask("/manifest.json", { headers: { Host: host } })).status, 403, host);
    const named = { headers: { Host: `localhost:${visit.server.port}` } };
    assert.equal((await ask("/manifest.json", named)).status, 200);
    for (const method of ["POST", "PUT", "DELETE"])
      assert.ok((await ask("/manifest.json", { method })).status >= 400, method);
  });
});

describe("the page", () => {
  it("shows the asset under the light, and asks nobody else for anything", async () => {
    const page = await open();
    const first = await shot(page);
    const mean = first.rgb.reduce((sum, each) => sum + each, 0) / first.rgb.length;
    assert.ok(mean > 10, "the picture is not black");
    assert.equal((await view(page)).environment.source, "light.exr");
    const began = await page.evaluate(
      () => performance.getEntriesByName("lambent-first-view")[0].startTime);
    console.log(`first view ${began.toFixed(0)} ms after the navigation began`);
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("says what is wrong with a damaged file, and keeps what it showed", async () => {
    const page = await open();
    const first = await shot(page);
    const whole = readFileSync(join(visit.folder, "matt.glb"));
    const cases = [
      ["cut.glb", whole.subarray(0, whole.length >> 1), /cut\.glb/],
      ["not.glb", Buffer.from("something else"), /not\.glb: not a binary glTF/],
      ["packed.glb", withDraco(mattScene), /packed\.glb.*Draco.*lambent bake packed\.glb/],
      ["cut.exr", environmentExr.subarray(0, 900), /cut\.exr/],
      ["cut.hdr", Buffer.from("#?RADIANCE\n"), /cut\.hdr/],
      ["other.json", Buffer.from("{"), /other\.json/],
      ["view.json", Buffer.from('{"lambent": "view", "exposure": "much"}'), /"exposure"/],
      ["what.txt", Buffer.from("?"), /what\.txt.*\.glb/],
    ];
    for (const [name, bytes, expected] of cases) {
      await drop(page, { name, bytes });
      await page.locator(".message.error").waitFor();
      assert.match(await message(page), expected);
      await page.evaluate(() => window.lambent.viewer.messages.clearErrors());
      assert.ok(meanDifference(first, await shot(page)) < 0.01, `${name} changed the picture`);
    }
    assert.equal(await page.locator("#panel select").first().inputValue(), "matt.glb");
  });

  it("takes assets, lights and views that are dropped on it", async () => {
    const page = await open();
    const first = await shot(page);
    await drop(page, { name: "other.exr", bytes: environmentExr });
    await page.waitForFunction(() => window.lambent.view().environment.source === "other.exr");
    assert.ok(meanDifference(first, await shot(page)) < 0.01, "the same light by another name");
    const saved = await view(page);
    saved.exposure = 1;
    saved.environment.source = "uniform:0.5";
    await drop(page, { name: "saved.json", bytes: JSON.stringify(saved) });
    await page.waitForFunction(() => window.lambent.view().exposure === 1);
    assert.deepEqual(await view(page), saved);
    await drop(page, { name: "mine.glb", bytes: readFileSync(join(visit.folder, "matt.glb")) });
    await page.waitForFunction(() => 
      window.lambent.viewer.library.assets.some((a) => a.name === "mine.glb"));
    await settled(page);
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("opens a link with a view", async () => {
    const page = await open();
    await page.evaluate(() => window.lambent.viewer.change((v) => (v.exposure = -2)));
    const saved = await view(page);
    await visit.opened.context.close();
    const hash = new URLSearchParams({ view: JSON.stringify(saved) });
    visit.opened = await openPage(visit.browser, `${visit.server.url}#${hash}`);
    assert.deepEqual(await view(visit.opened.page), saved);
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("does what its keys say", async () => {
    const page = await open();
    const before = await view(page);
    await page.locator("#picture").focus();
    await page.keyboard.press("ArrowLeft");
    assert.notDeepEqual((await view(page)).camera, before.camera);
    await page.keyboard.press("f");
    assert.equal((await view(page)).camera, null);
    await page.keyboard.press("Shift+ArrowRight");
    assert.notDeepEqual((await view(page)).environment.rotation, before.environment.rotation);
    await page.keyboard.press("Control+ArrowRight");
    assert.notDeepEqual((await view(page)).object, before.object);
    await page.keyboard.press("1");
    assert.equal((await view(page)).transfer, "unshadowed");
    await page.keyboard.press("]");
    assert.ok(Math.abs((await view(page)).exposure - before.exposure - 1 / 3) < 0.01);
    await page.keyboard.press("t");
    assert.equal((await view(page)).tone, "linear");
    await page.keyboard.press("d");
    assert.equal((await view(page)).discs.length, 1);
    await page.keyboard.press("?");
    assert.ok(await page.locator("dialog.help").isVisible());
    await page.keyboard.press("Escape");
    assert.ok(!(await page.locator("dialog.help").isVisible()));
    await page.keyboard.press("r");
    assert.deepEqual(await view(page), before);
    // Every control can be reached by Tab, and shows that it was.
    const reached = new Set();
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => {
        const focused = document.activeElement;
        return focused.id || focused.textContent;
      }));
    }
    const controls = await page.evaluate(() =>
      [...document.querySelectorAll("#panel select, #panel button, #panel input[type=range]")]
        .filter((each) => each.offsetParent !== null && !each.disabled)
        .map((each) => each.id || each.textContent));
    for (const each of controls) assert.ok(reached.has(each), `Tab does not reach ${each}`);
  });

  it("turns, pans and zooms under fingers", async () => {
    const page = await open({ hasTouch: true, viewport: { width: 360, height: 740 } });
    const cdp = await visit.opened.context.newCDPSession(page);
    const touch = (type, ...points) =>
      cdp.send("Input.dispatchTouchEvent", {
        type,
        touchPoints: points.map(([x, y], id) => ({ x, y, id })),
      });
    const distance = ({ camera }) =>
      Math.hypot(...camera.position.map((each, i) => each - camera.target[i]));
    await touch("touchStart", [100, 150]);
    for (let x = 110; x <= 200; x += 10) await touch("touchMove", [x, 150]);
    await touch("touchEnd");
    const orbited = await view(page);
    assert.ok(orbited.camera !== null, "one finger orbits");
    await touch("touchStart", [150, 150], [200, 150]);
    for (let d = 5; d <= 50; d += 5) await touch("touchMove", [150 - d, 150], [200 + d, 150]);
    await touch("touchEnd");
    const zoomed = await view(page);
    assert.ok(distance(zoomed) < 0.6 * distance(orbited), "two fingers zoom");
    await page.locator("#grip label", { hasText: "Light" }).tap();
    await touch("touchStart", [100, 150]);
    for (let x = 110; x <= 200; x += 10) await touch("touchMove", [x, 150]);
    await touch("touchEnd");
    const turned = await view(page);
    assert.deepEqual(turned.camera, zoomed.camera);
    assert.notDeepEqual(turned.environment.rotation, zoomed.environment.rotation);
  });

  it("fits a window 360 pixels wide, with every control in reach", async () => {
    const page = await open({ hasTouch: true, viewport: { width: 360, height: 740 } });
    const overflow = () => page.evaluate(() =>
      [document.documentElement, document.body, ...document.querySelectorAll("#panel, .sections, section")]
        .filter((each) => each.scrollWidth > each.clientWidth + 1)
        .map((each) => each.id || each.className || each.tagName));
    await page.evaluate(() => window.lambent.viewer.addDisc());
    for (const tab of await page.getByRole("tab").all()) {
      await tab.tap();
      assert.deepEqual(await overflow(), []);
      const controls = page.locator("section.chosen").locator("button, select, input[type=range], input[role=switch], label");
      for (const control of await controls.all()) {
        if (!(await control.isVisible())) continue;
        await control.scrollIntoViewIfNeeded();
        const box = await control.boundingBox();
        assert.ok(box.x >= 0 && box.x + box.width <= 360.5 && box.y >= 0 && box.y + box.height <= 740.5,
          `${await control.evaluate((e) => e.outerHTML.slice(0, 80))} at ${JSON.stringify(box)}`);
      }
      const small = await page.evaluate(() =>
        [...document.querySelectorAll("#panel button, #panel select, .segments label")]
          .filter((e) => e.offsetParent !== null && !e.matches(".fold"))
          .filter((e) => e.getBoundingClientRect().height < 40)
          .map((e) => e.textContent));
      assert.deepEqual(small, [], "too small for a finger");
    }
    const canvas = await page.locator("#picture").boundingBox();
    assert.ok(canvas.height > 300, "the picture has room");
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("comes back when the graphics context was lost", async () => {
    const page = await open();
    const first = await shot(page);
    await page.evaluate(() => {
      const gl = window.lambent.viewer.current.renderer.getContext();
      window.lose = gl.getExtension("WEBGL_lose_context");
      window.lose.loseContext();
    });
    assert.match(await message(page), /graphics context/);
    await page.evaluate(() => window.lose.restoreContext());
    await page.locator(".message.error").waitFor({ state: "detached" });
    assert.ok(meanDifference(first, await shot(page)) < 0.05);
  });

  it("says so where there is no WebGL 2", async () => {
    const bare = await launch(["--disable-3d-apis"]);
    try {
      const page = await bare.newPage();
      await page.goto(visit.server.url);
      assert.match(await page.locator(".sorry").textContent(), /WebGL 2.*lambent view/s);
    } finally {
      await bare.close();
    }
  });
});
