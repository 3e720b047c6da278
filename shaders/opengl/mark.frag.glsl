// Before this text stands: mark.glsl.

uniform vec2 size;
uniform float brightness;

flat in vec4 ends;
flat in vec2 radii;
flat in vec3 color;
layout(location = 0) out vec4 radiance;

void main() {
  if (!insideOfMark(gl_FragCoord.xy - 0.5 * size, ends, radii)) discard;
  radiance = vec4(brightness * color, 1.0);
}
