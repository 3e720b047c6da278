// A relit surface: vertices are pulled from buffers by their index. With transfer at the vertices,
// the rasteriser interpolates what came of the light there: exit radiance, and the convolved lobe.
//
// Before this text stand: #define LAMBENT_KIND, LAMBENT_GROUPS (the lobe's numbers in groups of four,
// 0: not glossy), LAMBENT_INTERPOLATED 1, or 0 where the rasteriser does not take as many, and
// LAMBENT_ALPHA 1 where it may be there in parts alone, or 0, and LAMBENT_EACH_GROUP(DO), which is DO(0) DO(1) … for all of them.

struct Vertex {
  vec4 positionU;  // world position, texture coordinate u
  vec4 normalV;    // unit normal, v
  vec4 color;      // and alpha
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 2) readonly buffer Diffuse { float diffuse[]; };  // [receiver][3]
layout(std430, binding = 3) readonly buffer Lobe { vec4 lobe[]; };  // [receiver][LAMBENT_GROUPS]

layout(std430, binding = 6) readonly buffer SunShare { float sunShare[]; };  // [receiver][3]

#if LAMBENT_KIND == 1
layout(std430, binding = 7) readonly buffer TexelUvs { vec2 texelUvs[]; };
out vec2 texelUv;
#endif

uniform mat4 clipFromWorld;
uniform bool hasDiffuse, hasSunShare;  // the share is to be taken out

out vec3 position;
out vec4 normalU;
out vec4 colorV;
#if LAMBENT_ALPHA
out float vertexAlpha;
#endif
#if LAMBENT_KIND == 0
out vec3 exitRadiance;
#if LAMBENT_INTERPOLATED
out vec4 incident[LAMBENT_GROUPS];
#endif
#endif

// As deep as layers that lie on it.
invariant gl_Position;

void main() {
  Vertex vertex = vertices[gl_VertexID];
  position = vertex.positionU.xyz;
  normalU = vec4(vertex.normalV.xyz, vertex.positionU.w);
  colorV = vec4(vertex.color.rgb, vertex.normalV.w);
#if LAMBENT_KIND == 1
  texelUv = texelUvs[gl_VertexID];
#endif
#if LAMBENT_ALPHA
  vertexAlpha = vertex.color.a;
#endif
#if LAMBENT_KIND == 0
  int at = 3 * gl_VertexID;
  exitRadiance = hasDiffuse ? vec3(diffuse[at], diffuse[at + 1], diffuse[at + 2]) : vec3(0.0);
  if (hasSunShare) exitRadiance -= vec3(sunShare[at], sunShare[at + 1], sunShare[at + 2]);
#if LAMBENT_INTERPOLATED
#define COPY(i) incident[i] = lobe[gl_VertexID * LAMBENT_GROUPS + i];
  LAMBENT_EACH_GROUP(COPY)
#endif
#endif
  gl_Position = clipFromWorld * vec4(position, 1.0);
}
