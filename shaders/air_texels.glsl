// Surfaces through the air: shade::Air. A table of aerial_perspective.glsl is one map with a row for
// each distance and elevation; along a row lie the azimuths of the three sources, one source after
// the other, and then the extinction.
//
// Before this text: phase_function.glsl, aerial_perspective.glsl; the map airTable; #define LAMBENT_SHAFTS
// 1, shafts.glsl and the map of sun_shadow.glsl as shaftMap where things throw shadows into the air, or 0.

uniform mat3 sunFromWorld;
uniform float metresPerUnit;

vec3 airTexel(int column, int elevation, int distance) {
  return texelFetch(airTable, ivec2(column, distance * airNodes.y + elevation), 0).rgb;
}
vec3 airSourceOfAir(ivec3 node) { return airTexel(node.x, node.y, node.z); }
vec3 airSourceOfAerosol(ivec3 node) { return airTexel(airNodes.x + node.x, node.y, node.z); }
vec3 airSourceMultiple(ivec3 node) { return airTexel(2 * airNodes.x + node.x, node.y, node.z); }
vec3 airLogExtinction(ivec2 node) { return airTexel(3 * airNodes.x, node.x, node.y); }

#if LAMBENT_SHAFTS
uniform mat4 shaftMapFromWorld;  // to texels, and depth
uniform vec3 shaftEye;

// `point`: m, from the eye.
float sunVisible(vec3 point) {
  vec3 place = shaftEye + (point * sunFromWorld) / metresPerUnit;
  vec3 at = (shaftMapFromWorld * vec4(place, 1.0)).xyz;
  ivec2 texel = ivec2(floor(at.xy)), size = textureSize(shaftMap, 0);
  // Beyond the map's borders nothing stands.
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) return 1.0;
  return at.z <= texelFetch(shaftMap, texel, 0).r ? 1.0 : 0.0;
}

AirBetween shaftAir(vec3 direction, float metres) { return airBetween(direction, metres); }
#endif

// `away`: from the eye to the surface.
vec3 seenThroughAir(vec3 away, vec3 sent) {
  float distance = length(away);
  if (distance <= 0.0) return sent;
  vec3 direction = sunFromWorld * (away / distance);
#if LAMBENT_SHAFTS
  return throughShadowedAir(direction, metresPerUnit * distance, sent);
#else
  return throughAir(airBetween(direction, metresPerUnit * distance), direction, sent);
#endif
}
