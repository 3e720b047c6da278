// The light that arrives at a receiver, as the transfer pass packed it (pack.glsl).
//
// Before this text stand: #define LAMBENT_TEXELS of a receiver, LAMBENT_GROUPS of four numbers.

uniform highp usampler2D incidentLit;
uniform int incidentALine;
uniform float incidentUnit;  // what a number of 1 stands for

ivec2 incidentPlace(int receiver) {
  int line = receiver / incidentALine;
  return ivec2((receiver - line * incidentALine) * LAMBENT_TEXELS, line);
}

vec4 lowGroup(uvec4 words) { return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y)); }
vec4 highGroup(uvec4 words) { return vec4(unpackHalf2x16(words.z), unpackHalf2x16(words.w)); }
