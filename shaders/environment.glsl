// What mirrors and the background show, looked up as light::Environment does: a picture in latitude
// and longitude (bilinear, wraps around in azimuth, constant towards the poles), another one, in
// which all is gathered that has no place here, discs, and a radiance from everywhere.
//
// Before this text stands: #define LAMBENT_MOST_DISCS.

layout(binding = 1) uniform sampler2D environmentPicture;
layout(binding = 2) uniform sampler2D environmentRest;
uniform bool hasPicture, hasRest;
uniform mat3 environmentFromWorld, pictureFromEnvironment;
uniform vec3 everywhere;
uniform int discCount;
uniform vec4 discs[LAMBENT_MOST_DISCS];  // unit axis, 1 − cos of half the angular diameter
uniform vec3 discRadiances[LAMBENT_MOST_DISCS];

vec2 latLongFromDirection(vec3 d) {
  const float kPi = 3.14159265358979;
  return vec2(atan(d.z, d.x) / (2.0 * kPi) + 0.5, 0.5 - atan(d.y, length(d.xz)) / kPi);
}

vec3 sampleLatLong(sampler2D picture, vec3 d) {
  ivec2 size = textureSize(picture, 0);
  vec2 at = latLongFromDirection(d) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  int x0 = (int(cell.x) + size.x) % size.x, x1 = (x0 + 1) % size.x;
  int y0 = clamp(int(cell.y), 0, size.y - 1), y1 = clamp(int(cell.y) + 1, 0, size.y - 1);
  return mix(
      mix(texelFetch(picture, ivec2(x0, y0), 0).rgb, texelFetch(picture, ivec2(x1, y0), 0).rgb, w.x),
      mix(texelFetch(picture, ivec2(x0, y1), 0).rgb, texelFetch(picture, ivec2(x1, y1), 0).rgb, w.x),
      w.y);
}

// `worldDirection` need not be unit.
vec3 sampleEnvironment(vec3 worldDirection) {
  vec3 d = normalize(environmentFromWorld * worldDirection);
  vec3 sum = everywhere;
  if (hasPicture) sum += sampleLatLong(environmentPicture, pictureFromEnvironment * d);
  if (hasRest) sum += sampleLatLong(environmentRest, d);
  for (int k = 0; k < discCount; ++k) {
    vec3 off = d - discs[k].xyz;
    if (dot(off, off) <= 2.0 * discs[k].w) sum += discRadiances[k];
  }
  return sum;
}
