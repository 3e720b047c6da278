// Where incident.glsl, and vertices, find the light of a receiver: as the transfer pass packed it
// (pack.glsl).
//
// Before this text stands: #define LAMBENT_GROUPS of four numbers, the texels of a receiver.

uniform highp usampler2D incidentLit;
uniform int incidentALine;

ivec2 lightPlace(int receiver) {
  int line = receiver / incidentALine;
  return ivec2((receiver - line * incidentALine) * LAMBENT_GROUPS, line);
}

vec4 lightGroup(ivec2 first, int group) {
  return uintBitsToFloat(texelFetch(incidentLit, first + ivec2(group, 0), 0));
}
