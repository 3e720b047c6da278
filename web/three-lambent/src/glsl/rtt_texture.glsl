// Where rtt_response.glsl, which stands before this text, finds the numbers of a position and view.
//
// Before this text stands: row_place.glsl; #define LAMBENT_RELIEF 0 or 1.

uniform highp usampler2DArray rtt;  // [level][y][x][view y][view x], a row for each
uniform ivec3 rttRows;

ivec3 rttPlace(int row) { return rowPlace(rttRows, row); }

uvec4 rttWords(ivec3 first, int texel) { return texelFetch(rtt, first + ivec3(texel, 0, 0), 0); }

#if LAMBENT_RELIEF
uniform highp sampler2DArray heights;  // a texel for each row
uniform ivec3 heightRows;

float heightAt(int row) { return texelFetch(heights, rowPlace(heightRows, row), 0).r; }
#endif
