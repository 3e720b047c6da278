// The maps of environment.glsl, which stands before this text: a picture, another one in which all is
// gathered that has no place elsewhere, and a sky.

layout(binding = 1) uniform sampler2D environmentPicture;
layout(binding = 2) uniform sampler2D environmentRest;
layout(binding = 3) uniform sampler2D environmentSky;
uniform bool hasPicture, hasRest, hasSky;
uniform mat3 pictureFromEnvironment;

vec3 latLongTexel(sampler2D map, ivec2 texel) { return texelFetch(map, texel, 0).rgb; }

vec3 radianceOfMaps(vec3 d) {
  vec3 sum = vec3(0.0);
  if (hasPicture) sum += sampleLatLong(environmentPicture, pictureFromEnvironment * d);
  if (hasRest) sum += sampleLatLong(environmentRest, d);
  if (hasSky) sum += sampleSkylight(environmentSky, d);
  return sum;
}
