// Writes src/generated/shaders.ts: the GLSL of this package (src/glsl) and what it shares with the
// native renderer (shaders/ of the repository), as strings, and the constants of it that programs
// need as well.
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";

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

/** Without comments, indentation and empty lines, which a page need not fetch. */
const bare = (text) =>
  text
    .replace(/\/\*[\s\S]*?\*\/|\/\/.*$/gm, "")
    .split("\n")
    .map((line) => line.trim())
    .filter((line) => line !== "")
    .map((line) => `${line}\n`)
    .join("");

let out = "// Made by scripts/embed-shaders.mjs.\n";
for (const [file, text] of texts)
  out += `export const ${nameOf(file)}: string = ${JSON.stringify(bare(text))};\n`;
const all = [...texts.values()].join("\n");
for (const name of kConstants) {
  const found = [...all.matchAll(new RegExp(`^const int ${name} = (\\d+);`, "gm"))];
  if (found.length !== 1) throw new Error(`${name} is declared ${found.length} times`);
  out += `export const ${name} = ${found[0][1]};\n`;
}
mkdirSync(new URL("../src/generated/", import.meta.url), { recursive: true });
writeFileSync(new URL("../src/generated/shaders.ts", import.meta.url), out);
