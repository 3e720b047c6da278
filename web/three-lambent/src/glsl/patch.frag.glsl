// Exit radiance of a surface with meso-structure: B(q, v) · (M L), sloan2003biscale eq. 4, as
// shaders/opengl/patch.frag.glsl and shade::LitPatch.
//
// Numbers of a position and view are coefficient after coefficient, each R, G, B, in groups of
// four: RGBR GBRG BRGB … So three sums of every third group hold each channel in known places.
//
// Before this text stand: #define LAMBENT_FETCH; incident.glsl; LAMBENT_NUMBERS 0 (floats), 1 (halves) or 2 (bytes, whose scales the
// light holds already); LAMBENT_RESPONSE, which reads all groups of a row and adds their products
// with the light to sum0, sum1, sum2 (src/materials/incident-code.ts); LAMBENT_FILTER, LAMBENT_ID_MAP 0 or 1; row_place.glsl,
// view_square.glsl, rtt_footprint.glsl, tangent_frame.glsl,
// rtt_look_up.glsl, shading_point.glsl.

#include <common>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>

in vec3 tangent_;

#if LAMBENT_FETCH
flat in uvec3 corners;
in vec3 barycentric;
vec4 incident[LAMBENT_GROUPS];

void addIncident(int p, float weight) {
  ivec2 first = incidentPlace(p);
  for (int g = 0; g < LAMBENT_GROUPS; ++g) incident[g] += weight * incidentGroup(first, g);
}

// The light at this place of its triangle.
void interpolate() {
  for (int g = 0; g < LAMBENT_GROUPS; ++g) incident[g] = vec4(0.0);
  for (int k = 0; k < 3; ++k) addIncident(int(corners[k]), barycentric[k]);
}
#else
in vec4 incident[LAMBENT_GROUPS];
#endif

uniform highp usampler2DArray rtt;  // [level][y][x][view y][view x], a row for each
uniform ivec3 rttRows;
uniform bool viewDependent;
uniform vec2 pixelWidth;  // of a sub-sample, in metres: for each metre of distance, and anyway
#if LAMBENT_ID_MAP
uniform highp usampler2D idMap;
uniform vec2 periodsPerMetre;
#else
uniform vec2 tiles;  // q = tiles (u, −v)
#endif

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

// The response of one position, seen from one view, to the light that arrives here.
vec3 response(int row) {
  ivec3 first = rowPlace(rttRows, row);
  vec4 sum0 = vec4(0.0), sum1 = vec4(0.0), sum2 = vec4(0.0);
  uvec4 words;
  LAMBENT_RESPONSE
  return vec3(sum0.x + sum0.w + sum1.z + sum2.y, sum0.y + sum1.x + sum1.w + sum2.z,
              sum0.z + sum1.y + sum2.x + sum2.w);
}

vec2 patchPlace(vec2 uv) {
#if LAMBENT_ID_MAP
  ivec2 size = textureSize(idMap, 0);
  ivec2 texel = ivec2(clamp(floor(uv * vec2(size)), vec2(0.0), vec2(size - 1)));
  return vec2(texelFetch(idMap, texel, 0).rg) / 65536.0;
#else
  return fract(tiles * vec2(uv.x, -uv.y));
#endif
}

void main() {
#include <clipping_planes_fragment>
#include <logdepthbuf_fragment>
  ShadingPoint point = shadingPoint();
#if LAMBENT_FILTER && !LAMBENT_ID_MAP
  // The gradient of q along the triangle: q and the position are linear over it, so differences
  // between neighbouring pixels give it exactly. Of the two metres of a pixel's parallelogram, the
  // combination that has the differences' products.
  vec3 px = dFdx(point.position), py = dFdy(point.position);
  vec2 qx = tiles * dFdx(vec2(point.uv.x, -point.uv.y)), qy = tiles * dFdy(vec2(point.uv.x, -point.uv.y));
  float xx = dot(px, px), xy = dot(px, py), yy = dot(py, py);
  float area = xx * yy - xy * xy;
  vec3 alongX = area > 0.0 ? (yy * px - xy * py) / area : vec3(0.0);
  vec3 alongY = area > 0.0 ? (xx * py - xy * px) / area : vec3(0.0);
  vec3 gradientX = qx.x * alongX + qy.x * alongY, gradientY = qx.y * alongX + qy.y * alongY;
#endif
  gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
  if (gl_FrontFacing) {
#if LAMBENT_FETCH
    interpolate();
#endif
    mat3 frame = worldFromPatch(point.normal, tangent_);
    vec3 toViewer = point.toViewer * frame;
    chooseViews(viewDependent ? toViewer : vec3(0.0, 0.0, 1.0));
    vec2 q = patchPlace(point.uv);
#if LAMBENT_FILTER
    vec3 longer, shorter;
    footprintAxes(frame, toViewer, pixelWidth.x * point.distance + pixelWidth.y, longer, shorter);
#if LAMBENT_ID_MAP
    vec3 gradientX = frame[0] * periodsPerMetre.x, gradientY = frame[1] * periodsPerMetre.y;
#endif
    Probes probes = probesOf(vec2(dot(gradientX, longer), dot(gradientY, longer)),
                             vec2(dot(gradientX, shorter), dot(gradientY, shorter)),
                             vec2(levels[0].xy));
    // What filtered() would give, without its loops.
    if (probes.level == 0.0 && probes.count == 1)
      gl_FragColor.rgb = nearest(q);
    else
      gl_FragColor.rgb = filtered(q, probes);
#else
    gl_FragColor.rgb = nearest(q);
#endif
  }
#include <tonemapping_fragment>
#include <colorspace_fragment>
}
