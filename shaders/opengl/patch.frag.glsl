// Exit radiance of a surface with meso-structure at one sub-sample: B(q, v) · (M L),
// sloan2003biscale eq. 4, as shade::LitPatch, times the base colour. Alpha is as sample_alpha.glsl says.
//
// Before this text stand: #define LAMBENT_FILTER, LAMBENT_RELIEF and LAMBENT_ALPHA, 0 or 1, and what these want: incident.glsl,
// corner_weights.glsl, rtt_response.glsl, view_square.glsl, rtt_footprint.glsl, rtt_look_up.glsl,
// tangent_frame.glsl, shading_normal.glsl, patch_place.glsl, sample_alpha.glsl; base_color.glsl, with
// LAMBENT_ALPHA coverage.glsl, base_color_map.glsl, whose texture is at binding 0.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 tangentAlpha;
};
struct Triangle {
  vec4 normal;                // by its winding, not unit
  vec4 alongX, alongY;        // the gradient of q; with an id map what a step of 1 in u, or v, is
};

layout(std430, binding = 2) readonly buffer Triangles { Triangle triangles[]; };

layout(binding = 3) uniform usamplerBuffer rtt;  // [level][y][x][view y][view x][group]
layout(binding = 1) uniform usampler2D idMap;
#if LAMBENT_RELIEF
layout(binding = 2) uniform samplerBuffer heights;  // [level][y][x][view y][view x]

float heightAt(int row) { return texelFetch(heights, row).r; }
#endif

uniform vec4 eye;         // position, 1; or, for an orthographic camera, direction to the viewer, 0
uniform vec2 pixelWidth;  // of a sub-sample, in metres: for each metre of distance, and anyway
uniform bool viewDependent, hasIdMap;
uniform vec2 tiles;            // without an id map: q = tiles (u, −v)
uniform vec2 periodsPerMetre;  // with one
uniform vec4 seams;            // radiance of the lines where pieces of the patch meet, 1; or 0: none

in vec3 position;
in vec4 normalU;
in vec4 tangentV;
in vec3 tint;  // of the vertices
#if LAMBENT_ALPHA
in float vertexAlpha;
#endif
layout(location = 0) out vec4 radiance;

#if !LAMBENT_INTERPOLATED
layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 1) readonly buffer Light { vec4 light[]; };
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };

int lightPlace(int receiver) { return receiver * LAMBENT_GROUPS; }
vec4 lightGroup(int first, int group) { return light[first + group]; }
#endif

const int kTexels = (LAMBENT_GROUPS + kGroupsAFetch - 1) / kGroupsAFetch;

int rttPlace(int row) { return row * kTexels; }
uvec4 rttWords(int first, int texel) { return texelFetch(rtt, first + texel); }

ivec2 idMapSize() { return textureSize(idMap, 0); }
uvec2 idMapTexel(ivec2 texel) { return texelFetch(idMap, texel, 0).rg; }

// uvRight, uvUp: what a pixel further is in uv.
vec3 litRadiance(vec2 uvRight, vec2 uvUp) {
#if !LAMBENT_INTERPOLATED
  ivec3 corner = ivec3(corners[3 * gl_PrimitiveID], corners[3 * gl_PrimitiveID + 1],
                       corners[3 * gl_PrimitiveID + 2]);
  interpolateIncident(corner, cornerWeights(position, vertices[corner.x].positionU.xyz,
                                            vertices[corner.y].positionU.xyz,
                                            vertices[corner.z].positionU.xyz));
#endif
  Triangle triangle = triangles[gl_PrimitiveID];
  mat3 frame = worldFromPatch(shadingNormal(normalU.xyz, normalize(triangle.normal.xyz)),
                              tangentV.xyz);
  vec3 away = eye.xyz - position;
  float distance = length(away);
  vec3 toViewer = (eye.w > 0.0 ? away / distance : eye.xyz) * frame;
  chooseViews(viewDependent ? toViewer : vec3(0.0, 0.0, 1.0));

  vec2 uv = vec2(normalU.w, tangentV.w);
#if LAMBENT_FILTER
  float width = pixelWidth.x * distance + pixelWidth.y;
  vec3 x = triangle.alongX.xyz, y = triangle.alongY.xyz;
  Places places;
  if (hasIdMap) {
    vec3 u = x, v = y;
    x = frame[0] * periodsPerMetre.x;
    y = frame[1] * periodsPerMetre.y;
    vec2 texels = vec2(idMapSize());
    vec2 alongX = vec2(dot(x, u), dot(y, u)) / texels.x;
    vec2 alongY = vec2(dot(x, v), dot(y, v)) / texels.y;
    if (seams.w > 0.0 && nearSeam(uv, alongX, alongY, uvRight, uvUp, kSeamReach)) return seams.rgb;
    places = mappedPlaces(uv, alongX, alongY);
  } else {
    places.count = 1;
    places.q[0] = tiledPlace(tiles, uv);
    places.share[0] = 1.0;
  }
  vec3 sum = vec3(0.0);
  for (int i = 0; i < places.count; ++i)
    sum += places.share[i] * averaged(places.q[i], frame, toViewer, width, x, y);
  return baseColor(tint, uv) * sum;
#else
  return baseColor(tint, uv) * nearest(hasIdMap ? mappedPlace(uv) : tiledPlace(tiles, uv));
#endif
}

void main() {
  vec2 uv = vec2(normalU.w, tangentV.w);
  vec2 uvRight = dFdx(uv), uvUp = dFdy(uv);
#if LAMBENT_ALPHA
  if (!isThere(vertexAlpha, uv, gl_FragCoord.xyz)) discard;
#endif
  vec3 sent = vec3(0.0);
  if (gl_FrontFacing) sent = litRadiance(uvRight, uvUp);
#if LAMBENT_ALPHA
  sent /= max(kept, 1e-4);
#endif
  radiance = vec4(sent, coveredAt(position, eye));
}
