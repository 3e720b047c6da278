// Marks: six vertices each, pulled by their index. Before this text stands: mark.glsl.

struct Mark {
  vec4 fromRed, toGreen, normalBlue;
  vec4 radii;  // x at `from`, y at `to`: pixels
};
layout(std430, binding = 0) readonly buffer Marks { Mark marks[]; };

uniform mat4 clipFromSurface;
uniform vec4 eye;   // position, 1; or direction to an orthographic viewer, 0
uniform vec2 size;  // of the picture, pixels
uniform float pixel;

flat out vec4 ends;
flat out vec2 radii;
flat out vec3 color;

void main() {
  Mark mark = marks[gl_VertexID / 6];
  int k = gl_VertexID % 6;
  vec2 corner = vec2(k == 0 || k == 2 || k == 3 ? -1.0 : 1.0, k < 2 || k == 4 ? -1.0 : 1.0);
  vec4 from = liftedMark(clipFromSurface, mark.fromRed.xyz, mark.normalBlue.xyz, pixel);
  vec4 to = liftedMark(clipFromSurface, mark.toGreen.xyz, mark.normalBlue.xyz, pixel);
  ends = markEnds(from, to, size);
  radii = mark.radii.xy;
  color = vec3(mark.fromRed.w, mark.toGreen.w, mark.normalBlue.w);
  float facing = dot(mark.normalBlue.xyz, normalize(eye.xyz - eye.w * mark.fromRed.xyz));
  gl_Position = markCorner(from, to, facing, corner, size, max(radii.x, radii.y));
}
