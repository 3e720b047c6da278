// n² RGB numbers of light or of meso-structure lie in vectors of four: RGBR GBRG BRGB … The macros by
// which shaders/incident.glsl and rtt_response.glsl read them, written out.

/** Vectors of four for so many coefficients. */
export function incidentGroups(coefficients: number): number {
  return Math.ceil((3 * coefficients) / 4);
}

/** LAMBENT_EACH_GROUP: DO(0) DO(1) … */
export function eachGroup(coefficients: number): string {
  return Array.from({ length: incidentGroups(coefficients) }, (_, g) => `DO(${g})`).join(" ");
}

/** LAMBENT_RESPONSE: READ(0) ADD(0) ADD(1) … */
export function responseMacros(coefficients: number, groupsAFetch: number): string {
  const words: string[] = [];
  for (let g = 0; g < incidentGroups(coefficients); ++g) {
    if (g % groupsAFetch === 0) words.push(`READ(${g / groupsAFetch})`);
    words.push(`ADD(${g})`);
  }
  return words.join(" ");
}
