// Radiance that reaches glossy receivers, M L, convolved with their lobe: α_i G_i (M L)_i k
// (sloan2002precomputed eq. 9 and 12). One invocation for each receiver and row.

layout(local_size_x = 64) in;

layout(std430, binding = 1) readonly buffer Light { float light[]; };  // [column][3]
layout(std430, binding = 2) writeonly buffer Lobe { float lobe[]; };   // [receiver][row][3]
layout(std430, binding = 3) readonly buffer Factors { float factors[]; };  // α_i G_i, [row]

uniform uint receivers;  // in this chunk
uniform uint first;      // of this chunk in the output
uniform uint channels;   // 1 or 3
uniform uint rows;
uniform uint columns;
uniform uint used;  // of the columns, as many as the light has
uniform vec3 glossy;

void main() {
  uint p = gl_GlobalInvocationID.x / rows, i = gl_GlobalInvocationID.x % rows;
  if (p >= receivers) return;
  uint base = (p * channels * rows + i) * columns;
  uint nextChannel = rows * columns;
  vec3 sum = vec3(0.0);
  for (uint j = 0u; j < used; ++j) {
    vec3 l = vec3(light[3u * j], light[3u * j + 1u], light[3u * j + 2u]);
    vec3 m = vec3(number(base + j));
    if (channels == 3u) {
      m.y = number(base + nextChannel + j);
      m.z = number(base + 2u * nextChannel + j);
    }
    sum += m * l;
  }
  sum *= glossy * factors[i];
  uint at = 3u * ((first + p) * rows + i);
  lobe[at] = sum.x;
  lobe[at + 1u] = sum.y;
  lobe[at + 2u] = sum.z;
}
