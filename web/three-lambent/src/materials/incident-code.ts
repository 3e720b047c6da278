// The light that arrives at a surface, n² RGB numbers, as vectors of four that the rasteriser
// interpolates: RGBR GBRG BRGB …, and the code that reads them, written out.

/** Vectors of four for so many coefficients. */
export function incidentGroups(coefficients: number): number {
  return Math.ceil((3 * coefficients) / 4);
}

/** Adds coefficient i times y[i] for all of them to `lobe`. */
export function lobeCode(coefficients: number): string {
  const lines: string[] = [];
  for (let i = 0; i < coefficients; ++i) {
    const [r, g, b] = [3 * i, 3 * i + 1, 3 * i + 2].map(
      (f) => `incident[${f >> 2}].${"xyzw"[f & 3]}`,
    );
    lines.push(`lobe += y[${i}] * vec3(${r}, ${g}, ${b});`);
  }
  return lines.join(" ");
}

/** READ(0) ADD(0) ADD(1) … of patch.frag.glsl, as statements. */
export function responseCode(coefficients: number, groupsAFetch: number): string {
  const lines: string[] = [];
  for (let g = 0; g < incidentGroups(coefficients); ++g) {
    if (g % groupsAFetch === 0)
      lines.push(`words = texelFetch(rtt, first + ivec3(${g / groupsAFetch}, 0, 0), 0);`);
    lines.push(`sum${g % 3} += group(words, ${g % groupsAFetch}) * incident[${g}];`);
  }
  return lines.join(" ");
}
