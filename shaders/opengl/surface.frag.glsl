// Exit radiance of a relit surface at one sub-sample. Alpha is coverage.
//
// Before this text stand: #define LAMBENT_KIND: 0 transfer at the vertices, 1 at texels, 2 a mirror,
// 3 black; LAMBENT_LOBE_GROUPS, LAMBENT_INTERPOLATED and LAMBENT_EACH_GROUP as in surface.vert.glsl
// and, if there is a lobe, harmonics() written out (harmonics_source.h); base_color.glsl;
// environment.glsl for mirrors.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 color;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 2) readonly buffer Diffuse { float diffuse[]; };  // [receiver][3]
layout(std430, binding = 3) readonly buffer Lobe { vec4 lobe[]; };  // [receiver][LAMBENT_LOBE_GROUPS]
layout(std430, binding = 5) readonly buffer Normals { vec4 normals[]; };  // of triangles, not unit

uniform vec4 eye;  // position, 1; or, for an orthographic camera, unit direction to the viewer, 0
uniform bool hasDiffuse, hasTexture, albedoOutside;
uniform vec3 mirror;
uniform ivec2 grid;  // texels: the whole grid's size
uniform ivec2 rows;  // texels: this draw shades what falls on rows.x … rows.y − 1; receiver 0 is
                     // the first texel of row rows.x

in vec3 position;
in vec4 normalU;
in vec4 colorV;
#if LAMBENT_KIND == 0
in vec3 exitRadiance;
#if LAMBENT_INTERPOLATED
in vec4 lobes[LAMBENT_LOBE_GROUPS];
#endif
#endif
layout(location = 0) out vec4 radiance;

// The view direction mirrored about the shading normal, as scene::surfaceAt turns it.
vec3 reflectedView() {
  vec3 front = normalize(normals[gl_PrimitiveID].xyz);
  vec3 normal = normalU.xyz;
  normal = dot(normal, normal) > 1e-30 ? normalize(normal) : front;
  float side = dot(normal, front);
  if (side < 0.0) normal = normalize(normal - 2.0 * side * front);
  vec3 toViewer = eye.w > 0.0 ? normalize(eye.xyz - position) : eye.xyz;
  return 2.0 * dot(normal, toViewer) * normal - toViewer;
}

vec3 baseColor() {
  vec3 base = colorV.rgb;
  if (hasTexture) base *= sampleBaseColor(vec2(normalU.w, colorV.w));
  return base;
}

#if LAMBENT_LOBE_GROUPS > 0
// Numbers of a lobe are coefficient after coefficient, each R, G, B, in groups of four: RGBR GBRG
// BRGB … So three sums of every third group hold each channel in known places.
float y[kCoefficients];
vec4 sums[3];

float factor(int number) { return y[min(number / 3, kCoefficients - 1)]; }
#define FACTORS(i) vec4(factor(4 * i), factor(4 * i + 1), factor(4 * i + 2), factor(4 * i + 3))

vec3 sumOfChannels() {
  return vec3(sums[0].x + sums[0].w + sums[1].z + sums[2].y,
              sums[0].y + sums[1].x + sums[1].w + sums[2].z,
              sums[0].z + sums[1].y + sums[2].x + sums[2].w);
}

void beginLobe(vec3 reflected) {
  harmonics(reflected, y);
  sums = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
}

// Adds a share of one receiver's lobe.
void addLobe(int receiver, float weight) {
  int first = receiver * LAMBENT_LOBE_GROUPS;
#define ADD_OF_RECEIVER(i) sums[i % 3] += weight * FACTORS(i) * lobe[first + i];
  LAMBENT_EACH_GROUP(ADD_OF_RECEIVER)
}
#endif

#if LAMBENT_KIND == 0

vec3 litRadiance() {
  vec3 sum = albedoOutside ? baseColor() * exitRadiance : exitRadiance;
#if LAMBENT_LOBE_GROUPS > 0
  beginLobe(reflectedView());
#if LAMBENT_INTERPOLATED
#define ADD(i) sums[i % 3] += FACTORS(i) * lobes[i];
  LAMBENT_EACH_GROUP(ADD)
#else
  ivec3 corner = ivec3(corners[3 * gl_PrimitiveID], corners[3 * gl_PrimitiveID + 1],
                       corners[3 * gl_PrimitiveID + 2]);
  vec3 a = vertices[corner.x].positionU.xyz;
  vec3 e1 = vertices[corner.y].positionU.xyz - a, e2 = vertices[corner.z].positionU.xyz - a;
  vec3 n = normals[gl_PrimitiveID].xyz;
  float u = dot(cross(e2, n), position - a) / dot(n, n);
  float v = dot(cross(n, e1), position - a) / dot(n, n);
  addLobe(corner.x, 1.0 - u - v);
  addLobe(corner.y, u);
  addLobe(corner.z, v);
#endif
  sum += baseColor() * sumOfChannels();
#endif
  return sum;
}

#elif LAMBENT_KIND == 1

// The four texels around this point and their weights. False where the point falls on rows that
// another draw shades.
int receiver[4];
float weight[4];

bool texelReceivers() {
  vec2 at = clamp(vec2(normalU.w, colorV.w) * vec2(grid) - 0.5, vec2(0.0), vec2(grid - 1));
  ivec2 a = ivec2(at), b = min(a + 1, grid - 1);
  if (a.y < rows.x || a.y >= rows.y) return false;
  vec2 w = at - vec2(a);
  int top = (a.y - rows.x) * grid.x, bottom = (b.y - rows.x) * grid.x;
  receiver = int[4](top + a.x, top + b.x, bottom + a.x, bottom + b.x);
  weight = float[4]((1.0 - w.y) * (1.0 - w.x), (1.0 - w.y) * w.x, w.y * (1.0 - w.x), w.y * w.x);
  return true;
}

vec3 litRadiance() {
  vec3 sum = vec3(0.0);
  if (hasDiffuse) {
    for (int k = 0; k < 4; ++k) {
      int at = 3 * receiver[k];
      sum += weight[k] * vec3(diffuse[at], diffuse[at + 1], diffuse[at + 2]);
    }
    if (albedoOutside) sum *= baseColor();
  }
#if LAMBENT_LOBE_GROUPS > 0
  beginLobe(reflectedView());
  for (int k = 0; k < 4; ++k)
    if (weight[k] != 0.0) addLobe(receiver[k], weight[k]);
  sum += baseColor() * sumOfChannels();
#endif
  return sum;
}

#elif LAMBENT_KIND == 2

vec3 litRadiance() { return mirror * baseColor() * sampleEnvironment(reflectedView()); }

#else

vec3 litRadiance() { return vec3(0.0); }

#endif

void main() {
#if LAMBENT_KIND == 1
  if (!texelReceivers()) discard;
#endif
  radiance = vec4(gl_FrontFacing ? litRadiance() : vec3(0.0), 1.0);
}
