// The lambent tool, whose pictures by CPU the browser's are held to.
import { execFileSync } from "node:child_process";

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
