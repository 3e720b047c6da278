// node scripts/release.mjs [--publish] [--as-built]
//
// Checks that this package can be published, builds, tests and packs it (--as-built: packs it
// alone). That is all, unless --publish is given: then the packed file is published, with a
// statement of where it was built (which takes a job of continuous integration that may sign it). A
// version is published once: all that is checked here is checked before.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const manifest = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
const kFlags = ["--publish", "--as-built"];
const given = process.argv.slice(2);
const [publish, asBuilt] = kFlags.map((flag) => given.includes(flag));

const problems = [];
const check = (holds, problem) => holds || problems.push(problem);
const run = (command, args, stdio = "inherit") =>
  execFileSync(command, args, { cwd: root, encoding: "utf8", stdio });

/** What git says, or null where there is no git, or no repository. */
function git(...args) {
  try {
    return run("git", args, ["ignore", "pipe", "ignore"]).trim();
  } catch {
    return null;
  }
}

function checkManifest() {
  const unknown = given.filter((word) => !kFlags.includes(word));
  check(unknown.length === 0, `${unknown[0]} is no option: there are ${kFlags.join(", ")}`);
  check(/^\d+\.\d+\.\d+$/.test(manifest.version), `version: ${manifest.version} is no release`);
  const changes = readFileSync(join(root, "CHANGELOG.md"), "utf8");
  check(
    changes.includes(`\n## ${manifest.version}\n`),
    `CHANGELOG.md: has no section "## ${manifest.version}"`,
  );
  const lock = JSON.parse(readFileSync(join(root, "package-lock.json"), "utf8"));
  check(
    lock.version === manifest.version,
    "package-lock.json: has another version: run npm install --package-lock-only",
  );
  for (const key of ["repository", "homepage", "bugs", "license", "author", "engines"])
    check(manifest[key], `package.json: ${key} is missing`);
  if (!publish) return;
  check(!asBuilt, "--as-built: what is published is built and tested");
  check(git("status", "--porcelain", ".") === "", "git: there are changes that are not committed");
  check(
    git("tag", "--points-at", "HEAD")?.split("\n").includes(`three-lambent-${manifest.version}`),
    `git: the commit has no tag three-lambent-${manifest.version}`,
  );
}

/** Everything that is exported is packed. */
function checkPacked(paths) {
  const named = (value) => (typeof value === "string" ? [value] : Object.values(value));
  for (const path of Object.values(manifest.exports).flatMap(named))
    check(paths.includes(path.replace(/^\.\//, "")), `${path} is exported and not packed`);
}

function stopAtProblems() {
  if (problems.length === 0) return;
  for (const problem of problems) console.error(`release: ${problem}`);
  process.exit(1);
}

checkManifest();
stopAtProblems();
if (!asBuilt) {
  run("npm", ["run", "--silent", "build"]);
  run("npm", ["test"]);
}
const out = join(root, "release");
rmSync(out, { recursive: true, force: true });
mkdirSync(out);
const args = ["pack", "--json", "--ignore-scripts", "--pack-destination", out];
const [packed] = JSON.parse(run("npm", args, ["ignore", "pipe", "inherit"]));
checkPacked(packed.files.map(({ path }) => path));
stopAtProblems();
const file = join(out, basename(packed.filename));
console.log(`${file}: ${packed.files.length} files, ${packed.size} bytes, ${packed.integrity}`);
if (publish) run("npm", ["publish", file, "--provenance", "--access", "public"]);
else console.log("Nothing was published: npm run release -- --publish does.");
