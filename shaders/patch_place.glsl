// Where on the patch a place of the surface lies, in periods: shade::patchPlace and patchPlaces.
//
// Before this text stands: #define LAMBENT_ID_MAP 0 (there is none) or 1. After it, if 1: the
// functions that say where it lies.

#if LAMBENT_ID_MAP
ivec2 idMapSize();
uvec2 idMapTexel(ivec2 texel);

vec2 mappedPlace(vec2 uv) {
  ivec2 size = idMapSize();
  ivec2 texel = ivec2(clamp(floor(uv * vec2(size)), vec2(0.0), vec2(size - 1)));
  return vec2(idMapTexel(texel)) / 65536.0;
}

// The places that meet there, and their shares.
struct Places {
  int count;
  vec2 q[4];
  float share[4];
};

// alongX, alongY: how q changes from a texel to the next.
Places mappedPlaces(vec2 uv, vec2 alongX, vec2 alongY) {
  ivec2 size = idMapSize();
  vec2 at = clamp(uv * vec2(size) - 0.5, vec2(0.0), vec2(size - 1));
  ivec2 low = ivec2(at), high = min(low + 1, size - 1);
  vec2 part = at - vec2(low);
  vec2 same = abs(alongX) + abs(alongY) + 1.0 / 32768.0;
  vec2 q[4];
  float weight[4];
  for (int k = 0; k < 4; ++k) {
    ivec2 corner = ivec2(k & 1, k >> 1);
    ivec2 texel = ivec2(corner.x == 1 ? high.x : low.x, corner.y == 1 ? high.y : low.y);
    vec2 from = part - vec2(corner);
    q[k] = vec2(idMapTexel(texel)) / 65536.0 + from.x * alongX + from.y * alongY;
    vec2 share = 1.0 - abs(from);
    weight[k] = share.x * share.y;
  }
  Places places;
  places.count = 0;
  for (int k = 0; k < 4; ++k) {
    if (weight[k] == 0.0) continue;
    float share = 0.0;
    vec2 sum = vec2(0.0);
    for (int m = k; m < 4; ++m) {
      vec2 apart = q[m] - q[k];
      apart -= floor(apart + 0.5);
      if (abs(apart.x) > same.x || abs(apart.y) > same.y) continue;
      share += weight[m];
      sum += weight[m] * apart;
      if (m > k) weight[m] = 0.0;
    }
    places.q[places.count] = q[k] + sum / share;
    places.share[places.count++] = share;
  }
  return places;
}

const float kSeamReach = 0.75;  // pixels: half as wide as the lines that show seams

// How far off a seam lies, along which two pieces of the patch meet, in texels of the id map: where
// both have half a share it runs, and shares change by one over a texel. 1: there is none.
float texelsToSeam(Places places) {
  if (places.count < 2) return 1.0;
  float first = 0.0, second = 0.0;
  for (int i = 0; i < places.count; ++i) {
    float share = places.share[i];
    second = max(second, min(first, share));
    first = max(first, share);
  }
  return 0.5 * (first - second);
}

// Whether a seam runs within `reach` pixels. uvRight, uvUp: what a pixel further is in uv.
bool nearSeam(vec2 uv, vec2 alongX, vec2 alongY, vec2 uvRight, vec2 uvUp, float reach) {
  vec2 texels = vec2(idMapSize());
  float texelsAPixel = sqrt(abs(uvRight.x * uvUp.y - uvRight.y * uvUp.x) * texels.x * texels.y);
  float off = texelsToSeam(mappedPlaces(uv, alongX, alongY));
  if (off < min(reach * texelsAPixel, 0.5)) return true;
  // Where texels are smaller than pixels, neighbouring places tell of it.
  float beyond = texelsAPixel > 0.0 ? reach - 0.5 / texelsAPixel : 0.0;
  if (beyond <= 0.0) return false;
  for (int k = 0; k < 4; ++k) {
    vec2 way = (k & 1) == 0 ? uvRight : uvUp;
    vec2 beside = uv + (k < 2 ? beyond : -beyond) * way;
    if (texelsToSeam(mappedPlaces(beside, alongX, alongY)) < 0.5) return true;
  }
  return false;
}
#endif

vec2 tiledPlace(vec2 tiles, vec2 uv) { return fract(tiles * vec2(uv.x, -uv.y)); }
