// The lambent tool, whose pictures by CPU the browser's are held to.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { png } from "./glb.mjs";
import { ballScene } from "./scenes.mjs";

const tool = process.env.LAMBENT_TOOL;

/** Why tests that need the tool are not run; false if they are. */
export const noTool = tool ? false : "LAMBENT_TOOL does not name the lambent tool";

/** Runs it in `cwd`; throws with its words if it fails. */
export function lambent(cwd, ...args) {
  try {
    const stdio = ["ignore", "pipe", "pipe"];
    return execFileSync(tool, args.map(String), { cwd, encoding: "utf8", stdio });
  } catch (error) {
    throw new Error(`lambent ${args.join(" ")}\n${error.stdout ?? error}${error.stderr ?? ""}`);
  }
}

/** patch.glb: a small asset with meso-structure. */
export function bakePatch(folder) {
  const patch = ["--positions", "12x10", "--views", 4, "--directions", 64, "--bounces", 1];
  lambent(folder, "rtt", "stucco", "-o", "patch.rtt", ...patch, "--quiet");
  const spread = ["--directions", 128, "--map-size", 128, "--vertices", 3000, "--mesh", "ball"];
  const rtt = ["--rtt", "patch.rtt", "--patch-width", 0.5, "--quiet"];
  writeFileSync(join(folder, "ball-scene.glb"), ballScene);
  lambent(folder, "synthesize", "ball-scene.glb", ...rtt, "-o", "patch.glb", ...spread);
}

/** layered.glb: three patches over one mesh, after bakePatch(). */
export function bakeLayers(folder) {
  const patch = ["--positions", "12x10", "--views", 2, "--directions", 64, "--bounces", 1];
  for (const name of ["weave", "bricks"])
    lambent(folder, "rtt", name, "-o", `${name}.rtt`, ...patch, "--quiet");
  const mask = png(8, 8, (x, y) => [x % 4 < 2 ? 255 : 0, y < 4 ? 255 : 0, 0]);
  writeFileSync(join(folder, "mask.png"), mask);
  const spread = ["--directions", 128, "--map-size", 128, "--vertices", 3000, "--mesh", "ball"];
  const rtts = ["patch", "weave", "bricks"].flatMap((name) => ["--rtt", `${name}.rtt`]);
  const layers = [...rtts, "--mask", "mask.png", "--patch-width", 0.5, "--quiet"];
  lambent(folder, "synthesize", "ball-scene.glb", ...layers, "-o", "layered.glb", ...spread);
}
