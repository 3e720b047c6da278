// A surface with meso-structure: vertices are pulled from buffers by their index. What the
// rasteriser interpolates is the light that arrives at the meso-structure, M L (sloan2003biscale §5).
//
// Before this text stand: #define LAMBENT_GROUPS, the light's numbers in groups of four;
// LAMBENT_EACH_GROUP(DO), which is DO(0) DO(1) … for all of them; LAMBENT_INTERPOLATED 1, or 0 where
// the rasteriser does not take as many; and LAMBENT_ALPHA 1 where it may be there in parts alone, or 0.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 tangentAlpha;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 1) readonly buffer Light { vec4 light[]; };  // [vertex][LAMBENT_GROUPS]

layout(std430, binding = 5) readonly buffer Tints { float tints[]; };  // [vertex][3], or none

uniform mat4 clipFromWorld;
uniform bool hasTints;

out vec3 position;
out vec4 normalU;
out vec4 tangentV;
out vec3 tint;
#if LAMBENT_ALPHA
out float vertexAlpha;
#endif
// As deep as what a layer lies on, whatever program draws that.
invariant gl_Position;
#if LAMBENT_INTERPOLATED
out vec4 incident[LAMBENT_GROUPS];
#endif

void main() {
  Vertex vertex = vertices[gl_VertexID];
  position = vertex.positionU.xyz;
  normalU = vec4(vertex.normalV.xyz, vertex.positionU.w);
  tangentV = vec4(vertex.tangentAlpha.xyz, vertex.normalV.w);
#if LAMBENT_ALPHA
  vertexAlpha = vertex.tangentAlpha.w;
#endif
  int at = 3 * gl_VertexID;
  tint = hasTints ? vec3(tints[at], tints[at + 1], tints[at + 2]) : vec3(1.0);
#if LAMBENT_INTERPOLATED
#define COPY(i) incident[i] = light[gl_VertexID * LAMBENT_GROUPS + i];
  LAMBENT_EACH_GROUP(COPY)
#endif
  gl_Position = clipFromWorld * vec4(position, 1.0);
}
