// Depth alone, of what is there.
//
// Before this text stand: base_color.glsl, coverage.glsl, with a map base_color_map.glsl.

in vec2 place;
in float vertexAlpha;
out vec4 color;

void main() {
  if (!isThere(vertexAlpha, place, gl_FragCoord.xyz)) discard;
  color = vec4(0.0);
}
