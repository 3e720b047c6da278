// What of the package comes to a page, and when: a bundler makes files of it that are fetched at once,
// and others with the first asset that asks for them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { before, describe, it } from "node:test";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import { openPage } from "./support/browser.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const readme = readFileSync(new URL("../README.md", import.meta.url), "utf8");
const sample = (name) => readFileSync(new URL(`../../../spec/samples/${name}.glb`, import.meta.url));

/** Files by their names, and what esbuild says of them by the same. */
async function divided(contents, external = []) {
  const { outputFiles, metafile } = await build({
    stdin: { contents, resolveDir: root, sourcefile: "page.js" },
    ...{ bundle: true, splitting: true, minify: true, format: "esm", write: false, external },
    ...{ metafile: true, outdir: "/", entryNames: "page", absWorkingDir: "/" },
  });
  const files = new Map(outputFiles.map(({ path, contents }) => [basename(path), contents]));
  const about = new Map(
    Object.entries(metafile.outputs).map(([path, output]) => [basename(path), output]),
  );
  return { files, about };
}

it("the plugin and its light are as few bytes as the README says", async () => {
  const most = Number(/at most ([\d,]+) bytes/.exec(readme)[1].replaceAll(",", ""));
  const program = 'export { LambentLight, LambentLoaderPlugin, lambentOf } from "./dist/index.js";';
  const { files, about } = await divided(program, ["three"]);
  const sizes = new Map();
  const add = (name) => {
    if (sizes.has(name)) return;
    sizes.set(name, gzipSync(files.get(name), { level: 9 }).length);
    for (const { path, kind, external } of about.get(name).imports)
      if (kind === "import-statement" && !external) add(basename(path));
  };
  add("page.js");
  const bytes = [...sizes.values()].reduce((a, b) => a + b);
  console.log(`the plugin and its light: ${bytes} bytes as gzip sends them`);
  const parts = [...sizes.keys()]
    .flatMap((name) => Object.entries(about.get(name).inputs))
    .sort(([, a], [, b]) => b.bytesInOutput - a.bytesInOutput)
    .map(([path, { bytesInOutput }]) => `${bytesInOutput} of ${path}`);
  assert.ok(bytes <= most, `${bytes} bytes, of which before gzip\n${parts.join("\n")}`);
});

describe("on a page, what a file needs is fetched with the first that needs it", () => {
  let files;
  before(async () => {
    const made = await divided(`
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { LambentLoaderPlugin, lambentOf } from "./dist/index.js";
globalThis.kindsOf = async (url) => {
  const loader = new GLTFLoader().register((parser) => new LambentLoaderPlugin(parser));
  return [...lambentOf(await loader.loadAsync(url)).kinds].sort();
};`);
    files = Object.fromEntries(
      [...made.files].map(([name, contents]) => [name, Buffer.from(contents)]),
    );
    for (const name of ["unoccluded-square", "bi-scale", "every-layout"])
      files[`${name}.glb`] = sample(name);
  });

  /** Loads a file on a new page that lacks some. @returns kinds or what is said; what was fetched */
  async function load(asset, missing = /^$/) {
    const there = Object.entries(files).filter(([name]) => !missing.test(name));
    const browser = await openPage({
      script: files["page.js"],
      files: Object.fromEntries(there),
      folder: root,
    });
    try {
      await browser.page.waitForFunction("globalThis.kindsOf");
      const asked = [];
      browser.page.on("request", (request) => asked.push(basename(request.url())));
      const kinds = await browser.page.evaluate(
        (url) => globalThis.kindsOf(url).catch((error) => String(error)),
        asset,
      );
      const parts = ["read", "patches", "mirrors"].filter((part) =>
        asked.some((name) => name.startsWith(`${part}-`)),
      );
      return { kinds, parts };
    } finally {
      await browser.close();
    }
  }

  it("matt: what reads it", async () => {
    const expected = { kinds: ["diffuse"], parts: ["read"] };
    assert.deepEqual(await load("unoccluded-square.glb"), expected);
  });
  it("meso-structure", async () => {
    const { kinds, parts } = await load("bi-scale.glb");
    assert.ok(kinds.includes("bi-scale"), `${kinds}`);
    assert.deepEqual(parts, ["read", "patches"]);
  });
  it("a mirror among others", async () => {
    const { kinds, parts } = await load("every-layout.glb");
    assert.ok(kinds.includes("mirror"), `${kinds}`);
    assert.deepEqual(parts, ["read", "mirrors"]);
  });
  it("and if it is not there, loading fails and says which file it was", async () => {
    const { kinds } = await load("every-layout.glb", /^mirrors-/);
    assert.match(String(kinds), /mirrors-\w+\.js/);
  });
});
