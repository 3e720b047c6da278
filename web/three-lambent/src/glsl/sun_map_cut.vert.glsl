// Depth towards a point of the Sun, of what may be there in parts alone. What a geometry lacks is
// (0, 0, 0, 1).

in vec3 position;
in vec2 uv;
in vec4 color;

uniform mat4 clipFromAsset;

out vec2 place;
out float vertexAlpha;

void main() {
  place = uv;
  vertexAlpha = color.a;
  gl_Position = clipFromAsset * vec4(position, 1.0);
}
