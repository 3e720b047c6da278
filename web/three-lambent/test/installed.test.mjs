// The packed file, installed into an empty folder as a stranger does, without the network: programs
// for a browser and for Node that use all of its entry points, type-checked and built.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before, describe, it } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const root = fileURLToPath(new URL("..", import.meta.url));
const samples = fileURLToPath(new URL("../../../spec/samples/", import.meta.url));
const manifest = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));

let folder;
let installed;
let taken;
const run = (command, args, cwd = folder) => {
  try {
    return execFileSync(command, args, { cwd, encoding: "utf8", stdio: "pipe" });
  } catch (error) {
    assert.fail(`${command} ${args.join(" ")}\n${error.stdout}${error.stderr}`);
  }
};

before(() => {
  folder = mkdtempSync(join(tmpdir(), "three-lambent-"));
  const pack = ["pack", "--json", "--ignore-scripts", "--pack-destination", folder];
  const [{ filename }] = JSON.parse(run("npm", pack, root));
  const three = `file:${join(root, "node_modules/three")}`;
  const app = { name: "app", private: true, type: "module", dependencies: { three } };
  app.dependencies[manifest.name] = `file:${filename}`;
  writeFileSync(join(folder, "package.json"), JSON.stringify(app));
  run("npm", ["install", "--offline", "--no-audit", "--no-fund", "--loglevel=error"]);
  installed = join(folder, "node_modules", manifest.name);
  taken = readdirSync(join(folder, "node_modules")).filter((name) => !name.startsWith("."));
  // What the program has beside it: from here, as nothing is fetched.
  for (const name of readdirSync(join(root, "node_modules"))) {
    const names = name.startsWith("@")
      ? readdirSync(join(root, "node_modules", name)).map((sub) => `${name}/${sub}`)
      : [name];
    for (const each of names.filter((n) => !n.startsWith(".") && n !== "three")) {
      const to = join(folder, "node_modules", each);
      mkdirSync(dirname(to), { recursive: true });
      symlinkSync(join(root, "node_modules", each), to);
    }
  }
});
after(() => rmSync(folder, { recursive: true, force: true }));

const kPage = `
import { Scene, WebGLRenderer } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { LambentAsset, LambentLight, LambentLoaderPlugin } from "three-lambent";
export async function show(renderer: WebGLRenderer, scene: Scene): Promise<void> {
  const loader = new GLTFLoader().register((parser) => new LambentLoaderPlugin(parser));
  const gltf = await loader.loadAsync("a.glb");
  const asset = gltf.userData.lambent as LambentAsset;
  asset.setLight(LambentLight.uniform([1, 1, 1], asset.info.bands));
  scene.add(gltf.scene);
  asset.update(renderer);
}
export const sky = new URL("three-lambent/data/sky.bin", import.meta.url);
`;
const kReact = `
import { Canvas } from "@react-three/fiber";
import { LambentLight } from "three-lambent";
import { LambentAsset } from "three-lambent/react";
const light = LambentLight.uniform([1, 1, 1], 5);
export const App = () => (
  <Canvas>
    <LambentAsset url="a.glb" light={light} rotation={[0, 1, 0]} transfer="shadowed" />
    <LambentAsset asset={null} light={null} onLoad={(asset) => asset.sunNotes()} />
  </Canvas>
);
// @ts-expect-error: no such transfer
export const Wrong = () => <LambentAsset url="a.glb" transfer="none" />;
// @ts-expect-error: neither an URL nor an asset
export const Without = () => <LambentAsset light={light} />;
`;
const kOptimise = `
import { readFileSync } from "node:fs";
import { NodeIO } from "@gltf-transform/core";
import { LambentRadianceTransfer } from "three-lambent/gltf-transform";
const io = new NodeIO().registerExtensions([LambentRadianceTransfer]);
const document = await io.readBinary(new Uint8Array(readFileSync(process.argv[2])));
const [mesh] = document.getRoot().listMeshes();
const { json } = await io.writeJSON(document);
const transfer = "LAMBENT_radiance_transfer";
console.log(mesh.getName(), transfer in json.extensions!, transfer in
  (json.meshes![0].primitives[0].extensions as object));
`;

