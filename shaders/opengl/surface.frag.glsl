// Exit radiance of a relit surface at one sub-sample. Alpha is as sample_alpha.glsl says.
//
// Before this text stand: #define LAMBENT_KIND: 0 transfer at the vertices, 1 at texels, 2 a mirror,
// 3 black; LAMBENT_GROUPS, LAMBENT_INTERPOLATED and LAMBENT_EACH_GROUP as in surface.vert.glsl and,
// if there is a lobe, harmonics() written out (harmonics_source.h), incident.glsl, lobe.glsl;
// base_color.glsl, with LAMBENT_ALPHA coverage.glsl, base_color_map.glsl, shading_normal.glsl,
// texel_receivers.glsl, corner_weights.glsl, sample_alpha.glsl; for receivers sun_shadow.glsl; for
// mirrors environment.glsl, environment_maps.glsl, local_capture.glsl; LAMBENT_AIR 1 for mirrors in
// air, with what air_texels.glsl says, or 0.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 color;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 2) readonly buffer Diffuse { float diffuse[]; };  // [receiver][3]
layout(std430, binding = 3) readonly buffer Lobe { vec4 lobe[]; };  // [receiver][LAMBENT_GROUPS]
layout(std430, binding = 5) readonly buffer Normals { vec4 normals[]; };  // of triangles, not unit

layout(std430, binding = 6) readonly buffer SunShare { float sunShare[]; };  // [receiver][3]
layout(binding = 4) uniform sampler2D sunMap;

uniform vec4 eye;  // position, 1; or, for an orthographic camera, unit direction to the viewer, 0
uniform bool hasDiffuse, albedoOutside;
uniform vec3 mirror;
uniform ivec2 grid;  // texels: the whole grid's size
uniform ivec2 rows;  // texels: this draw shades what falls on rows.x … rows.y − 1; receiver 0 is
                     // the first texel of row rows.x

uniform bool hasSunShare;           // to be taken out of the diffuse radiance
uniform bool sunlit, sunCanHide;    // by a Sun that is not in the diffuse radiance
uniform vec3 sentFromSun;           // reflectance / pi times irradiance of what faces the Sun
uniform vec3 sunDirection;

in vec3 position;
in vec4 normalU;
in vec4 colorV;
#if LAMBENT_ALPHA
in float vertexAlpha;
#endif
#if LAMBENT_KIND == 0
in vec3 exitRadiance;
#elif LAMBENT_KIND == 1
in vec2 texelUv;
#endif
layout(location = 0) out vec4 radiance;

vec2 uv() { return vec2(normalU.w, colorV.w); }

vec3 base() { return baseColor(colorV.rgb, uv()); }

vec3 normalSeen() { return shadingNormal(normalU.xyz, normalize(normals[gl_PrimitiveID].xyz)); }

vec3 reflectedView(vec3 normal) {
  return reflectAbout(eye.w > 0.0 ? normalize(eye.xyz - position) : eye.xyz, normal);
}

#if LAMBENT_GROUPS > 0
vec3 glossyRadiance() {
  vec3 normal = normalSeen();
  return base() * lobeRadiance(reflectedView(normal), normal);
}
#endif

#if LAMBENT_KIND < 2
float sunMapDepth(ivec2 texel) { return texelFetch(sunMap, texel, 0).r; }

vec3 sunRadiance() {
  if (!sunlit) return vec3(0.0);
  vec3 front = normalize(normals[gl_PrimitiveID].xyz);
  float cosine = dot(shadingNormal(normalU.xyz, front), sunDirection);
  if (cosine <= 0.0) return vec3(0.0);
  return base() * sentFromSun * cosine * (sunCanHide ? sunSeen(position, front) : 1.0);
}
#endif

#if LAMBENT_GROUPS > 0 && !LAMBENT_INTERPOLATED
int lightPlace(int receiver) { return receiver * LAMBENT_GROUPS; }
vec4 lightGroup(int first, int group) { return lobe[first + group]; }
#endif

#if LAMBENT_KIND == 0

vec3 litRadiance() {
  vec3 sum = (albedoOutside ? base() * exitRadiance : exitRadiance) + sunRadiance();
#if LAMBENT_GROUPS > 0
#if !LAMBENT_INTERPOLATED
  ivec3 corner = ivec3(corners[3 * gl_PrimitiveID], corners[3 * gl_PrimitiveID + 1],
                       corners[3 * gl_PrimitiveID + 2]);
  interpolateIncident(corner, cornerWeights(position, vertices[corner.x].positionU.xyz,
                                            vertices[corner.y].positionU.xyz,
                                            vertices[corner.z].positionU.xyz));
#endif
  sum += glossyRadiance();
#endif
  return sum;
}

#elif LAMBENT_KIND == 1

Texels texels;

// False where the place falls on rows that another draw shades.
bool chooseTexels() {
  texels = texelsAround(texelUv, grid);
  int first = rows.x * grid.x, end = rows.y * grid.x;
  if (texels.receiver.x < first || texels.receiver.x >= end) return false;
  texels.receiver -= first;
  return true;
}

vec3 litRadiance() {
  vec3 sum = vec3(0.0);
  if (hasDiffuse) {
    for (int k = 0; k < 4; ++k) {
      int at = 3 * texels.receiver[k];
      vec3 texel = vec3(diffuse[at], diffuse[at + 1], diffuse[at + 2]);
      if (hasSunShare) texel -= vec3(sunShare[at], sunShare[at + 1], sunShare[at + 2]);
      sum += texels.weight[k] * texel;
    }
    if (albedoOutside) sum *= base();
    sum += sunRadiance();
  }
#if LAMBENT_GROUPS > 0
  interpolateIncident(texels.receiver, texels.weight);
  sum += glossyRadiance();
#endif
  return sum;
}

#elif LAMBENT_KIND == 2

uniform int captureSample;

// Of a pixel and a sub-sample's number, in [0, 1), evenly: borders in what mirrors show have no teeth.
float capturePhase() {
  float pixel = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return fract(pixel + 0.618033988 * float(captureSample));
}

vec3 litRadiance() {
  vec3 direction = reflectedView(normalSeen()), shown = vec3(0.0);
  vec3 place;
  vec4 met = capturedAlong(position, direction, place);
  if (met.a < 1.0) {
    shown = environmentRadiance(direction);
#if LAMBENT_AIR
    shown = seenBehindAir(position, direction, shown);
#endif
  }
#if LAMBENT_AIR
  if (met.a > 0.0) met.rgb = met.a * seenThroughAir(place - position, met.rgb / met.a);
#endif
  return mirror * base() * (met.rgb + max(1.0 - met.a, 0.0) * shown);
}

#else

vec3 litRadiance() { return vec3(0.0); }

#endif

void main() {
#if LAMBENT_ALPHA
  if (!isThere(vertexAlpha, uv(), gl_FragCoord.xyz)) discard;
#endif
#if LAMBENT_KIND == 1
  if (!chooseTexels()) discard;
#endif
  vec3 sent = gl_FrontFacing ? litRadiance() : vec3(0.0);
#if LAMBENT_ALPHA
  sent /= max(kept, 1e-4);
#endif
  radiance = vec4(sent, coveredAt(position, eye));
}
