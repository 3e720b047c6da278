// Whether a surface is there at a fragment (scene::coverageAt): a mask is where its alpha reaches a
// threshold; a blend is in as large a share of the sub-samples as its alpha says, by a number of the
// pixel's own that is turned from one sub-sample to the next: by the golden ratio, or powers of the
// plastic number, so that of blends on each other each is there whether others are or not. A pane's
// tint is its mean.
//
// Before this text stands base_color.glsl; after it, with a texture, where that lies.

uniform int alphaMode;   // 0: it is whole, 1 a mask, 2 a blend
uniform vec2 alphaRule;  // the material's part of alpha, and the threshold of a mask
uniform float kept;      // of the light behind, by a pane: it is there in as many sub-samples, and as
                         // much brighter
uniform ivec2 veil;      // a blend's number among what is drawn, and the sub-sample's

#if LAMBENT_MAP
float baseColorAlpha(ivec2 texel);

float sampleAlpha(vec2 uv) {
  ivec2 size = baseColorSize();
  vec2 at = clamp(uv, -1e6, 1e6) * vec2(size) - 0.5;
  vec2 cell = floor(at), w = at - cell;
  ivec2 low = ivec2(cell);
  int x0 = wrapTexel(low.x, size.x, baseColorWrap.x);
  int x1 = wrapTexel(low.x + 1, size.x, baseColorWrap.x);
  int y0 = wrapTexel(low.y, size.y, baseColorWrap.y);
  int y1 = wrapTexel(low.y + 1, size.y, baseColorWrap.y);
  return mix(mix(baseColorAlpha(ivec2(x0, y0)), baseColorAlpha(ivec2(x1, y0)), w.x),
             mix(baseColorAlpha(ivec2(x0, y1)), baseColorAlpha(ivec2(x1, y1)), w.x), w.y);
}
#endif

// In [0, 1), of a pixel and a number.
float veilNumber(ivec2 pixel, int number) {
  uint h = uint(pixel.x) * 1664525u + uint(pixel.y) * 22695477u + uint(number) * 747796405u;
  h = (h ^ (h >> 16u)) * 2246822519u;
  h = (h ^ (h >> 13u)) * 3266489917u;
  h = h ^ (h >> 16u);
  return float(h >> 8u) / 16777216.0;
}

// Of a fragment at a pixel and a depth, gl_FragCoord.
bool isThere(float vertexAlpha, vec2 uv, vec3 fragment) {
  float share = kept;
  if (alphaMode != 0) {
    float alpha = alphaRule.x * vertexAlpha;
#if LAMBENT_MAP
    if (hasBaseColorMap()) alpha *= sampleAlpha(uv);
#endif
    if (alphaMode == 1 && alpha < alphaRule.y) return false;
    if (alphaMode == 2) share *= alpha;
  }
  if (share >= 1.0) return true;
  // What lies behind each other must not be there in the same sub-samples.
  int layer = veil.x * 1024 + int(fragment.z * 512.0);
  float number = veilNumber(ivec2(fragment.xy), layer);
  int kind = veil.x % 3;
  float turn = kind == 0 ? 0.618033988 : kind == 1 ? 0.754877666 : 0.569840291;
  return fract(number + turn * float(veil.y)) < share;
}
