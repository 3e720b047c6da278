// Depth towards a point of the Sun: vertices are pulled from buffers by their index.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 color;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };

uniform mat4 clipFromWorld;

void main() { gl_Position = clipFromWorld * vec4(vertices[gl_VertexID].positionU.xyz, 1.0); }
