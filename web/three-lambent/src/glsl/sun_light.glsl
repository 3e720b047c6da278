// What a diffuse surface sends out of the light of a sharp Sun, as sunRadiance() of
// shaders/opengl/surface.frag.glsl; in the asset's frame.
//
// Before this text stand: #define LAMBENT_SUN 1, or 2 where surfaces hide it, with sun_shadow.glsl.

uniform vec3 sunDirection;
uniform vec3 sunIrradiance;    // of what faces it
uniform vec3 sunReflectance;   // without what varies over the surface

#if LAMBENT_SUN == 2
uniform highp sampler2D sunMap;

float sunMapDepth(ivec2 texel) { return texelFetch(sunMap, texel, 0).r; }
#endif

// `front`: the triangle's own normal.
vec3 sunRadiance(vec3 position, vec3 normal, vec3 front) {
  const float kPerPi = 0.318309886183791;
  float cosine = dot(normal, sunDirection);
  if (cosine <= 0.0) return vec3(0.0);
  vec3 sent = sunReflectance * sunIrradiance * (kPerPi * cosine);
#if LAMBENT_SUN == 2
  sent *= sunSeen(position, front);
#endif
  return sent;
}
