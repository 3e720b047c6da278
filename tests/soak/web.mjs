// Loads and drops assets on the page for a while, and holds that nothing grows: what three.js
// counts, what WebGL was asked to make and not to delete, and the JavaScript heap.
//
// usage: node web.mjs [--assets N] [--minutes M] FOLDER
// FOLDER holds the assets (.glb); N loads (200) are spread over M minutes (10; 0: without a pause).
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { isDeepStrictEqual, parseArgs } from "node:util";
import { launch, serve } from "../web/viewer/session.mjs";

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { assets: { type: "string", default: "200" }, minutes: { type: "string", default: "10" } },
});
const [folder] = positionals;
const loads = Number(values.assets);
const pause = (60_000 * Number(values.minutes)) / loads;
const files = readdirSync(folder)
  .filter((name) => name.endsWith(".glb") && !name.endsWith("-scene.glb"))
  .sort()
  .map((name) => ({ name, base64: readFileSync(join(folder, name)).toString("base64") }));
assert.ok(files.length > 1, `${folder}: two .glb at least`);

const server = await serve(folder, []);
const browser = await launch();
const context = await browser.newContext({ viewport: { width: 480, height: 320 } });
const page = await context.newPage();
const debugging = await context.newCDPSession(page);
const complaints = [];
page.on("pageerror", (error) => complaints.push(String(error)));
// The counters stand before the page makes its first object.
await page.addInitScript(() => {
  window.alive = {};
  for (const kind of ["Texture", "Buffer", "Framebuffer", "Renderbuffer", "Program", "Shader",
    "VertexArray"]) {
    const set = new Set();
    window.alive[kind] = set;
    const prototype = WebGL2RenderingContext.prototype;
    const [make, remove] = [prototype[`create${kind}`], prototype[`delete${kind}`]];
    prototype[`create${kind}`] = function (...args) {
      const made = make.apply(this, args);
      if (made) set.add(made);
      return made;
    };
    prototype[`delete${kind}`] = function (object) {
      set.delete(object);
      return remove.call(this, object);
    };
  }
});
await page.goto(server.url);
await page.waitForFunction(() => window.lambent !== undefined);
await page.evaluate(() => window.lambent.ready);

/** After collections that take what only finalisers let go of, too: of the page alone, exact. */
async function heapOf() {
  for (let i = 0; i < 3; ++i) await debugging.send("HeapProfiler.collectGarbage");
  const { usedSize, backingStorageSize = 0 } = await debugging.send("Runtime.getHeapUsage");
  return (usedSize + backingStorageSize) / 2 ** 20;
}
async function measure() {
  const counts = await page.evaluate(async () => {
    await window.lambent.viewer.settled();
    const { memory, programs } = window.lambent.viewer.current.renderer.info;
    const alive = Object.fromEntries(
      Object.entries(window.alive).map(([kind, set]) => [kind, set.size]));
    return { three: { ...memory, programs: programs.length }, alive };
  });
  return { ...counts, heap: await heapOf() };
}
const load = ({ name, base64 }) =>
  page.evaluate(
    async ([given, text]) => {
      const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
      const shown = await window.lambent.viewer.openFile(new File([bytes], given));
      await window.lambent.viewer.settled();
      return shown;
    },
    [name, base64],
  );

// Every asset once: what belongs to a kind of asset and not to one file is made by then.
for (const file of files) assert.ok(await load(file), `${file.name} was not shown`);
const rounds = [];
for (let i = 0; i < loads; ++i) {
  const file = files[i % files.length];
  const began = Date.now();
  assert.ok(await load(file), `${file.name} was not shown`);
  if (file === files[0]) {
    rounds.push(await measure());
    const { three, alive, heap } = rounds.at(-1);
    console.log(`${i + 1} loads: ${JSON.stringify(three)} ${JSON.stringify(alive)} ${heap.toFixed(1)} MiB`);
  }
  await new Promise((done) => setTimeout(done, Math.max(0, pause - (Date.now() - began))));
}

// What waits for a timer, a worker or an idle moment goes yet; what was leaked stays.
const faults = () => {
  const [first, last] = [rounds[0], rounds.at(-1)];
  const grown = ["three", "alive"].filter((kind) => !isDeepStrictEqual(last[kind], first[kind]));
  // It wavers by a tenth of one; a leak of an asset in each load would be far above this.
  if (last.heap > first.heap + 2) grown.push("heap");
  return grown.map((kind) => `${kind}: ${JSON.stringify([first[kind], last[kind]])}`);
};
assert.ok(rounds.length >= 2, "too few loads to compare");
for (let i = 0; i < 20 && faults().length > 0; ++i) {
  await new Promise((done) => setTimeout(done, 500));
  rounds.push(await measure());
}
await browser.close();
await server.stop();

assert.deepEqual(faults(), [], "more at the last round than at the first");
assert.deepEqual(complaints, []);
console.log(`${loads} loads: nothing grew`);
