// The texts of meso-structure, and where they read. Included once for each way that numbers are
// stored.
#include "shaders/incident.glsl"
#include "shaders/patch_place.glsl"
#include "shaders/rtt_footprint.glsl"
#include "shaders/rtt_response.glsl"
#include "shaders/tangent_frame.glsl"
#include "shaders/view_square.glsl"

#include "shaders/rtt_look_up.glsl"

const uvec4* numbers = nullptr;         // [level][y][x][view y][view x][texel]
const std::uint8_t* heights = nullptr;  // [level][y][x][view y][view x]
const transfer::IdMap* idMap = nullptr;

int lightPlace(int) {
  return 0;
}
vec4 lightGroup(int, int) {
  return {};
}
int rttPlace(int row) {
  return row * ((LAMBENT_GROUPS + kGroupsAFetch - 1) / kGroupsAFetch);
}
float heightAt(int row) {
  return float(heights[row]) / 255.0f;
}
uvec4 rttWords(int first, int texel) {
  return numbers[first + texel];
}
ivec2 idMapSize() {
  return {idMap->width, idMap->height};
}
uvec2 idMapTexel(ivec2 texel) {
  const std::uint16_t* id = idMap->ids.data() + 2 * (texel.y * idMap->width + texel.x);
  return {id[0], id[1]};
}
