// What the shadows of things take from the air before the background, as far as the scene reaches:
// radiance that is negative, without coverage.
//
// Before this text: what air_texels.glsl says, with LAMBENT_SHAFTS 1.

// The ray through this sub-sample of pixel (x, y), y from the bottom: corner + x right + y up.
uniform vec3 corner, right, up;

layout(location = 0) out vec4 radiance;

void main() {
  vec2 at = floor(gl_FragCoord.xy);
  vec3 direction = sunFromWorld * normalize(corner + at.x * right + at.y * up);
  float metres = shaftDepths.y / max(dot(direction, shaftAxis), 1e-6);
  float cosine = clamp(dot(direction, towardsSun), -1.0, 1.0);
  vec3 lit = airFromSun(airBetween(direction, metres), cosine);
  radiance = vec4(shafts(direction, metres) - lit, 0.0);
}
