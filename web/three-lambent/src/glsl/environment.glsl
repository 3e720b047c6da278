// The environment from a direction of the world, as light::Environment: a map in latitude and
// longitude that wraps around in azimuth and is constant towards the poles, discs, and what comes
// from everywhere. Three keeps the horizon's lower side at v = 0.

uniform sampler2D environmentMap;
uniform bool hasEnvironmentMap;
uniform mat3 environmentFromWorld;
uniform float environmentIntensity;
uniform vec3 environmentUniform;
uniform int discCount;
uniform vec4 discs[8];  // unit direction, 2 (1 − cos) of half the diameter
uniform vec3 discRadiance[8];

vec3 mapRadiance(vec3 d) {
  const float kPi = 3.14159265358979;
  ivec2 size = textureSize(environmentMap, 0);
  float u = atan(d.z, d.x) / (2.0 * kPi) + 0.5;
  float v = 0.5 + atan(d.y, length(d.xz)) / kPi;
  vec2 at = vec2(u, v) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  int x0 = (int(cell.x) + size.x) % size.x, x1 = (x0 + 1) % size.x;
  int y0 = clamp(int(cell.y), 0, size.y - 1), y1 = clamp(int(cell.y) + 1, 0, size.y - 1);
  return mix(mix(texelFetch(environmentMap, ivec2(x0, y0), 0).rgb,
                 texelFetch(environmentMap, ivec2(x1, y0), 0).rgb, w.x),
             mix(texelFetch(environmentMap, ivec2(x0, y1), 0).rgb,
                 texelFetch(environmentMap, ivec2(x1, y1), 0).rgb, w.x),
             w.y);
}

vec3 environmentRadiance(vec3 direction) {
  vec3 sum = environmentUniform;
  if (hasEnvironmentMap) sum += environmentIntensity * mapRadiance(environmentFromWorld * direction);
  for (int i = 0; i < discCount; ++i) {
    vec3 away = direction - discs[i].xyz;
    if (dot(away, away) <= discs[i].w) sum += discRadiance[i];
  }
  return sum;
}
