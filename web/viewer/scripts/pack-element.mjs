// node scripts/pack-element.mjs [FOLDER]   (after npm run build)
//
// Puts the npm package lambent-viewer together in FOLDER (element-package): what was built, its
// types, its README and its licence.
import { cpSync, mkdirSync, rmSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { join } from "node:path";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const folder = process.argv[2] ?? here("../element-package");
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
for (const name of ["package.json", "README.md", "lambent-viewer.d.ts"])
  cpSync(here(`../element/${name}`), join(folder, name));
for (const name of ["lambent-viewer.js", "sky.bin", "air.bin"])
  cpSync(here(`../dist/${name}`), join(folder, name));
cpSync(here("../../../LICENSE"), join(folder, "LICENSE"));
