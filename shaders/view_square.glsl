// From the hemisphere of view directions to the unit square of the view samples (shirley1997low):
// math::squareFromHemisphere, checked against it by a table test; and what a place of the square looks
// along: the first two coordinates of math::hemisphereFromSquare over its third.

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

vec2 slopeFromSquare(vec2 square) {
  const float kQuarterPi = 0.785398163397448;
  vec2 at = 2.0 * square - 1.0;
  bool wide = abs(at.x) > abs(at.y);
  float radius = wide ? at.x : at.y, shorter = wide ? at.y : at.x;
  if (radius == 0.0) return vec2(0.0);
  float angle = kQuarterPi * (shorter / radius);
  float along = cos(angle), aside = sin(angle);
  vec2 disc = radius * (wide ? vec2(along, aside) : vec2(aside, along));
  return disc * (sqrt(2.0 - radius * radius) / (1.0 - radius * radius));
}
