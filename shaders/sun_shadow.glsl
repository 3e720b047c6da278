// Whether a point of the Sun is seen from a place of a surface, by a map of depths towards it: 0 … 1,
// bilinear between the four texels around.
//
// Each texel is compared with the depth that the plane of the surface's own triangle has at the
// texel's middle, so that a plane never hides itself, however low the Sun; but with the place's own
// where that is nearer to the Sun, for what lies behind a place does not hide it. What other triangles
// of a curved surface reach beyond that plane within a texel is allowed for by lifting the place along
// the triangle's normal by kSunLift texels times the sine between normal and Sun. A triangle that faces
// away from the Sun does not see it, whatever its shading normal says: so rays have it too.
//
// After this text: the function that reads the map.

uniform mat4 sunMapFromWorld;     // to texels, and depth 0 … 1, growing away from the Sun
uniform mat3 sunFrameFromWorld;   // rows: along the map's x and y, and towards the Sun
uniform vec4 sunMapScales;        // width and height in texels; a texel, metres; depth, metres
const float kSunLift = 0.25;       // texels
const float kSunLeastCosine = 0.01;

float sunMapDepth(ivec2 texel);

// `front`: the triangle's own normal, unit.
float sunSeen(vec3 position, vec3 front) {
  vec3 n = sunFrameFromWorld * front;
  if (n.z <= 0.0) return 0.0;
  float texel = sunMapScales.z, range = sunMapScales.w;
  float lift = kSunLift * texel * length(n.xy) + 1e-6 * range;
  vec3 at = (sunMapFromWorld * vec4(position + lift * front, 1.0)).xyz;
  // Along the plane, depth per texel.
  vec2 slope = n.xy / max(n.z, kSunLeastCosine) * (texel / range);
  vec2 cell = at.xy - 0.5, low = floor(cell), w = cell - low;
  vec4 seen;
  for (int k = 0; k < 4; ++k) {
    vec2 tap = low + vec2(k & 1, k >> 1);
    float plane = at.z + min(0.0, dot(slope, tap - cell));
    ivec2 texelAt = clamp(ivec2(tap), ivec2(0), ivec2(sunMapScales.xy) - 1);
    seen[k] = plane <= sunMapDepth(texelAt) ? 1.0 : 0.0;
  }
  return mix(mix(seen.x, seen.y, w.x), mix(seen.z, seen.w, w.x), w.y);
}
