// From the hemisphere of view directions to the unit square of the view samples (shirley1997low):
// math::squareFromHemisphere, checked against it by a table test.

vec2 squareFromHemisphere(vec3 d) {
  const float kQuarterPi = 0.785398163397448;
  float across = length(d.xy);
  if (across == 0.0) return vec2(0.5);
  float z = clamp(d.z, 0.0, 1.0);
  // r = √(1 − z), from sin θ where that keeps more digits.
  float radius = across / sqrt(1.0 + z) / sqrt(max(1e-30, dot(d, d)));
  radius = d.z <= 0.0 ? 1.0 : min(1.0, radius);
  vec2 disc = d.xy / across * radius;
  bool wide = abs(disc.x) > abs(disc.y);
  float longer = wide ? disc.x : disc.y, shorter = wide ? disc.y : disc.x;
  // The signed radius is the longer of the square's two coordinates.
  float a = longer < 0.0 ? -radius : radius;
  float b = a * atan(shorter / longer) / kQuarterPi;
  return clamp(0.5 + 0.5 * (wide ? vec2(a, b) : vec2(b, a)), 0.0, 1.0);
}
