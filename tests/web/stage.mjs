// node stage.mjs FROM TO PACKAGE
//
// Copies what PACKAGE (web/three-lambent …) is built and tested from out of the source tree FROM into
// TO, installs its dependencies there if they changed, and builds it: the source tree stays clean.
// Run again, it replaces what changed and keeps the rest.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import {
  cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync,
} from "node:fs";
import { basename, join } from "node:path";

const [from, to, name] = process.argv.slice(2);
if (!name) {
  console.error("usage: node stage.mjs FROM TO PACKAGE");
  process.exit(2);
}

const kMade = new Set(["node_modules", "dist", "generated", "release"]);
const made = (path) => kMade.has(basename(path));
const folder = join(to, name);

// What is made is kept over a copy; all else is replaced, so that nothing stays that was removed.
const kShared = ["shaders", "spec/samples", "spec/refused.json", "tests/conventions"];
for (const shared of kShared) {
  rmSync(join(to, shared), { recursive: true, force: true });
  cpSync(join(from, shared), join(to, shared), { recursive: true });
}
for (const part of ["src", "test", "scripts", "data", "examples"])
  rmSync(join(folder, part), { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
cpSync(join(from, name), folder, { recursive: true, filter: (path) => !made(path) });

const lock = readFileSync(join(folder, "package-lock.json"), "utf8");
const installed = join(folder, "node_modules", ".installed-lock.json");
if (!existsSync(installed) || readFileSync(installed, "utf8") !== lock) {
  const quiet = ["--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"];
  execFileSync("npm", ["ci", ...quiet], { cwd: folder, stdio: "inherit" });
  writeFileSync(installed, lock);
}

// Built only if what it is built from is not what it was built from.
const hash = createHash("sha256");
const add = (path) => {
  for (const entry of readdirSync(path, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1))) {
    if (made(entry.name) || entry.name.startsWith(".")) continue;
    const at = join(path, entry.name);
    if (entry.isDirectory()) add(at);
    else hash.update(`${at}\0`).update(readFileSync(at));
  }
};
for (const path of [folder, join(to, "shaders")]) add(path);
const state = hash.digest("hex");
const builtFrom = join(folder, ".built-from");
const built = existsSync(join(folder, "dist")) && existsSync(builtFrom);
if (!built || readFileSync(builtFrom, "utf8") !== state) {
  rmSync(builtFrom, { force: true });
  execFileSync("npm", ["run", "--silent", "build"], { cwd: folder, stdio: "inherit" });
  writeFileSync(builtFrom, state);
}
