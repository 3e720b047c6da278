// Exit radiance of a surface with meso-structure at one sub-sample: B(q, v) · (M L), sloan2003biscale eq.
// 4, as shade::LitPatch. Alpha is coverage.
//
// Numbers of a position and view are coefficient after coefficient, each R, G, B, in groups of
// four: RGBR GBRG BRGB … So three sums of every third group hold each channel in known places.
//
// Before this text stand: #define LAMBENT_GROUPS, LAMBENT_INTERPOLATED and LAMBENT_EACH_GROUP as in
// patch.vert.glsl; LAMBENT_NUMBERS 0 (floats), 1 (halves) or 2 (bytes, whose scales the light holds
// already); LAMBENT_RESPONSE, which is READ(0) ADD(0) ADD(1) … READ(1) … for all fetches and the
// groups that each brings; LAMBENT_FILTER 0 or 1; view_square.glsl, rtt_footprint.glsl,
// tangent_frame.glsl, rtt_look_up.glsl.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 tangent;
};
struct Triangle {
  vec4 normal;               // by its winding, not unit
  vec4 gradientX, gradientY;  // of q along the surface
};

layout(std430, binding = 2) readonly buffer Triangles { Triangle triangles[]; };
#if !LAMBENT_INTERPOLATED
layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 1) readonly buffer Light { vec4 light[]; };
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };
#endif

layout(binding = 0) uniform usamplerBuffer rtt;  // [level][y][x][view y][view x][group]
layout(binding = 1) uniform usampler2D idMap;

uniform vec4 eye;         // position, 1; or, for an orthographic camera, direction to the viewer, 0
uniform vec2 pixelWidth;  // of a sub-sample, in metres: for each metre of distance, and anyway
uniform bool viewDependent, hasIdMap;
uniform vec2 tiles;            // without an id map: q = tiles (u, −v)
uniform vec2 periodsPerMetre;  // with one

in vec3 position;
in vec4 normalU;
in vec4 tangentV;
#if LAMBENT_INTERPOLATED
in vec4 incident[LAMBENT_GROUPS];
#else
vec4 incident[LAMBENT_GROUPS];

// The light at this place of its triangle.
void interpolate() {
  uvec3 corner = uvec3(corners[3 * gl_PrimitiveID], corners[3 * gl_PrimitiveID + 1],
                       corners[3 * gl_PrimitiveID + 2]);
  vec3 a = vertices[corner.x].positionU.xyz;
  vec3 e1 = vertices[corner.y].positionU.xyz - a, e2 = vertices[corner.z].positionU.xyz - a;
  vec3 n = cross(e1, e2);
  float u = dot(cross(e2, n), position - a) / dot(n, n);
  float v = dot(cross(n, e1), position - a) / dot(n, n);
  ivec3 first = ivec3(corner) * LAMBENT_GROUPS;
#define MIX(i) \
  incident[i] = (1.0 - u - v) * light[first.x + i] + u * light[first.y + i] + v * light[first.z + i];
  LAMBENT_EACH_GROUP(MIX)
}
#endif

layout(location = 0) out vec4 radiance;

#if LAMBENT_NUMBERS == 2
const int kGroupsAFetch = 4;
vec4 group(uvec4 words, int i) {
  int word = int(words[i]);
  return vec4(ivec4(word << 24, word << 16, word << 8, word) >> 24);
}
#elif LAMBENT_NUMBERS == 1
const int kGroupsAFetch = 2;
vec4 group(uvec4 words, int i) {
  return vec4(unpackHalf2x16(words[2 * i]), unpackHalf2x16(words[2 * i + 1]));
}
#else
const int kGroupsAFetch = 1;
vec4 group(uvec4 words, int i) { return uintBitsToFloat(words); }
#endif
const int kFetches = (LAMBENT_GROUPS + kGroupsAFetch - 1) / kGroupsAFetch;

// The response of one position, seen from one view, to the light that arrives here. Written out: as
// loops over arrays it took three times as long on a CPU's OpenGL.
vec3 response(int place) {
  vec4 sum[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  uvec4 words;
  int first = place * kFetches;
#define READ(f) words = texelFetch(rtt, first + f);
#define ADD(i) sum[i % 3] += group(words, i % kGroupsAFetch) * incident[i];
  LAMBENT_RESPONSE
  return vec3(sum[0].x + sum[0].w + sum[1].z + sum[2].y, sum[0].y + sum[1].x + sum[1].w + sum[2].z,
              sum[0].z + sum[1].y + sum[2].x + sum[2].w);
}

vec2 patchPlace(vec2 uv) {
  if (hasIdMap) {
    ivec2 size = textureSize(idMap, 0);
    ivec2 texel = ivec2(clamp(floor(uv * vec2(size)), vec2(0.0), vec2(size - 1)));
    return vec2(texelFetch(idMap, texel, 0).rg) / 65536.0;
  }
  return fract(tiles * vec2(uv.x, -uv.y));
}

void main() {
  radiance = vec4(0.0, 0.0, 0.0, 1.0);
  if (!gl_FrontFacing) return;
#if !LAMBENT_INTERPOLATED
  interpolate();
#endif
  Triangle triangle = triangles[gl_PrimitiveID];
  vec3 front = normalize(triangle.normal.xyz);
  vec3 normal = normalU.xyz;
  normal = dot(normal, normal) > 1e-30 ? normalize(normal) : front;
  float side = dot(normal, front);
  if (side < 0.0) normal = normalize(normal - 2.0 * side * front);  // as scene::surfaceAt
  mat3 frame = worldFromPatch(normal, tangentV.xyz);
  vec3 away = eye.xyz - position;
  float distance = length(away);
  vec3 toViewer = (eye.w > 0.0 ? away / distance : eye.xyz) * frame;
  chooseViews(viewDependent ? toViewer : vec3(0.0, 0.0, 1.0));

  vec2 q = patchPlace(vec2(normalU.w, tangentV.w));
#if LAMBENT_FILTER
  vec3 longer, shorter;
  footprintAxes(frame, toViewer, pixelWidth.x * distance + pixelWidth.y, longer, shorter);
  vec3 x = triangle.gradientX.xyz, y = triangle.gradientY.xyz;
  if (hasIdMap) {
    x = frame[0] * periodsPerMetre.x;
    y = frame[1] * periodsPerMetre.y;
  }
  Probes probes = probesOf(vec2(dot(x, longer), dot(y, longer)),
                           vec2(dot(x, shorter), dot(y, shorter)), vec2(levels[0].xy));
  // What filtered() would give, without its loops.
  if (probes.level == 0.0 && probes.count == 1)
    radiance.rgb = nearest(q);
  else
    radiance.rgb = filtered(q, probes);
#else
  radiance.rgb = nearest(q);
#endif
}
