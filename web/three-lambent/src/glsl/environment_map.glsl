// The maps of environment.glsl, which stands before this text. Three keeps their lowest row at v = 0.

uniform sampler2D environmentMap;
uniform bool hasEnvironmentMap;
uniform sampler2D environmentSky;
uniform bool hasEnvironmentSky;
uniform float environmentIntensity;

vec3 latLongTexel(sampler2D map, ivec2 texel) {
  return texelFetch(map, ivec2(texel.x, textureSize(map, 0).y - 1 - texel.y), 0).rgb;
}

vec3 radianceOfMaps(vec3 d) {
  vec3 sum = vec3(0.0);
  if (hasEnvironmentMap) sum += environmentIntensity * sampleLatLong(environmentMap, d);
  if (hasEnvironmentSky) sum += sampleSkylight(environmentSky, d);
  return sum;
}
