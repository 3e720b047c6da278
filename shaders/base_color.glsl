// Base colour, as shade::baseColorAt: that of the vertices times that of a texture, which is
// filtered bilinearly after decoding, at its finest level (scene::sampleBaseColor).
//
// Before this text stands: #define LAMBENT_MAP 0 (there is no texture) or 1. After it, if 1: the
// functions that say where the texture lies.

#if LAMBENT_MAP
uniform ivec2 baseColorWrap;  // along u and v: 0 repeat, 1 clamp to edge, 2 mirrored repeat

bool hasBaseColorMap();
ivec2 baseColorSize();
vec3 baseColorTexel(ivec2 texel);  // linear

int wrapTexel(int i, int size, int rule) {
  if (rule == 1) return clamp(i, 0, size - 1);
  int period = rule == 2 ? 2 * size : size;
  int k = i % period;
  if (k < 0) k += period;
  return k < size ? k : 2 * size - 1 - k;
}

vec3 sampleBaseColor(vec2 uv) {
  ivec2 size = baseColorSize();
  vec2 at = clamp(uv, -1e6, 1e6) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  ivec2 low = ivec2(cell);
  int x0 = wrapTexel(low.x, size.x, baseColorWrap.x);
  int x1 = wrapTexel(low.x + 1, size.x, baseColorWrap.x);
  int y0 = wrapTexel(low.y, size.y, baseColorWrap.y);
  int y1 = wrapTexel(low.y + 1, size.y, baseColorWrap.y);
  return mix(mix(baseColorTexel(ivec2(x0, y0)), baseColorTexel(ivec2(x1, y0)), w.x),
             mix(baseColorTexel(ivec2(x0, y1)), baseColorTexel(ivec2(x1, y1)), w.x), w.y);
}
#endif

vec3 baseColor(vec3 vertexColor, vec2 uv) {
#if LAMBENT_MAP
  if (hasBaseColorMap()) return vertexColor * sampleBaseColor(uv);
#endif
  return vertexColor;
}
