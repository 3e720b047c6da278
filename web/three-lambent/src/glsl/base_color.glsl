// The part of the base colour that varies over a primitive: COLOR_0 × baseColorTexture, the texture
// filtered after decoding, at its finest level, as scene::sampleBaseColor.

uniform sampler2D baseColorMap;  // sRGB, which the hardware decodes
uniform ivec2 baseColorWrap;     // 0 repeat, 1 clamp to edge, 2 mirrored repeat

int wrapTexel(int i, int size, int rule) {
  if (rule == 1) return clamp(i, 0, size - 1);
  int period = rule == 2 ? 2 * size : size;
  int k = i % period;
  if (k < 0) k += period;
  return k < size ? k : 2 * size - 1 - k;
}

vec3 sampleBaseColor(vec2 uv) {
  ivec2 size = textureSize(baseColorMap, 0);
  vec2 at = clamp(uv, -1e6, 1e6) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  ivec2 low = ivec2(cell);
  int x0 = wrapTexel(low.x, size.x, baseColorWrap.x), x1 = wrapTexel(low.x + 1, size.x, baseColorWrap.x);
  int y0 = wrapTexel(low.y, size.y, baseColorWrap.y), y1 = wrapTexel(low.y + 1, size.y, baseColorWrap.y);
  return mix(mix(texelFetch(baseColorMap, ivec2(x0, y0), 0).rgb,
                 texelFetch(baseColorMap, ivec2(x1, y0), 0).rgb, w.x),
             mix(texelFetch(baseColorMap, ivec2(x0, y1), 0).rgb,
                 texelFetch(baseColorMap, ivec2(x1, y1), 0).rgb, w.x),
             w.y);
}
