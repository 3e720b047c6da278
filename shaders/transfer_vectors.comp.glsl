// Exit radiance of diffuse receivers: M · L (sloan2002precomputed eq. 8). One invocation for each
// receiver.

layout(local_size_x = 64) in;

layout(std430, binding = 1) readonly buffer Light { float light[]; };  // [receiver or one][used][3]
layout(std430, binding = 2) writeonly buffer Exit { float exitRadiance[]; };  // [receiver][3]

uniform uint begin;        // the first receiver of the chunk that this dispatch is for
uniform uint receivers;    // and how many
uniform uint first;        // of the chunk in the output
uniform uint channels;     // 1 or 3
uniform uint columns;      // coefficients of a stored vector
uniform uint used;         // of them, as many as the light has
uniform uint lightStride;  // numbers of a receiver's light; 0: all have the same

void main() {
  uint p = gl_GlobalInvocationID.x;
  if (p >= receivers) return;
  uint base = (begin + p) * channels * columns;
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < used; ++k) {
    uint from = p * lightStride + 3u * k;
    vec3 l = vec3(light[from], light[from + 1u], light[from + 2u]);
    vec3 m = vec3(number(base + k));
    if (channels == 3u) {
      m.y = number(base + columns + k);
      m.z = number(base + 2u * columns + k);
    }
    sum += m * l;
  }
  uint at = 3u * (first + begin + p);
  exitRadiance[at] = sum.x;
  exitRadiance[at + 1u] = sum.y;
  exitRadiance[at + 2u] = sum.z;
}
