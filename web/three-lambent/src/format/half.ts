// IEEE 754 binary16 bit patterns.

const kTable = /* @__PURE__ */ makeTable();

function makeTable(): Float32Array {
  const table = new Float32Array(65536);
  for (let h = 0; h < 65536; ++h) {
    const sign = h & 0x8000 ? -1 : 1;
    const exponent = (h >> 10) & 31;
    const fraction = h & 1023;
    table[h] =
      exponent === 0
        ? sign * fraction * 2 ** -24
        : exponent === 31
          ? fraction
            ? NaN
            : sign * Infinity
          : sign * (1024 + fraction) * 2 ** (exponent - 25);
  }
  return table;
}

/** The number of a bit pattern; NaN and infinity as they come. */
export function floatFromHalf(bits: number): number {
  return kTable[bits & 0xffff];
}

const float = /* @__PURE__ */ new Float32Array(1);
const word = /* @__PURE__ */ new Uint32Array(float.buffer);

/** Rounded to nearest, ties to even; what is beyond ±65504 becomes ±65504, NaN becomes 0. */
export function halfFromFloat(value: number): number {
  float[0] = value;
  const bits = word[0];
  const sign = (bits >>> 16) & 0x8000;
  const magnitude = bits & 0x7fffffff;
  if (magnitude > 0x7f800000) return 0;
  if (magnitude >= 0x477ff000) return sign | 0x7bff;
  if (magnitude < 0x38800000) {
    // Below 2^-14 a half counts 2^-24, which is what the last place of a float near ½ is worth.
    float[0] = Math.abs(float[0]) + 0.5;
    return sign | (word[0] - 0x3f000000);
  }
  return sign | ((magnitude - 0x38000000 + 0xfff + ((magnitude >>> 13) & 1)) >>> 13);
}
