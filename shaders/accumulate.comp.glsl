// Adds one sub-sample's picture to the sum.

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) readonly uniform image2D one;
layout(rgba32f, binding = 1) uniform image2D sum;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(sum)))) return;
  imageStore(sum, at, imageLoad(sum, at) + imageLoad(one, at));
}
