// One triangle over the whole picture, as far away as can be.

out vec2 place;

void main() {
  place = position.xy;
#if defined(USE_REVERSED_DEPTH_BUFFER) || defined(USE_REVERSEDEPTHBUF)
  gl_Position = vec4(position.xy, 0.0, 1.0);
#else
  gl_Position = vec4(position.xy, 1.0, 1.0);
#endif
}
