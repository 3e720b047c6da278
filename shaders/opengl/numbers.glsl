// Transfer as it lies on the GPU: rows of numbers of 32 bits, of 16 (two in a word, the first in the
// low half) or of 8 (four, and a scale for every row: what 127 stands for). A row is filled up to a
// whole word with zeros.
//
// Before this text stand: #define LAMBENT_NUMBERS 0 (floats), 1 (halves) or 2 (bytes);
// LAMBENT_FIELD 1 if every receiver has a light of its own, or 0.

layout(std430, binding = 0) readonly buffer Numbers { uint words[]; };
#if LAMBENT_NUMBERS == 2
layout(std430, binding = 4) readonly buffer Scales { float scales[]; };
#endif
// [receiver, or one][coefficient][3], filled up with zeros to four coefficients.
layout(std430, binding = 1) readonly buffer Light { float light[]; };

uniform uint usedWords;    // of a row: those that the light has coefficients for
uniform uint rowWords;     // of a row
uniform uint lightStride;  // numbers of a receiver's light

// Where all receivers have one light, its address is the same in all invocations: then a processor
// that runs many as one reads it once.
vec3 coefficient(uint p, uint k) {
#if LAMBENT_FIELD
  uint at = p * lightStride + 3u * k;
#else
  uint at = 3u * k;
#endif
  return vec3(light[at], light[at + 1u], light[at + 2u]);
}

// The product of a row with receiver p's light: for one channel's row, of all channels of it.
vec3 product(uint row, uint p) {
  uint base = row * rowWords;
  vec3 sum = vec3(0.0);
  for (uint j = 0u; j < usedWords; ++j) {
    uint word = words[base + j];
#if LAMBENT_NUMBERS == 2
    vec4 m = vec4(ivec4(int(word) << 24, int(word) << 16, int(word) << 8, int(word)) >> 24);
    sum += m.x * coefficient(p, 4u * j) + m.y * coefficient(p, 4u * j + 1u) +
           m.z * coefficient(p, 4u * j + 2u) + m.w * coefficient(p, 4u * j + 3u);
#elif LAMBENT_NUMBERS == 1
    vec2 m = unpackHalf2x16(word);
    sum += m.x * coefficient(p, 2u * j) + m.y * coefficient(p, 2u * j + 1u);
#else
    sum += uintBitsToFloat(word) * coefficient(p, j);
#endif
  }
#if LAMBENT_NUMBERS == 2
  sum *= scales[row] / 127.0;
#endif
  return sum;
}
