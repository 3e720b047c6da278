// The ground of an environment through the air, behind everything and in mirrors:
// shade::Air::seenBehind.
//
// Before this text: air_texels.glsl and what it wants.

uniform vec3 airGround;  // where heights are counted from, in the asset's frame

// What the environment shows along a unit direction from an eye or a mirror.
vec3 seenBehindAir(vec3 from, vec3 direction, vec3 radiance) {
  float height = metresPerUnit * (sunFromWorld * (from - airGround)).y;
  return throughAirBehind(sunFromWorld * direction, height, radiance);
}
