// Vertices are pulled from buffers: glDrawArrays of three vertices a triangle, no attributes. The
// fragment shader gets the three vertices' numbers and its place among them.

struct Vertex {
  vec4 positionU;  // world position, texture coordinate u
  vec4 normalV;    // unit normal, v
  vec4 color;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };

uniform mat4 clipFromWorld;

out vec3 barycentric;
flat out uvec3 triangle;
flat out vec3 geometricNormal;

void main() {
  uint corner = uint(gl_VertexID) % 3u;
  uint begin = uint(gl_VertexID) - corner;
  triangle = uvec3(corners[begin], corners[begin + 1u], corners[begin + 2u]);
  vec3 a = vertices[triangle.x].positionU.xyz;
  vec3 b = vertices[triangle.y].positionU.xyz;
  vec3 c = vertices[triangle.z].positionU.xyz;
  geometricNormal = cross(b - a, c - a);
  barycentric = vec3(corner == 0u, corner == 1u, corner == 2u);
  vec3 position = corner == 0u ? a : corner == 1u ? b : c;
  gl_Position = clipFromWorld * vec4(position, 1.0);
}
