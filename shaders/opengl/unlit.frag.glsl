// The base colour alone, of what faces the viewer.
//
// Before this text stand: base_color.glsl, coverage.glsl, base_color_map.glsl.

uniform bool hasColor;
uniform vec3 reflectance;

in vec2 uv;
in vec3 color;
in float vertexAlpha;
layout(location = 0) out vec4 radiance;

void main() {
  if (!isThere(vertexAlpha, uv, gl_FragCoord.xyz)) discard;
  vec3 base = baseColor(hasColor ? color : vec3(1.0), uv);
  radiance = vec4(gl_FrontFacing ? reflectance * base : vec3(0.0), 1.0);
}
