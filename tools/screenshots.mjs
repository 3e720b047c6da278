// Pictures of the page for the documents: docs/images/viewer-web.png, viewer-web-phone.png and, of an
// ASSET with meso-structure, viewer-overlays-web.png: how its patch lies.
//
// usage: node tools/screenshots.mjs [FOLDER [ASSET]]   (LAMBENT_TOOL, LAMBENT_WEB_MODULES as in
// tests/web/viewer; FOLDER is docs/images)
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { launch, openPage, serve } from "../tests/web/viewer/session.mjs";

const folder = process.argv[2] ?? fileURLToPath(new URL("../docs/images", import.meta.url));
const patched = process.argv[3];
const browser = await launch();
for (const { name, asset, options, files = [], key } of [
  { name: "viewer-web", asset: 1, options: { viewport: { width: 1280, height: 800 } } },
  {
    name: "viewer-web-phone",
    asset: 0,
    options: { viewport: { width: 360, height: 740 }, deviceScaleFactor: 2, hasTouch: true },
  },
  ...(patched
    ? [{ name: "viewer-overlays-web", asset: 0, key: "l",
        files: [patched, "disc:60,40,30,4+uniform:0.4"],
        options: { viewport: { width: 1280, height: 800 } } }]
    : []),
]) {
  const server = await serve(process.cwd(), files);
  const { page, context, complaints } = await openPage(browser, server.url, options);
  await page.evaluate((index) => window.lambent.viewer.openAsset(index), asset);
  if (key) await page.keyboard.press(key);
  await page.evaluate(() => window.lambent.viewer.settled());
  await page.screenshot({ path: join(folder, `${name}.png`) });
  console.log(`wrote ${join(folder, `${name}.png`)}`);
  if (complaints.length > 0) throw new Error(complaints.join("\n"));
  await context.close();
  await server.stop();
}
await browser.close();
