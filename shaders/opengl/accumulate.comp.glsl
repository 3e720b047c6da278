// Adds one sub-sample's picture to the sum and, where it left a pixel uncovered, what the
// environment shows there.
//
// Before this text stand: #define LAMBENT_BACKGROUND 0 or 1 and, if 1, environment.glsl and
// environment_maps.glsl; LAMBENT_AIR 1, with what air_table.glsl says, or 0.

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) readonly uniform image2D one;
layout(rgba32f, binding = 1) uniform image2D sum;

#if LAMBENT_BACKGROUND
layout(rgba32f, binding = 2) uniform image2D behind;  // radiance, and how many sub-samples it is of
// The ray through this sub-sample of pixel (x, y), y from the bottom: corner + x right + y up.
uniform vec3 corner, right, up;
#if LAMBENT_AIR
uniform vec3 from;  // the camera
#endif

vec3 radianceBehind(vec2 at) {
  vec3 direction = corner + at.x * right + at.y * up, shown = environmentRadiance(direction);
#if LAMBENT_AIR
  shown = seenBehindAir(from, normalize(direction), shown);
#endif
  return shown;
}
#endif

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(sum)))) return;
  vec4 here = imageLoad(one, at);
  imageStore(sum, at, imageLoad(sum, at) + here);
#if LAMBENT_BACKGROUND
  if (here.a < 1.0)
    imageStore(behind, at, imageLoad(behind, at) + vec4(radianceBehind(vec2(at)), 1.0));
#endif
}
