// Adds one sub-sample's picture to the sum, seen through the air that lies before it, and where it left
// a pixel uncovered what the environment shows there. Air is looked through here and not where surfaces
// are drawn: once for each pixel, however many surfaces lie behind one another.
//
// Before this text stand: #define LAMBENT_BACKGROUND 0 or 1 and, if 1, environment.glsl and
// environment_maps.glsl; LAMBENT_AIR 1, with what air_table.glsl says, or 0.

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) readonly uniform image2D one;  // alpha: sample_alpha.glsl
layout(rgba32f, binding = 1) uniform image2D sum;           // radiance and coverage

// The ray through this sub-sample of pixel (x, y), y from the bottom: corner + x right + y up.
uniform vec3 corner, right, up;
#if LAMBENT_AIR
uniform vec3 from;  // the camera
#if LAMBENT_SHAFTS
uniform bool curtain;  // there will be a background: shafts of light stand before it too

// What the shadows of things take from the air before the background, as far as the scene reaches:
// radiance that is negative.
vec3 takenByShadows(vec3 direction) {
  float metres = shaftDepths.y / max(dot(direction, shaftAxis), 1e-6);
  float cosine = clamp(dot(direction, towardsSun), -1.0, 1.0);
  return shafts(direction, metres) - airFromSun(airBetween(direction, metres), cosine);
}
#endif
#endif

#if LAMBENT_BACKGROUND
layout(rgba32f, binding = 2) uniform image2D behind;  // radiance, and how many sub-samples it is of

vec3 radianceBehind(vec3 direction) {
  vec3 shown = environmentRadiance(direction);
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
#if LAMBENT_BACKGROUND || LAMBENT_AIR
  vec3 direction = corner + float(at.x) * right + float(at.y) * up;
#endif
#if LAMBENT_AIR
  if (here.a < 0.0) here.rgb = seenThroughAir(-here.a * normalize(direction), here.rgb);
#if LAMBENT_SHAFTS
  if (curtain && here.a == 0.0) here.rgb += takenByShadows(sunFromWorld * normalize(direction));
#endif
#endif
  float covered = here.a == 0.0 ? 0.0 : 1.0;
  imageStore(sum, at, imageLoad(sum, at) + vec4(here.rgb, covered));
#if LAMBENT_BACKGROUND
  if (covered == 0.0)
    imageStore(behind, at, imageLoad(behind, at) + vec4(radianceBehind(direction), 1.0));
#endif
}
