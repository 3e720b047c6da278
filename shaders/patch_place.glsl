// Where on the patch a place of the surface lies, periods in [0, 1): shade::patchPlace.
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
#endif

vec2 tiledPlace(vec2 tiles, vec2 uv) { return fract(tiles * vec2(uv.x, -uv.y)); }
