// Transfer as it is stored: 16 bits (two in a word, the first in the low half) or 32.
//
// Before this text stands: #define LAMBENT_HALF 0 or 1.

layout(std430, binding = 0) readonly buffer Numbers { uint words[]; };

float number(uint i) {
#if LAMBENT_HALF
  vec2 pair = unpackHalf2x16(words[i >> 1u]);
  return (i & 1u) == 0u ? pair.x : pair.y;
#else
  return uintBitsToFloat(words[i]);
#endif
}
