// The field of incident light at receivers, from light that was sampled at a few points: L_p = Σ w L
// (sloan2002precomputed §6, step 2, and §6.1). One invocation for each receiver and coefficient.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Samples { float samples[]; };  // [sample][coefficient][3]
// Of a receiver: four numbers of samples, 16 bits each, and four weights.
layout(std430, binding = 1) readonly buffer Blend { uint blend[]; };
layout(std430, binding = 2) writeonly buffer Light { float light[]; };  // [receiver][made][3]

uniform uint receivers;     // of this dispatch
uniform uint first;         // of them
uniform uint coefficients;  // of a sample
uniform uint used;          // of them, as many as the transfer takes
uniform uint made;          // of a receiver: used, and zeros

void main() {
  uint p = gl_GlobalInvocationID.x / made, j = gl_GlobalInvocationID.x % made;
  if (p >= receivers) return;
  uint from = (first + p) * 6u;
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < 4u && j < used; ++k) {
    float weight = uintBitsToFloat(blend[from + 2u + k]);
    if (weight == 0.0) continue;
    uint which = bitfieldExtract(blend[from + k / 2u], int(k & 1u) * 16, 16);
    uint at = (which * coefficients + j) * 3u;
    sum += weight * vec3(samples[at], samples[at + 1u], samples[at + 2u]);
  }
  uint at = (p * made + j) * 3u;
  light[at] = sum.x;
  light[at + 1u] = sum.y;
  light[at + 2u] = sum.z;
}
