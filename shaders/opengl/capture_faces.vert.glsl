// A body as the faces of all cubes see it, in one draw: an instance is a face, and every face is a
// tile of one large picture. Tiles are numbered [sample][face] and stand in rows from the lower left
// corner; clip distances keep a body inside of its tile. Its depth is written by the fragment
// shader, so that nothing is too near or too far.
//
// The faces' axes are those of lambent/capture/cube_map.cpp.

layout(location = 0) in vec3 bodyPosition;

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };  // in the asset's frame
layout(std430, binding = 2) readonly buffer Seen { int seen[]; };       // tiles that see the body

uniform mat4 assetFromBody;
uniform ivec2 tiles;    // across and up
uniform int firstSeen;  // where the instances begin

out vec3 fromPoint;
out float depth;  // along the face's axis, metres

const vec3 kForward[6] = vec3[](vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0),
                                vec3(0, 0, 1), vec3(0, 0, -1));
const vec3 kRight[6] = vec3[](vec3(0, 0, -1), vec3(0, 0, 1), vec3(1, 0, 0), vec3(1, 0, 0),
                              vec3(1, 0, 0), vec3(-1, 0, 0));
const vec3 kUp[6] = vec3[](vec3(0, -1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1),
                           vec3(0, -1, 0), vec3(0, -1, 0));

void main() {
  int tile = seen[firstSeen + gl_InstanceID];
  int face = tile % 6;
  fromPoint = (assetFromBody * vec4(bodyPosition, 1.0)).xyz - points[tile / 6].xyz;
  vec2 place = vec2(dot(kRight[face], fromPoint), dot(kUp[face], fromPoint));
  depth = dot(kForward[face], fromPoint);
  gl_ClipDistance[0] = depth + place.x;
  gl_ClipDistance[1] = depth - place.x;
  gl_ClipDistance[2] = depth + place.y;
  gl_ClipDistance[3] = depth - place.y;
  vec2 scale = 1.0 / vec2(tiles);
  vec2 middle = (2.0 * vec2(tile % tiles.x, tile / tiles.x) + 1.0) * scale - 1.0;
  gl_Position = vec4(place * scale + middle * depth, 0.0, depth);  // no near or far plane
}
