// The map of environment.glsl, which stands before this text. Three keeps its lowest row at v = 0.

uniform sampler2D environmentMap;
uniform bool hasEnvironmentMap;
uniform float environmentIntensity;

vec3 latLongTexel(sampler2D map, ivec2 texel) {
  return texelFetch(map, ivec2(texel.x, textureSize(map, 0).y - 1 - texel.y), 0).rgb;
}

vec3 radianceOfMaps(vec3 d) {
  return hasEnvironmentMap ? environmentIntensity * sampleLatLong(environmentMap, d) : vec3(0.0);
}
