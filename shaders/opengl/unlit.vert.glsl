// A surface without light: what relighting costs is measured against it.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 color;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };

uniform mat4 clipFromWorld;

out vec2 uv;
out vec3 color;
out float vertexAlpha;

void main() {
  Vertex vertex = vertices[gl_VertexID];
  uv = vec2(vertex.positionU.w, vertex.normalV.w);
  color = vertex.color.rgb;
  vertexAlpha = vertex.color.a;
  gl_Position = clipFromWorld * vec4(vertex.positionU.xyz, 1.0);
}
