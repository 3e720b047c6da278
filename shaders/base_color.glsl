// Base colour of a texture, as scene::sampleBaseColor: filtered after decoding.

layout(std430, binding = 4) readonly buffer SrgbTable { float linearFromSrgb[]; };  // 256
layout(binding = 0) uniform usampler2D baseColorTexture;                            // sRGB code values
uniform ivec2 wrap;  // 0 repeat, 1 clamp to edge, 2 mirrored repeat

int wrapTexel(int i, int size, int rule) {
  if (rule == 1) return clamp(i, 0, size - 1);
  int period = rule == 2 ? 2 * size : size;
  int k = i % period;
  if (k < 0) k += period;
  return k < size ? k : 2 * size - 1 - k;
}

vec3 baseTexel(int x, int y) {
  uvec4 t = texelFetch(baseColorTexture, ivec2(x, y), 0);
  return vec3(linearFromSrgb[t.r], linearFromSrgb[t.g], linearFromSrgb[t.b]);
}

vec3 sampleBaseColor(vec2 uv) {
  ivec2 size = textureSize(baseColorTexture, 0);
  vec2 at = clamp(uv, -1e6, 1e6) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  int x0 = wrapTexel(int(cell.x), size.x, wrap.x), x1 = wrapTexel(int(cell.x) + 1, size.x, wrap.x);
  int y0 = wrapTexel(int(cell.y), size.y, wrap.y), y1 = wrapTexel(int(cell.y) + 1, size.y, wrap.y);
  return mix(mix(baseTexel(x0, y0), baseTexel(x1, y0), w.x),
             mix(baseTexel(x0, y1), baseTexel(x1, y1), w.x), w.y);
}
