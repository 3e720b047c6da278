// What shader texts are told by #define.

import { eachGroup, incidentGroups } from "./group-macros.js";

export const flag = (value: unknown) => (value ? 1 : 0);

/** LAMBENT_… */
export function defines(values: Record<string, string | number>): string {
  return Object.entries(values)
    .map(([name, value]) => `#define LAMBENT_${name} ${value}\n`)
    .join("");
}

/** What incident.glsl and incident_texture.glsl want before them. */
export function incidentDefines(coefficients: number, interpolated: boolean): string {
  return defines({
    GROUPS: incidentGroups(coefficients),
    "EACH_GROUP(DO)": eachGroup(coefficients),
    INTERPOLATED: flag(interpolated),
    LIGHT_PLACE: "ivec2",
  });
}
