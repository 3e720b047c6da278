// Marks over a picture: lines of a width in pixels, thinner towards their end, with round ends; a
// line from a place to itself is a disc. They lie a little off the surface, so that it hides those
// alone that lie behind it; those on what is seen at a grazing angle, or faces away, are not drawn,
// for they would stand out beside its outline.

const float kMarkLift = 1.5;      // pixels
const float kMarkGrazing = 0.15;  // the least cosine at which they are seen

// Where a place of the surface is in clip space once it is lifted off. `pixel`: the width of one,
// in metres, for each unit of clip space's w.
vec4 liftedMark(mat4 clipFromSurface, vec3 place, vec3 normal, float pixel) {
  float w = (clipFromSurface * vec4(place, 1.0)).w;
  return clipFromSurface * vec4(place + kMarkLift * pixel * w * normal, 1.0);
}

// Both ends in pixels from the picture's middle.
vec4 markEnds(vec4 from, vec4 to, vec2 size) {
  return vec4(0.5 * size * (from.xy / from.w), 0.5 * size * (to.xy / to.w));
}

// A corner of what covers it: x, y of ±1, x < 0 at `from`. `facing`: the cosine between its normal
// and the way to the viewer. What is not to be seen is nowhere.
vec4 markCorner(vec4 from, vec4 to, float facing, vec2 corner, vec2 size, float radius) {
  if (facing < kMarkGrazing || from.w <= 0.0 || to.w <= 0.0) return vec4(2.0, 2.0, 2.0, 1.0);
  vec4 ends = markEnds(from, to, size);
  vec2 along = ends.zw - ends.xy;
  float length_ = length(along);
  along = length_ > 1e-3 ? along / length_ : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  vec2 place = corner.x < 0.0 ? ends.xy : ends.zw;
  place += (radius + 1.0) * (corner.x * along + corner.y * across);
  float depth = corner.x < 0.0 ? from.z / from.w : to.z / to.w;
  return vec4(place / (0.5 * size), depth, 1.0);
}

// radii: at both ends, pixels.
bool insideOfMark(vec2 place, vec4 ends, vec2 radii) {
  vec2 along = ends.zw - ends.xy, off = place - ends.xy;
  float square = dot(along, along);
  float at = square > 1e-6 ? clamp(dot(off, along) / square, 0.0, 1.0) : 0.0;
  return length(off - at * along) <= mix(radii.x, radii.y, at);
}
