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
#endif

vec2 tiledPlace(vec2 tiles, vec2 uv) { return fract(tiles * vec2(uv.x, -uv.y)); }
