// Exit radiance of diffuse receivers: M · L (sloan2002precomputed eq. 8). One invocation for each
// receiver.

layout(local_size_x = 64) in;

layout(std430, binding = 1) readonly buffer Light { float light[]; };  // [coefficient][3]
layout(std430, binding = 2) writeonly buffer Exit { float exitRadiance[]; };  // [receiver][3]

uniform uint receivers;     // in this chunk
uniform uint first;         // of this chunk in the output
uniform uint channels;      // 1 or 3
uniform uint coefficients;  // of a stored vector
uniform uint used;          // of them, as many as the light has

void main() {
  uint p = gl_GlobalInvocationID.x;
  if (p >= receivers) return;
  uint base = p * channels * coefficients;
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < used; ++k) {
    vec3 l = vec3(light[3u * k], light[3u * k + 1u], light[3u * k + 2u]);
    vec3 m = vec3(number(base + k));
    if (channels == 3u) {
      m.y = number(base + coefficients + k);
      m.z = number(base + 2u * coefficients + k);
    }
    sum += m * l;
  }
  uint at = 3u * (first + p);
  exitRadiance[at] = sum.x;
  exitRadiance[at + 1u] = sum.y;
  exitRadiance[at + 2u] = sum.z;
}
