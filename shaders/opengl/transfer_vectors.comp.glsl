// Exit radiance of diffuse receivers: M · L (sloan2002precomputed eq. 8). One invocation for each
// receiver.
//
// Before this text stands: numbers.glsl.

layout(local_size_x = 64) in;

layout(std430, binding = 2) writeonly buffer Exit { float exitRadiance[]; };  // [receiver][3]

uniform uint begin;      // the first receiver of the chunk that this dispatch is for
uniform uint receivers;  // and how many
uniform uint first;      // of the chunk in the output
uniform uint channels;   // 1 or 3

void main() {
  uint p = gl_GlobalInvocationID.x;
  if (p >= receivers) return;
  uint row = (begin + p) * channels;
  vec3 sum = product(row, p);
  if (channels == 3u) sum = vec3(sum.x, product(row + 1u, p).y, product(row + 2u, p).z);
  uint at = 3u * (first + begin + p);
  exitRadiance[at] = sum.x;
  exitRadiance[at + 1u] = sum.y;
  exitRadiance[at + 2u] = sum.z;
}
