// What mirrors and the background show, looked up as light::Environment does: maps in latitude and
// longitude (bilinear, wrapped around in azimuth, constant towards the poles), discs, and a radiance
// from everywhere.
//
// After this text: the functions that say where maps lie, and what maps there are.

const int kMostDiscs = 16;

uniform mat3 environmentFromWorld;
uniform vec3 everywhere;
uniform int discCount;
// In the environment's frame: a unit axis, and the versine, 1 − cos of half the angular diameter: 1
// for half of the sphere, 2 for all of it.
uniform vec4 discs[kMostDiscs];
uniform vec3 discRadiances[kMostDiscs];   // of their centres
uniform vec3 discDarkenings[kMostDiscs];  // u in 1 - u (1 - mu), from the centre to the limb
uniform vec4 discHorizons[kMostDiscs];    // seen where xyz.d >= w

vec3 latLongTexel(sampler2D map, ivec2 texel);  // row 0 is at the zenith
vec3 radianceOfMaps(vec3 d);                    // d: unit, in the environment's frame

vec2 latLongFromDirection(vec3 d) {
  const float kPi = 3.14159265358979;
  return vec2(atan(d.z, d.x) / (2.0 * kPi) + 0.5, 0.5 - atan(d.y, length(d.xz)) / kPi);
}

vec3 sampleLatLong(sampler2D map, vec3 d) {
  ivec2 size = textureSize(map, 0);
  vec2 at = latLongFromDirection(d) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  int x0 = (int(cell.x) + size.x) % size.x, x1 = (x0 + 1) % size.x;
  int y0 = clamp(int(cell.y), 0, size.y - 1), y1 = clamp(int(cell.y) + 1, 0, size.y - 1);
  return mix(mix(latLongTexel(map, ivec2(x0, y0)), latLongTexel(map, ivec2(x1, y0)), w.x),
             mix(latLongTexel(map, ivec2(x0, y1)), latLongTexel(map, ivec2(x1, y1)), w.x), w.y);
}

// `worldDirection` need not be unit.
vec3 environmentRadiance(vec3 worldDirection) {
  vec3 d = normalize(environmentFromWorld * worldDirection);
  vec3 sum = everywhere + radianceOfMaps(d);
  for (int k = 0; k < discCount; ++k) {
    // |d − axis|² = 2 (1 − cos): compares small angles without cancellation.
    vec3 off = d - discs[k].xyz;
    float inside = 2.0 * discs[k].w - dot(off, off);
    if (inside < 0.0 || dot(d, discHorizons[k].xyz) < discHorizons[k].w) continue;
    float mu = sqrt(inside / (2.0 * discs[k].w));
    sum += discRadiances[k] * (vec3(1.0) - discDarkenings[k] * (1.0 - mu));
  }
  return sum;
}
