// Radiance that reaches receivers, M L, times a factor for each row. Glossy: convolved with their
// lobe, α_i G_i (M L)_i k (sloan2002precomputed eq. 9 and 12). Under meso-structure: the factors are
// the scales of its texture's coefficients (sloan2003biscale eq. 4). One invocation for each receiver
// and row.
//
// Before this text stands: numbers.glsl.

layout(local_size_x = 64) in;

layout(std430, binding = 2) writeonly buffer Lit { float lit[]; };         // [receiver][row][3]
layout(std430, binding = 3) readonly buffer Factors { float factors[]; };  // [row]

uniform uint begin;      // the first receiver of the chunk that this dispatch is for
uniform uint receivers;  // and how many
uniform uint first;      // of the chunk in the output
uniform uint channels;   // 1 or 3
uniform uint rows;
uniform uint rowsUsed;  // of them, the first
uniform uint stride;    // numbers of a receiver in the output, 3 · rowsUsed at least
uniform vec3 reflectance;

void main() {
  uint p = gl_GlobalInvocationID.x / rowsUsed, i = gl_GlobalInvocationID.x % rowsUsed;
  if (p >= receivers) return;
  uint row = (begin + p) * channels * rows + i;
  vec3 sum = product(row, p);
  if (channels == 3u)
    sum = vec3(sum.x, product(row + rows, p).y, product(row + 2u * rows, p).z);
  sum *= reflectance * factors[i];
  uint at = (first + begin + p) * stride + 3u * i;
  lit[at] = sum.x;
  lit[at + 1u] = sum.y;
  lit[at + 2u] = sum.z;
}
