// The four texels around a place of a grid of receivers, and their weights, which sum to 1:
// shade::ReceiverWeights::ofTexels.

struct Texels {
  ivec4 receiver;  // row by row from v = 0
  vec4 weight;
};

Texels texelsAround(vec2 uv, ivec2 grid) {
  vec2 at = clamp(uv * vec2(grid) - 0.5, vec2(0.0), vec2(grid - 1));
  ivec2 a = ivec2(at), b = min(a + 1, grid - 1);
  vec2 w = at - vec2(a);
  int top = a.y * grid.x, bottom = b.y * grid.x;
  return Texels(
      ivec4(top + a.x, top + b.x, bottom + a.x, bottom + b.x),
      vec4((1.0 - w.y) * (1.0 - w.x), (1.0 - w.y) * w.x, w.y * (1.0 - w.x), w.y * w.x));
}
