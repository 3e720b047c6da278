// Surfaces through the air: shade::Air. A table of aerial_perspective.glsl is one map with a row for
// each distance and elevation; along a row lie the azimuths of the three sources, one source after
// the other, and then the extinction.
//
// Before this text: phase_function.glsl, aerial_perspective.glsl.

layout(binding = 5) uniform sampler2D airTable;

uniform mat3 sunFromWorld;
uniform float metresPerUnit;

vec3 airTexel(int column, int elevation, int distance) {
  return texelFetch(airTable, ivec2(column, distance * airNodes.y + elevation), 0).rgb;
}
vec3 airSourceOfAir(ivec3 node) { return airTexel(node.x, node.y, node.z); }
vec3 airSourceOfAerosol(ivec3 node) { return airTexel(airNodes.x + node.x, node.y, node.z); }
vec3 airSourceMultiple(ivec3 node) { return airTexel(2 * airNodes.x + node.x, node.y, node.z); }
vec3 airLogExtinction(ivec2 node) { return airTexel(3 * airNodes.x, node.x, node.y); }

// `away`: from the eye to the surface.
vec3 seenThroughAir(vec3 away, vec3 sent) {
  float distance = length(away);
  if (distance <= 0.0) return sent;
  vec3 direction = sunFromWorld * (away / distance);
  return throughAir(airBetween(direction, metresPerUnit * distance), direction, sent);
}
