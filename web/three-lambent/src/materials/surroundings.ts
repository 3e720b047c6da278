// What a surface is seen through, and by: texts of its fragment shader.

import { defines } from "./defines.js";

/** What is seen through: no air, air, or air with shafts of light. */
export type AirMode = "none" | "air" | "shafts";

export interface Surroundings {
  /** Of air: {@link airSource}. */
  air: string;
  /** captured.glsl, if mirrors see it; else "". */
  captured: string;
}

export const kNoAir = defines({ AIR: 0, SHAFTS: 0 });

export const kAlone: Surroundings = { air: kNoAir, captured: "" };
