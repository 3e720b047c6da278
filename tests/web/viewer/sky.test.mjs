// Skies in the page: the same picture as by `lambent render --view`, what it says of skies that it has
// not, and its controls.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, it } from "node:test";
import { ballScene } from "../../../web/three-lambent/test/support/scenes.mjs";
import { decodePng, meanDifference } from "./png.mjs";
import { kSize, tool, visiting } from "./session.mjs";

const visit = visiting("sky", (folder) => {
  writeFileSync(join(folder, "scene.glb"), ballScene);
  execFileSync(tool, ["bake", "scene.glb", "-o", "ball.glb", "--directions", "256", "--quiet"], {
    cwd: folder,
  });
  return ["ball.glb"];
});
const open = (options) => visit.open(options);
const source = (page) => page.evaluate(() => window.lambent.view().environment.source);

const kBound = 0.5; // 1/255
/** [SOURCE, exposure] */
const kSkies = [
  ["sky:sun-elevation=50,sun-azimuth=200", -5],
  ["sky:sun-elevation=4,sun-azimuth=-10,turbidity=4", -2],
  ["sky:sun-elevation=-4,sun-azimuth=30", 4.5],
  ["sky:date=2026-06-21,time=05:40,utc-offset=+2,lat=46.2,lon=6.1", -1],
  ["sky:sun-elevation=20,sun-azimuth=300,model=preetham,turbidity=3+uniform:0.1", -4],
  ["sky:sun-elevation=40,model=cie-overcast", -3],
  ["sky:sun-elevation=25,sun-azimuth=200,model=perez,direct-normal=300,diffuse-horizontal=180", -4],
  ["sky:sun-elevation=35,sun-azimuth=20,model=asrc-cie", -4],
];

