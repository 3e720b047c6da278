// What mirrors and the background show, looked up as light::Environment does: maps in latitude and
// longitude (bilinear, wrapped around in azimuth, constant towards the poles), a sky above a horizon,
// discs, and a radiance from everywhere.
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

// Of the map that sampleSkylight looks up: its own frame, +y up; and in the environment's frame up,
// and the sine of the elevation of its horizon, above which it is seen.
uniform mat3 skylightFromEnvironment;
uniform vec4 skylightHorizon;

vec3 latLongTexel(sampler2D map, ivec2 texel);  // row 0 is at the zenith
vec3 radianceOfMaps(vec3 d);                    // d: unit, in the environment's frame

vec2 latLongFromDirection(vec3 d) {
  const float kPi = 3.14159265358979;
  return vec2(atan(d.z, d.x) / (2.0 * kPi) + 0.5, 0.5 - atan(d.y, length(d.xz)) / kPi);
}

// Between the centres of texels, `at` counting from that of the first one.
vec3 sampleBetween(sampler2D map, vec2 at) {
  ivec2 size = textureSize(map, 0);
  vec2 cell = floor(at), w = at - cell;
  int x0 = (int(cell.x) + size.x) % size.x, x1 = (x0 + 1) % size.x;
  int y0 = clamp(int(cell.y), 0, size.y - 1), y1 = clamp(int(cell.y) + 1, 0, size.y - 1);
  return mix(mix(latLongTexel(map, ivec2(x0, y0)), latLongTexel(map, ivec2(x1, y0)), w.x),
             mix(latLongTexel(map, ivec2(x0, y1)), latLongTexel(map, ivec2(x1, y1)), w.x), w.y);
}

vec3 sampleLatLong(sampler2D map, vec3 d) {
  return sampleBetween(map, latLongFromDirection(d) * vec2(textureSize(map, 0)) - 0.5);
}

// A sky is steepest at its horizon, and so rows lie closer there: with h its elevation, row r of n is
// that of elevation h + (pi/2 - h) v^2, v = 1 - r/(n - 1): the first is the zenith, the last the
// horizon itself. Columns are those of a map in latitude and longitude.
vec3 sampleSkylight(sampler2D map, vec3 d) {
  const float kPi = 3.14159265358979;
  float sine = skylightHorizon.w;
  if (dot(d, skylightHorizon.xyz) <= sine) return vec3(0.0);
  vec2 size = vec2(textureSize(map, 0));
  vec2 place = latLongFromDirection(skylightFromEnvironment * d);
  float horizon = atan(sine, sqrt(1.0 - sine * sine));
  float above = (kPi * (0.5 - place.y) - horizon) / (0.5 * kPi - horizon);
  float v = sqrt(clamp(above, 0.0, 1.0));
  return sampleBetween(map, vec2(place.x * size.x - 0.5, (1.0 - v) * (size.y - 1.0)));
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
