// A body looks the same from everywhere in front of it, and is black from behind.

uniform vec3 radiance;

in vec2 depthAndW;

layout(location = 0) out vec4 color;

void main() {
  gl_FragDepth = clamp(0.5 * depthAndW.x / depthAndW.y + 0.5, 0.0, 1.0);
  color = vec4(gl_FrontFacing ? radiance : vec3(0.0), 1.0);
}
