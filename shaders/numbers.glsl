// Transfer as it is stored: numbers of 32 bits, of 16 (two in a word, the first in the low half) or
// of 8 (four, and a scale for every run of them: what 127 stands for).
//
// Before this text stands: #define LAMBENT_NUMBERS 0 (floats), 1 (halves) or 2 (bytes).

layout(std430, binding = 0) readonly buffer Numbers { uint words[]; };
#if LAMBENT_NUMBERS == 2
layout(std430, binding = 4) readonly buffer Scales { float scales[]; };
uniform uint block;  // numbers that share a scale
#endif

float number(uint i) {
#if LAMBENT_NUMBERS == 2
  int byte = bitfieldExtract(int(words[i >> 2u]), int(i & 3u) * 8, 8);
  return float(byte) / 127.0 * scales[i / block];
#elif LAMBENT_NUMBERS == 1
  vec2 pair = unpackHalf2x16(words[i >> 1u]);
  return (i & 1u) == 0u ? pair.x : pair.y;
#else
  return uintBitsToFloat(words[i]);
#endif
}
