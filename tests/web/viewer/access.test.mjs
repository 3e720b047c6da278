// The page for everybody: no violation that axe-core knows in any of its states, and everything by
// the keyboard alone.
import assert from "node:assert/strict";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { describe, it } from "node:test";
import { mattScene } from "../../../web/three-lambent/test/support/scenes.mjs";
import { axe, drop, pageFolder, visiting } from "./session.mjs";

const visit = visiting("access");
const open = (options) => visit.open(options);

/** Fails with what is wrong and where. */
async function assertAccessible(page, state) {
  await page.evaluate(axe());
  const violations = await page.evaluate(async () =>
    (await window.axe.run(document)).violations.map(({ id, help, nodes }) =>
      `${id}: ${help}: ${nodes.map((each) => each.target.flat().join(" ")).join(", ")}`));
  assert.deepEqual(violations, [], state);
}
/** What has the focus, within <lambent-viewer> as well. */
const focused = (page) =>
  page.evaluate(() => {
    let at = document.activeElement;
    while (at?.shadowRoot?.activeElement) at = at.shadowRoot.activeElement;
    return at.getAttribute("aria-label") || at.id || at.textContent;
  });

describe("the page", () => {
  it("has no violation, whatever is open beside the picture", async () => {
    const page = await open({ viewport: { width: 1000, height: 700 } });
    await assertAccessible(page, "as it opens");
    await page.evaluate(async () => {
      const { viewer } = window.lambent;
      viewer.change((view) => Object.assign(view, { samples: 1, window: "hann:5", lobe: 16 }));
      viewer.addDisc();
      await viewer.sky.show({
        sun: { date: "2026-06-21", minutes: 600, utcOffset: 1, latitude: 46.2, longitude: 6.14 },
        model: "fast", turbidity: 2.5,
      });
      await viewer.sky.showAir(true);
    });
    await assertAccessible(page, "a disc of light, a sky and its air");
    await drop(page, { name: "not.glb", bytes: Buffer.from("something else") });
    await page.locator(".message.error").waitFor();
    await assertAccessible(page, "an error");
    await drop(page, { name: "plain.glb", bytes: mattScene });
    await page.locator(".bake").waitFor();
    await assertAccessible(page, "not baked");
    await page.evaluate(() => window.lambent.viewer.loading.show("Loading", 0.5));
    await assertAccessible(page, "loading");
    await page.keyboard.press("h");
    await assertAccessible(page, "the picture alone");
    await page.keyboard.press("h");
    await page.keyboard.press("?");
    await assertAccessible(page, "help");
    assert.deepEqual(visit.opened.complaints, []);
  });

  it("has none on a phone, in any of its tabs", async () => {
    const page = await open({ hasTouch: true, viewport: { width: 360, height: 740 } });
    await page.evaluate(() => {
      window.lambent.viewer.change((view) => (view.samples = 1));
      window.lambent.viewer.addDisc();
    });
    for (const tab of await page.getByRole("tab").all()) {
      await tab.tap();
      await assertAccessible(page, await tab.textContent());
    }
    await page.locator(".fold").tap();
    await assertAccessible(page, "folded");
    const covered = await page.evaluate(() => {
      const boxes = [...document.querySelectorAll("button, #grip")]
        .filter((each) => each.offsetParent !== null)
        .map((each) => [each.getAttribute("aria-label") ?? each.textContent,
          each.getBoundingClientRect()]);
      return boxes.flatMap(([a, p], i) => boxes.slice(i + 1)
        .filter(([, q]) => p.left < q.right - 1 && q.left < p.right - 1 &&
          p.top < q.bottom - 1 && q.top < p.bottom - 1)
        .map(([b]) => `${a} and ${b}`));
    });
    assert.deepEqual(covered, [], "nothing lies over anything");
  });

  it("has none from a folder", async () => {
    visit.opened = { context: await visit.browser.newContext() };
    const page = await visit.opened.context.newPage();
    await page.goto(pathToFileURL(join(pageFolder, "index.html")).href);
    await assertAccessible(page, "from a folder");
  });

  it("is used by the keyboard alone", async () => {
    const page = await open({ viewport: { width: 1000, height: 700 } });
    await page.evaluate(() => window.lambent.viewer.change((view) => (view.samples = 1)));
    await page.keyboard.press("Tab");
    assert.match(await focused(page), /^The picture\. Arrow keys/, "the picture comes first");
    const outline = () => page.evaluate(() => {
      let at = document.activeElement;
      while (at?.shadowRoot?.activeElement) at = at.shadowRoot.activeElement;
      // Of radio buttons and the like the label shows it.
      const shown = at.matches(".segments input") ? at.nextElementSibling : at;
      const { outlineStyle, outlineWidth } = getComputedStyle(shown);
      return outlineStyle !== "none" && parseFloat(outlineWidth) >= 2;
    });
    const order = [];
    const atEnd = () => page.evaluate(() => document.activeElement === document.body);
    while (!(await atEnd())) {
      assert.ok(order.length < 60, "Tab goes round for ever");
      assert.ok(await outline(), `${await focused(page)} does not show that it has the focus`);
      order.push(await focused(page));
      await page.keyboard.press("Tab");
    }
    const place = (name) => order.findIndex((each) => each.startsWith(name));
    const sequence = ["The picture", "Fill the screen", "Help", "Open files", "Start afresh", "Add",
      "Save picture"].map(place);
    assert.ok(sequence.every((each, i) => each >= 0 && (i === 0 || each > sequence[i - 1])),
      `${order}`);
    // The help: opened, closed, and the focus is where it was.
    const help = page.getByRole("button", { name: "Help" });
    await help.focus();
    await page.keyboard.press("Enter");
    assert.equal(await focused(page), "Close");
    await page.keyboard.press("Escape");
    assert.equal(await page.locator("dialog.help").isVisible(), false);
    assert.equal(await focused(page), "Help");
    // Messages: Escape closes the newest; their buttons are not keys of the page.
    await page.evaluate(() => {
      for (const each of ["one", "two"]) window.lambent.viewer.messages.error(each);
    });
    await page.keyboard.press("Escape");
    assert.equal(await page.locator(".message").count(), 1);
    await page.locator(".message .close").focus();
    await page.keyboard.press("Space");
    assert.equal(await page.locator(".message").count(), 0);
    assert.equal(await page.evaluate(() => window.lambent.viewer.playing), false);
    assert.deepEqual(visit.opened.complaints, []);
  });
});
