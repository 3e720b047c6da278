// Shafts of light: aerial perspective of which the Sun's part is left only where the Sun is seen
// (dobashi2002interactive). Visibility at planes across the view is the high frequency; light between
// two planes, a difference of what lies before each, the low one: sky::shaftsBySplitPlanes.
//
// Before this text: phase_function.glsl, aerial_perspective.glsl. After it: the functions that say what
// sees the Sun and which air it is.

uniform vec3 shaftOrigin;      // the viewer, m, where sunVisible() counts from
uniform vec3 shaftAxis;        // of the view, unit, in the Sun's frame
uniform vec2 shaftDepths;      // of the first and the last border, m along the axis
uniform float shaftRate;       // 1/m: 0 spaces borders evenly; see sky::SamplingPlanes
uniform ivec2 shaftPlanes;     // intervals; samples of visibility in each

// How much of the Sun is seen from a point of the Sun's frame, 0 … 1.
float sunVisible(vec3 point);
// airBetween() or constantAirBetween().
AirBetween shaftAir(vec3 direction, float metres);

float shaftBorder(int k) {
  float x = float(k) / float(shaftPlanes.x), span = shaftDepths.y - shaftDepths.x;
  if (shaftRate * span < 0.001) return shaftDepths.x + x * span;
  return shaftDepths.x - log(1.0 - x * (1.0 - exp(-shaftRate * span))) / shaftRate;
}

// In place of the Sun's part of the light that the air scatters towards the viewer.
vec3 shafts(vec3 direction, float metres) {
  float cosine = clamp(dot(direction, towardsSun), -1.0, 1.0);
  float perDepth = 1.0 / max(dot(direction, shaftAxis), 1e-6);
  float from = min(shaftBorder(0) * perDepth, metres);
  vec3 before = airFromSun(shaftAir(direction, from), cosine);
  vec3 sum = before;
  for (int k = 0; k < shaftPlanes.x; ++k) {
    float to = min(shaftBorder(k + 1) * perDepth, metres);
    if (to <= from) continue;
    float lit = 0.0;
    for (int i = 0; i < shaftPlanes.y; ++i) {
      float share = (float(i) + 0.5) / float(shaftPlanes.y);
      lit += sunVisible(shaftOrigin + mix(from, to, share) * direction);
    }
    vec3 next = airFromSun(shaftAir(direction, to), cosine);
    sum += lit / float(shaftPlanes.y) * (next - before);
    before = next;
    from = to;
  }
  return sum + airFromSun(shaftAir(direction, metres), cosine) - before;
}

// L_s, with shadows in the air.
vec3 throughShadowedAir(vec3 direction, float metres, vec3 radiance) {
  AirBetween air = shaftAir(direction, metres);
  return air.extinction * radiance + shafts(direction, metres) + air.multiple;
}
