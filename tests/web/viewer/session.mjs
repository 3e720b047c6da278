// The tool's server and a browser that shows its page.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { after, afterEach, before } from "node:test";

export const tool = process.env.LAMBENT_TOOL ?? "lambent";
/** Where node finds playwright-core: a folder with node_modules. */
const modules = process.env.LAMBENT_WEB_MODULES ?? process.cwd();

/** The page's own folder, built, with its node_modules. */
export const viewerModules = process.env.LAMBENT_VIEWER_MODULES ?? process.cwd();
/** Text of axe-core, to be evaluated in a page. */
export const axe = () =>
  readFileSync(
    createRequire(join(viewerModules, "package.json")).resolve("axe-core/axe.min.js"), "utf8");
/** Where the tool finds its page. */
export const pageFolder = resolve(dirname(tool), "../share/lambent/viewer");

export const kChromium = process.env.LAMBENT_CHROMIUM ?? "chromium";
export const kSize = 200;

/** `lambent view --web` in `cwd`; { url, port, stop() → exit code }. */
export async function serve(cwd, files) {
  const child = spawn(tool, ["view", ...files, "--web", "--port", "0", "--no-browser", "--quiet"], {
    cwd,
    stdio: ["ignore", "pipe", "pipe"],
  });
  const ended = new Promise((resolve) => child.on("exit", (code) => resolve(code)));
  let [said, complained] = ["", ""];
  child.stderr.on("data", (text) => (complained += text));
  const url = await new Promise((resolve, reject) => {
    child.stdout.on("data", (text) => {
      said += text;
      const found = /http:\/\/127\.0\.0\.1:\d+\//.exec(said);
      if (found) resolve(found[0]);
    });
    child.on("exit", (code) => reject(new Error(`view --web ended with ${code}: ${complained}`)));
    child.on("error", reject);
  });
  return {
    url,
    port: Number(new URL(url).port),
    stop: () => {
      child.kill("SIGINT");
      return ended;
    },
  };
}

/** Chromium without a window, on the software driver that GL applications have. */
export async function launch(more = []) {
  const { chromium } = createRequire(join(modules, "package.json"))("playwright-core");
  const { execFileSync } = await import("node:child_process");
  const executablePath = execFileSync("which", [kChromium], { encoding: "utf8" }).trim();
  return chromium.launch({
    executablePath,
    args: [
      "--headless",
      "--no-sandbox",
      "--use-angle=gl-egl",
      "--ignore-gpu-blocklist",
      "--force-color-profile=srgb",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      ...more,
    ],
  });
}

/**
 * The page at `url`, once it shows something. `complaints` fills with what it said on the console
 * (errors, warnings, violations of its content policy) and with requests to other hosts.
 */
export async function openPage(browser, url, options = {}) {
  const context = await browser.newContext({
    viewport: { width: 760, height: 420 },
    deviceScaleFactor: 1,
    ...options,
  });
  const page = await context.newPage();
  const complaints = [];
  // Software drivers tell of their own slowness.
  const own = (text) => !/GPU stall due to ReadPixels|GL Driver Message|Automatic fallback/.test(text);
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && own(message.text()))
      complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.addInitScript(() =>
    document.addEventListener("securitypolicyviolation", (event) =>
      console.error(`content policy: ${event.violatedDirective} ${event.blockedURI}`)));
  page.on("request", (request) => {
    const { protocol, origin } = new URL(request.url());
    if (!["blob:", "data:"].includes(protocol) && origin !== new URL(url).origin)
      complaints.push(`a request to ${request.url()}`);
  });
  await page.goto(url);
  await page.waitForFunction(() => window.lambent !== undefined);
  await page.evaluate(() => window.lambent.ready);
  return { page, context, complaints };
}

export const settled = (page) => page.evaluate(() => window.lambent.viewer.settled());
export const view = (page) => page.evaluate(() => window.lambent.view());
/** The picture alone, whatever lies over it, once it is still: a PNG. */
export const picture = async (page) =>
  Buffer.from(await page.evaluate(async () => {
    const bytes = new Uint8Array(await (await window.lambent.viewer.picture()).arrayBuffer());
    return bytes.reduce((text, byte) => text + String.fromCharCode(byte), "");
  }), "latin1");

/** As when files are let go over the page. */
export async function drop(page, ...files) {
  await page.evaluate((all) => {
    const transfer = new DataTransfer();
    for (const { name, base64 } of all)
      transfer.items.add(
        new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true }));
  }, files.map(({ name, bytes }) => ({ name, base64: Buffer.from(bytes).toString("base64") })));
}

/**
 * What a file of tests has: a folder, a server of what `prepare(folder)` names of it, a browser, and
 * the page that a test opened last, which is closed after it.
 */
export function visiting(name, prepare = () => []) {
  const visit = {
    async open(options, hash = "") {
      visit.opened = await openPage(visit.browser, visit.server.url + hash, options);
      return visit.opened.page;
    },
  };
  before(async () => {
    visit.folder = mkdtempSync(join(tmpdir(), `lambent-${name}-`));
    visit.server = await serve(visit.folder, prepare(visit.folder));
    visit.browser = await launch();
  });
  after(async () => {
    await visit.browser?.close();
    if (visit.server) assert.equal(await visit.server.stop(), 0, "Ctrl-C is how the server ends");
    rmSync(visit.folder, { recursive: true });
  });
  afterEach(async () => {
    await visit.opened?.context.close();
    visit.opened = undefined;
  });
  return visit;
}
