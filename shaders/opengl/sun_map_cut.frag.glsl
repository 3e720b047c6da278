// Depth alone, of what is there.
//
// Before this text stand: base_color.glsl, coverage.glsl, base_color_map.glsl.

in vec2 uv;
in float vertexAlpha;

void main() {
  if (!isThere(vertexAlpha, uv, gl_FragCoord.xyz)) discard;
}
