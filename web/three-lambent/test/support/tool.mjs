// The lambent tool, whose pictures by CPU the browser's are held to.
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";

const tool = process.env.LAMBENT_TOOL;

/** Why tests that need the tool cannot run; false if they can. */
export const noTool =
  tool && existsSync(tool) ? false : "LAMBENT_TOOL does not name the lambent tool";

/** Runs it in `cwd`; throws with its words if it fails. */
export function lambent(cwd, ...args) {
  try {
    return execFileSync(tool, args.map(String), { cwd, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
  } catch (error) {
    throw new Error(`lambent ${args.join(" ")}\n${error.stdout}${error.stderr}`);
  }
}