describe("a sky in the page", () => {
  it("is that of lambent render --view", async () => {
    const page = await open({ viewport: { width: kSize, height: kSize } });
    await page.keyboard.press("h");
    for (const [i, [text, exposure]] of kSkies.entries()) {
      const state = {
        lambent: "view",
        version: 1,
        // Level, and the horizon in the picture.
        camera: { position: [2.4, 0.9, 2.4], target: [0, 0.7, 0], verticalFov: 60 },
        environment: { source: text },
        exposure,
        samples: 9,
      };
      writeFileSync(join(visit.folder, "view.json"), JSON.stringify(state));
      execFileSync(tool, ["render", "ball.glb", "--view", "view.json", "--backend", "cpu",
        "--size", `${kSize}x${kSize}`, "-o", `${i}.png`, "--quiet"], { cwd: visit.folder });
      assert.ok(await page.evaluate((json) => window.lambent.showView(json), state), text);
      const expected = decodePng(readFileSync(join(visit.folder, `${i}.png`)));
      const seen = decodePng(await page.screenshot());
      const difference = meanDifference(expected, seen, null);
      console.log(`${text}: ${difference.toFixed(3)}/255`);
      assert.ok(difference < kBound, `${text}: ${difference}`);
      const last = kSize - 1;
      const mirrored = meanDifference(expected, seen, null, (x, y) => [last - x, y]);
      if (!text.includes("overcast")) assert.ok(mirrored > 2 * difference + 1, `mirrored ${mirrored}`);
    }
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("is seen through the air of a view, as by lambent render --view", async () => {
    const page = await open({ viewport: { width: kSize, height: kSize } });
    await page.keyboard.press("h");
    const state = {
      lambent: "view",
      version: 1,
      camera: { position: [2.4, 0.9, 2.4], target: [0, 0.7, 0], verticalFov: 40 },
      environment: { source: "sky:sun-elevation=25,sun-azimuth=140", rotation: [0, 0.6, 0, 0.8] },
      exposure: -4.5,
      air: { metresPerUnit: 3000 },
      samples: 4,
    };
    writeFileSync(join(visit.folder, "air.json"), JSON.stringify(state));
    execFileSync(tool, ["render", "ball.glb", "--view", "air.json", "--size", `${kSize}x${kSize}`,
      "-o", "air.png", "--quiet"], { cwd: visit.folder });
    const expected = decodePng(readFileSync(join(visit.folder, "air.png")));
    assert.ok(await page.evaluate((json) => window.lambent.showView(json), state));
    const shown = async (on, part) => {
      await page.evaluate(async ([air, how]) => {
        await window.lambent.viewer.sky.showAir(air, how);
        await window.lambent.viewer.settled();
      }, [on, part]);
      return decodePng(await page.screenshot());
    };
    await page.evaluate(() => window.lambent.viewer.settled());
    const hazy = decodePng(await page.screenshot());
    const clear = await shown(false, {});
    const difference = meanDifference(expected, hazy, null);
    console.log(`through the air: ${difference.toFixed(3)}/255`);
    assert.ok(difference < kBound, `${difference}`);
    assert.ok(meanDifference(expected, clear, null) > 5 * difference + 1, "there is air");
    const { air } = await page.evaluate(() => window.lambent.view());
    assert.equal(air, null, "a view without air is saved without");
    const shafts = await shown(true, { shafts: true });
    const saved = await page.evaluate(() => window.lambent.view());
    assert.deepEqual(saved.air, { metresPerUnit: 3000, shafts: true });
    assert.ok(meanDifference(hazy, shafts, null) > 0.05, "there are shafts");
    const again = await shown(false, { shafts: false });
    assert.equal(meanDifference(clear, again, null), 0);
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("that the page has not is told apart from one that cannot be", async () => {
    const page = await open();
    for (const [text, words] of [
      ["sky:sun-elevation=10,albedo=0.3", /knows no albedo.*lambent render/],
      ["sky:sun-elevation=10,model=exact", /has not the model exact.*lambent render/],
      ["sky:sun-elevation=10,direct-normal=300", /of the models perez and asrc-cie/],
      ["sky:sun-elevation=10,atmosphere=hazy", /knows no atmosphere/],
      ["sky:sun-elevation=10,hue=3", /no key 'hue'/],
      ["sky:sun-elevation=-30", /night/],
      ["sky:date=2026-02-30,time=12:00,lat=0,lon=0", /no day/],
      ["sky:date=2026-02-03,time=12:00,lat=0", /lon is missing/],
      ["sky:sun-elevation=1,lat=3", /give one of them/],
      ["sky:sun-elevation=1,turbidity=20", /turbidity: 20 is not within 1 to 10/],
      ["sky:", /KEY=VALUE/],
      ["sky:sun-elevation=10+sky:sun-elevation=20", /one sky at a time/],
    ]) {
      const taken = await page.evaluate(
        (environment) => window.lambent.showView({ lambent: "view", environment }),
        { source: text },
      );
      assert.equal(taken, false, text);
      const said = await page.locator(".message.error p").last().textContent();
      assert.match(said, words);
    }
    assert.equal((await source(page)).startsWith("sky:"), false);
  });

  it("follows its controls, and gives the old light back", async () => {
    const page = await open({ viewport: { width: 1100, height: 720 } });
    const before = await page.evaluate(() => window.lambent.view());
    const control = (label) => page.getByLabel(label, { exact: true });
    const move = (label, value) =>
      control(label).evaluate((input, to) => {
        input.value = to;
        input.dispatchEvent(new Event("input", { bubbles: true }));
      }, String(value));
    const follows = (expected) =>
      page.waitForFunction((text) => window.lambent.view().environment.source === text, expected);
    await control("Light from a sky").check();
    await follows("sky:date=2026-06-21,time=10:00,utc-offset=1,lat=46.2,lon=6.14");
    const noon = (await page.evaluate(() => window.lambent.view())).exposure;
    await move("Time", 1255);
    await move("Haze", 4);
    await control("Place").selectOption("Tokyo");
    await control("Model").selectOption("Preetham");
    await control("Date").fill("2026-09-01");
    await move("Time", 1070);
    await follows(
      "sky:date=2026-09-01,time=17:50,utc-offset=9,lat=35.68,lon=139.69,model=preetham,turbidity=4");
    const dusk = (await page.evaluate(() => window.lambent.view())).exposure;
    assert.ok(dusk > noon + 2, `the exposure follows: ${noon}, ${dusk}`);
    await move("Time", 60);
    await page.waitForFunction(
      () => /night/.test(document.querySelector("#sky-facts").textContent));
    assert.match(await source(page), /time=17:50/, "the last sky stays");
    const air = () => page.evaluate(() => window.lambent.view().air);
    assert.equal(await air(), null);
    assert.ok(await control("Metres in one unit").isHidden());
    await control("Seen through the air").check();
    await page.waitForFunction(() => window.lambent.viewer.current.air !== null);
    await move("Metres in one unit", 2);
    assert.equal(await page.evaluate(() => window.lambent.view().air.metresPerUnit), 100);
    await control("Seen through the air").uncheck();
    assert.equal(await air(), null);
    await control("Light from a sky").uncheck();
    await follows(before.environment.source);
    assert.deepEqual(await page.evaluate(() => window.lambent.view()), before);
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("is new within a few milliseconds", async () => {
    const page = await open();
    const milliseconds = await page.evaluate(async () => {
      const { viewer } = window.lambent;
      const sun = { date: "2026-06-21", utcOffset: 1, latitude: 46.2, longitude: 6.14 };
      const show = (minutes) =>
        viewer.sky.show({ sun: { ...sun, minutes }, model: "fast", turbidity: 3 });
      await show(600);
      const began = performance.now();
      for (let i = 0; i < 20; ++i) await show(600 + 5 * i);
      return (performance.now() - began) / 20;
    });
    console.log(`${milliseconds.toFixed(1)} ms a sky`);
  });
});
