// Writes src/generated: the GLSL of this package (src/glsl) and what it shares with the native renderer
// (shaders/ of the repository) as strings, and the constants of it that programs need as well. Each text
// is a module of its own, and none has all of them: bundlers divide a program by modules.
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { bareGlsl } from "./bare-glsl.mjs";

const kFolders = ["../../../shaders/", "../src/glsl/"].map((path) => new URL(path, import.meta.url));
const kConstants = ["kMostDiscs"];

/** view_square.glsl → viewSquare, patch.frag.glsl → patchFrag */
const nameOf = (file) =>
  file.replace(/\.glsl$/, "").replace(/[._-](.)/g, (_, letter) => letter.toUpperCase());

const texts = new Map();
for (const folder of kFolders)
  for (const file of readdirSync(folder).sort()) {
    if (!file.endsWith(".glsl")) continue;
    if (texts.has(file)) throw new Error(`${file} is in shaders/ already`);
    texts.set(file, readFileSync(new URL(file, folder), "utf8"));
  }

const generated = new URL("../src/generated/", import.meta.url);
rmSync(generated, { recursive: true, force: true });
mkdirSync(generated, { recursive: true });
const kHead = "// Made by scripts/embed-shaders.mjs.\n";
const write = (name, text) => writeFileSync(new URL(`${name}.ts`, generated), kHead + text);

for (const [file, text] of texts) {
  const name = nameOf(file);
  write(name, `export const ${name}: string = ${JSON.stringify(bareGlsl(text))};\n`);
}
const together = [...texts.values()].join("\n");
let constants = "";
for (const name of kConstants) {
  const found = [...together.matchAll(new RegExp(`^const int ${name} = (\\d+);`, "gm"))];
  if (found.length !== 1) throw new Error(`${name} is declared ${found.length} times`);
  constants += `export const ${name} = ${found[0][1]};\n`;
}
write("constants", constants);
