// Depth towards a point of the Sun.

in vec3 position;

uniform mat4 clipFromAsset;

void main() { gl_Position = clipFromAsset * vec4(position, 1.0); }