describe("the packed file, installed", () => {
  it("takes no more than three", () => {
    assert.deepEqual(taken, ["three", "three-lambent"]);
    for (const name of ["CHANGELOG.md", "LICENSE", "README.md"])
      assert.ok(readFileSync(join(installed, name)).length > 100, name);
  });

  it("is used by strict TypeScript", () => {
    writeFileSync(join(folder, "page.ts"), kPage);
    writeFileSync(join(folder, "app.tsx"), kReact);
    writeFileSync(join(folder, "optimise.mts"), kOptimise);
    // As Node finds them, which is the strictest; bundlers' way is that of package.test.mjs.
    const compilerOptions = {
      ...{ module: "NodeNext", moduleResolution: "NodeNext", target: "ES2022", strict: true },
      ...{ lib: ["ES2022", "DOM", "DOM.Iterable"], jsx: "react-jsx", skipLibCheck: true },
      ...{ noEmit: true, types: ["node"] },
    };
    const files = ["page.ts", "app.tsx", "optimise.mts"];
    writeFileSync(join(folder, "tsconfig.json"), JSON.stringify({ compilerOptions, files }));
    run("node", [join(root, "node_modules/typescript/bin/tsc"), "-p", folder]);
  });

  it("is bundled, with one three and what is used alone", async () => {
    const bundle = async (contents, loader = "ts", external = []) => {
      const stdin = { contents, resolveDir: folder, loader };
      const options = { bundle: true, format: "esm", write: false, minify: true, metafile: true };
      const { outputFiles, metafile, warnings } = await build({
        ...{ ...options, stdin, external, jsx: "automatic", logLevel: "silent" },
      });
      assert.deepEqual(warnings, []);
      return { text: outputFiles[0].text, inputs: Object.keys(metafile.inputs) };
    };
    const page = await bundle(kPage);
    assert.equal(page.inputs.filter((path) => /build\/three\.core/.test(path)).length, 1);
    assert.ok(!page.inputs.some((path) => /lambent\/dist\/(react|gltf-transform)/.test(path)));
    const app = await bundle(kReact.replaceAll("// @ts-expect-error", "//"), "tsx");
    assert.equal(app.inputs.filter((path) => /build\/three\.core/.test(path)).length, 1);
    assert.equal(app.inputs.filter((path) => /loader-plugin/.test(path)).length, 1);
    const light = 'import { LambentLight } from "three-lambent"; console.log(LambentLight);';
    const { inputs, text } = await bundle(light, "js", ["three"]);
    assert.ok(text.length < 30_000, `${text.length} bytes of ${inputs.length} files for a light`);
  });

  it("keeps transfer in Node", () => {
    const options = { bundle: true, format: "esm", platform: "node", packages: "external" };
    const [from, to] = ["optimise.mts", "optimise.mjs"].map((name) => join(folder, name));
    return build({ ...options, entryPoints: [from], outfile: to, logLevel: "silent" }).then(() =>
      assert.equal(
        run("node", [to, join(samples, "unoccluded-square.glb")]).trim(),
        "square true true",
      ),
    );
  });

  it("has source maps that hold their sources", () => {
    const maps = readdirSync(join(installed, "dist"), { recursive: true })
      .map(String)
      .filter((path) => path.endsWith(".map"));
    assert.ok(maps.length > 50, `${maps.length} maps`);
    for (const path of maps) {
      const { sources, sourcesContent } = JSON.parse(
        readFileSync(join(installed, "dist", path), "utf8"),
      );
      assert.equal(sourcesContent?.length, sources.length, path);
      assert.ok(
        sourcesContent.every((text) => text.length > 0),
        path,
      );
    }
  });

  it("says where it comes from, and which versions it takes", () => {
    const { repository, bugs, homepage, author, engines, keywords } = manifest;
    assert.equal(repository.directory, "web/three-lambent");
    for (const url of [repository.url, bugs.url, homepage])
      assert.match(url, /^(git\+)?https:\/\/github\.com\/lambent-render\/lambent/);
    assert.ok(author && engines.node && keywords.length > 5);
    const { peerDependencies: peers, peerDependenciesMeta: meta } = manifest;
    for (const name of Object.keys(peers))
      assert.equal(meta[name]?.optional ?? false, name !== "three", name);
  });
});

describe("a release", () => {
  const release = (...words) => run("node", ["scripts/release.mjs", ...words], root);

  it("is packed and not published, unless one asks for it", () => {
    assert.match(release("--as-built"), /three-lambent-.*\.tgz.*\nNothing was published/);
  });

  it("is refused untested, unknown or unfinished", () => {
    for (const [words, pattern] of [
      [["--publish", "--as-built"], /is built and tested/],
      [["--publsh"], /--publsh is no option/],
    ])
      assert.throws(
        () => release(...words),
        (error) => pattern.test(error.message),
      );
  });
});
