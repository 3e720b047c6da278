// From linear radiance to what a screen shows: tone::toneMap and srgbEncode, checked against
// them by a table test. NaN and what is negative become 0.

float positiveRadiance(float x) { return x > 0.0 ? min(x, 65504.0) : 0.0; }

vec3 filmic(vec3 c) {
  vec3 x = vec3(positiveRadiance(c.r), positiveRadiance(c.g), positiveRadiance(c.b));
  return x * (1.0 + 2.0 * x) / (1.0 + 2.0 * x * (1.0 + x));
}

vec3 cutToOne(vec3 c) {
  return vec3(min(positiveRadiance(c.r), 1.0), min(positiveRadiance(c.g), 1.0),
              min(positiveRadiance(c.b), 1.0));
}

vec3 srgbEncode(vec3 linear) {
  vec3 curve = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}
