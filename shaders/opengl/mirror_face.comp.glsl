// Adds one sub-sample of what a face of a mirror's capture shows to the mean of those before it: as
// local_capture.glsl reads it. Where a veil lets some of them through into nothing, what the
// environment shows there is part of the mean.
//
// Before this text stand: #define LAMBENT_FORMAT, the capture's; LAMBENT_BACKGROUND 1, with
// environment.glsl and environment_maps.glsl, where there are veils, or 0.

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) readonly uniform image2D one;  // alpha: sample_alpha.glsl
layout(LAMBENT_FORMAT, binding = 1) uniform imageCube mean;

uniform int face, number;         // of the face, and of the sub-sample
uniform vec3 corner, right, up;  // the ray through texel (x, y): corner + x right + y up

const float kMostRadiance = 65504.0;  // of 16 bits

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(one)))) return;
  vec4 here = imageLoad(one, at);
  here.a = max(-here.a, 0.0);
#if LAMBENT_BACKGROUND
  if (here.a == 0.0) here.rgb = environmentRadiance(corner + float(at.x) * right + float(at.y) * up);
#endif
  here.rgb = clamp(here.rgb, -kMostRadiance, kMostRadiance);
  if (number > 0) {
    vec4 before = imageLoad(mean, ivec3(at, face));
    float share = 1.0 / float(number + 1);
    float distance = before.a == 0.0 ? here.a : here.a == 0.0 ? before.a : mix(before.a, here.a, share);
    here = vec4(mix(before.rgb, here.rgb, share), distance);
  }
  imageStore(mean, ivec3(at, face), here);
}
