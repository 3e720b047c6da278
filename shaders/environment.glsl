// What mirrors and the background show: a picture of the environment in latitude and longitude,
// looked up as light::Environment looks up an image: bilinear, wraps around in azimuth, constant
// towards the poles.

layout(binding = 1) uniform sampler2D environment;
uniform mat3 environmentFromWorld;

vec2 latLongFromDirection(vec3 d) {
  const float kPi = 3.14159265358979;
  return vec2(atan(d.z, d.x) / (2.0 * kPi) + 0.5, 0.5 - atan(d.y, length(d.xz)) / kPi);
}

// `d` need not be unit.
vec3 sampleEnvironment(vec3 d) {
  ivec2 size = textureSize(environment, 0);
  vec2 at = latLongFromDirection(environmentFromWorld * d) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  int x0 = (int(cell.x) + size.x) % size.x, x1 = (x0 + 1) % size.x;
  int y0 = clamp(int(cell.y), 0, size.y - 1), y1 = clamp(int(cell.y) + 1, 0, size.y - 1);
  return mix(mix(texelFetch(environment, ivec2(x0, y0), 0).rgb,
                 texelFetch(environment, ivec2(x1, y0), 0).rgb, w.x),
             mix(texelFetch(environment, ivec2(x0, y1), 0).rgb,
                 texelFetch(environment, ivec2(x1, y1), 0).rgb, w.x),
             w.y);
}
