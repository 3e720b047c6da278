// The response of one position of a radiance transfer texture, seen from one view, to the light that
// arrives: Σ_i B_i l_i (sloan2003biscale eq. 4). Its numbers lie as those of the light do
// (incident.glsl), in texels of 16 bytes.
//
// Before this text stand: incident.glsl; #define LAMBENT_NUMBERS 0 (floats), 1 (halves) or 2 (bytes,
// whose scales the light holds already); LAMBENT_RESPONSE, which is READ(0) ADD(0) ADD(1) … READ(1)
// … for all texels and the groups that each brings; LAMBENT_RTT_PLACE, the type of a place where
// numbers lie. After it: the functions that read there.

LAMBENT_RTT_PLACE rttPlace(int row);
uvec4 rttWords(LAMBENT_RTT_PLACE first, int texel);

#if LAMBENT_NUMBERS == 2
const int kGroupsAFetch = 4;
vec4 group(uvec4 words, int i) {
  int word = int(words[i]);
  return vec4(ivec4(word << 24, word << 16, word << 8, word) >> 24);
}
#elif LAMBENT_NUMBERS == 1
const int kGroupsAFetch = 2;
vec4 group(uvec4 words, int i) {
  return vec4(unpackHalf2x16(words[2 * i]), unpackHalf2x16(words[2 * i + 1]));
}
#else
const int kGroupsAFetch = 1;
vec4 group(uvec4 words, int i) { return uintBitsToFloat(words); }
#endif

// Written out: as loops over arrays it took three times as long on a CPU's OpenGL.
vec3 response(int row) {
  LAMBENT_RTT_PLACE first = rttPlace(row);
  vec4 sums[3];
  sums[0] = sums[1] = sums[2] = vec4(0.0);
  uvec4 words;
#define READ(f) words = rttWords(first, f);
#define ADD(i) sums[(i) % 3] += group(words, (i) % kGroupsAFetch) * incident[i];
  LAMBENT_RESPONSE
  return sumOfChannels(sums[0], sums[1], sums[2]);
}
