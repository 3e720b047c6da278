// Writes src/generated/shaders.ts: the GLSL of this package (src/glsl) and what it shares with the
// native renderer (shaders/ of the repository), as strings.
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";

const shared = new URL("../../../shaders/", import.meta.url);
const own = new URL("../src/glsl/", import.meta.url);
const kShared = [
  "sh.glsl",
  "view_square.glsl",
  "rtt_footprint.glsl",
  "rtt_look_up.glsl",
  "tangent_frame.glsl",
];

/** view_square.glsl → viewSquare, patch.frag.glsl → patchFrag */
const nameOf = (file) =>
  file.replace(/\.glsl$/, "").replace(/[._-](.)/g, (_, letter) => letter.toUpperCase());

const texts = new Map();
for (const file of kShared) texts.set(file, readFileSync(new URL(file, shared), "utf8"));
for (const file of readdirSync(own).sort())
  if (file.endsWith(".glsl")) texts.set(file, readFileSync(new URL(file, own), "utf8"));

let out = "// Made by scripts/embed-shaders.mjs.\n";
for (const [file, text] of texts)
  out += `export const ${nameOf(file)}: string = ${JSON.stringify(text)};\n`;
mkdirSync(new URL("../src/generated/", import.meta.url), { recursive: true });
writeFileSync(new URL("../src/generated/shaders.ts", import.meta.url), out);
