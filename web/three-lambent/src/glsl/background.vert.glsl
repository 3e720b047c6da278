// One triangle over the whole picture, as far away as can be.

out vec2 place;

void main() {
  place = position.xy;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}
