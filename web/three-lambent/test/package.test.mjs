// What `npm pack` would publish, and that it can be used as the README says.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, it } from "node:test";
import { fileURLToPath } from "node:url";
import { bundle, openPage } from "./support/browser.mjs";

const root = fileURLToPath(new URL("..", import.meta.url));
const readme = readFileSync(join(root, "README.md"), "utf8");
const manifest = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
const sample = readFileSync(
  new URL("../../../spec/samples/unoccluded-square.glb", import.meta.url),
);

/** What a program in TypeScript may say, and may not. */
const kProgram = `
import { LambentAsset, lambentOf, evaluateHarmonics, type LambentGLTF } from "three-lambent";
export const asset: LambentAsset = lambentOf(gltf);
export const same: LambentAsset = (gltf as LambentGLTF).userData.lambent;
export const copy: THREE.Object3D = asset.instantiate().root;
export const values: Float64Array = evaluateHarmonics(3, 0, 0, 1);
asset.transfer = "shadowed";
// @ts-expect-error no such choice
asset.transfer = "bouncy";
// @ts-expect-error not a light that relights
asset.setLight(new THREE.DirectionalLight());
`;

const kPacked =
  /^((README|CHANGELOG)\.md|LICENSE|package\.json|data\/\w+\.bin|dist\/[\w/-]+\.(js(\.map)?|d\.ts))$/;

describe("the package", () => {
  it("holds what it should, and nothing else", () => {
    const [{ files }] = JSON.parse(
      execFileSync("npm", ["pack", "--dry-run", "--json", "--ignore-scripts"], {
        cwd: root,
        encoding: "utf8",
      }),
    );
    const paths = files.map(({ path }) => path);
    for (const path of ["README.md", "LICENSE", "package.json", "dist/index.js", "dist/index.d.ts"])
      assert.ok(paths.includes(path), `${path} is missing`);
    for (const path of paths)
      assert.match(path, kPacked, path);
    for (const path of paths.filter((p) => p.endsWith(".js")))
      assert.ok(paths.includes(path.replace(/\.js$/, ".d.ts")), `${path} has no types`);
  });

  it("needs three alone, and beside it what its folders are for", () => {
    const peers = Object.keys(manifest.peerDependencies);
    const optional = Object.keys(manifest.peerDependenciesMeta);
    assert.deepEqual(peers.filter((name) => !optional.includes(name)), ["three"]);
    assert.equal(manifest.dependencies, undefined);
    const kFolders = {
      "gltf-transform": ["@gltf-transform/core"],
      react: ["react", "@react-three/fiber", "three/addons/loaders/GLTFLoader.js"],
    };
    const found = new Set();
    for (const file of execFileSync("find", ["dist", "-name", "*.js"], {
      cwd: root,
      encoding: "utf8",
    })
      .trim()
      .split("\n"))
      for (const [, from] of readFileSync(join(root, file), "utf8").matchAll(
        /from "([^".][^"]*)"/g,
      ))
        if (!kFolders[file.split("/")[1]]?.includes(from)) found.add(from);
    assert.deepEqual([...found], ["three"]);
  });

  it("is locked without the name of any host", () => {
    assert.doesNotMatch(readFileSync(join(root, "package-lock.json"), "utf8"), /"resolved"/);
  });

  it("exports nothing that the README does not know", async () => {
    const names = Object.keys(await import("../dist/index.js"));
    const small = new Set(["bandOf", "coefficientCount", "kMaxBands", "matrixOfQuaternion"]);
    for (const name of names) assert.ok(small.has(name) || readme.includes(`\`${name}\``), name);
  });

  // With the current TypeScript and with the oldest that three's own types are made for.
  for (const compiler of ["typescript", "typescript-oldest"])
    it(`can be used by a program in strict TypeScript that checks libraries: ${compiler}`, () =>
      compile(compiler));

  function compile(compiler) {
    const folder = mkdtempSync(join(tmpdir(), "three-lambent-"));
    try {
      const example = /```js\n(import[\s\S]*?)```/.exec(readme)[1];
      writeFileSync(join(folder, "example.ts"), `${example}\n${kProgram}\n`);
      const options = {
        compilerOptions: {
          ...{ target: "ES2022", module: "ESNext", moduleResolution: "bundler", strict: true },
          ...{ noEmit: true, lib: ["ES2022", "DOM"], types: [], skipLibCheck: false },
          paths: {
            "three-lambent": [join(root, "dist/index.d.ts")],
            three: [join(root, "node_modules/@types/three")],
            "three/addons/*": [join(root, "node_modules/@types/three/examples/jsm/*")],
          },
        },
        files: ["example.ts"],
      };
      writeFileSync(join(folder, "tsconfig.json"), JSON.stringify(options));
      execFileSync("node", [join(root, `node_modules/${compiler}/bin/tsc`), "-p", folder], {
        encoding: "utf8",
      });
    } catch (error) {
      assert.fail(`${error.stdout ?? error}`);
    } finally {
      rmSync(folder, { recursive: true });
    }
  }
});

describe("the README", () => {
  it("has an example that runs, and shows the asset lit", async () => {
    const example = /```js\n(import[\s\S]*?)```/.exec(readme)[1];
    const watched = `${example}
globalThis.shown = () => {
  const gl = renderer.getContext();
  renderer.render(gltf.scene, camera);
  const { drawingBufferWidth: w, drawingBufferHeight: h } = gl;
  const pixels = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let [count, sum] = [0, 0];
  for (let i = 0; i < pixels.length; i += 4)
    if (pixels[i] + pixels[i + 1] + pixels[i + 2] > 30) { ++count; sum += pixels[i + 1]; }
  return { share: count / (w * h), mean: sum / Math.max(1, count) };
};`;
    const browser = await openPage({ script: await bundle(watched), files: { "a.glb": sample } });
    try {
      await browser.page.waitForFunction("globalThis.shown");
      const { share, mean } = await browser.page.evaluate("globalThis.shown()");
      assert.ok(share > 0.1, `${share} of the picture is lit`);
      assert.ok(mean > 60, `mean of ${mean}`);
      assert.deepEqual(browser.problems(), []);
    } finally {
      await browser.close();
    }
  });

  it("keeps it to 15 lines", () => {
    const lines = /```js\n(import[\s\S]*?)```/
      .exec(readme)[1]
      .split("\n")
      .filter((line) => line.trim());
    assert.ok(lines.length <= 15, `${lines.length}`);
  });
});
