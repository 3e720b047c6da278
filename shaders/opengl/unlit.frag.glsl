// The base colour alone, of what faces the viewer.
//
// Before this text stands: base_color.glsl.

uniform bool hasColor, hasTexture;
uniform vec3 reflectance;

in vec2 uv;
in vec3 color;
layout(location = 0) out vec4 radiance;

void main() {
  vec3 base = hasColor ? color : vec3(1.0);
  if (hasTexture) base *= sampleBaseColor(uv);
  radiance = vec4(gl_FrontFacing ? reflectance * base : vec3(0.0), 1.0);
}
