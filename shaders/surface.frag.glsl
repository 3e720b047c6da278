// Exit radiance of a relit surface at one sub-sample. Alpha is coverage.
//
// Before this text stand: #define LAMBENT_GLOSSY 0 or 1 and, if 1, sh.glsl; base_color.glsl;
// environment.glsl.

struct Vertex {
  vec4 positionU;
  vec4 normalV;
  vec4 color;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, binding = 2) readonly buffer Diffuse { float diffuse[]; };  // [receiver][3]
layout(std430, binding = 3) readonly buffer Lobe { float lobe[]; };  // [receiver][coefficient][3]

const int kVertices = 0, kTexels = 1, kMirror = 2, kBlack = 3;
uniform int kind;
uniform vec4 eye;  // position, 1; or, for an orthographic camera, unit direction to the viewer, 0

uniform bool hasDiffuse, hasTexture, albedoOutside;
uniform vec3 mirror;
uniform ivec2 grid;  // texels: the whole grid's size
uniform ivec2 rows;  // texels: this draw shades what falls on rows.x … rows.y − 1; receiver 0 is
                     // the first texel of row rows.x

in vec3 barycentric;
flat in uvec3 triangle;
flat in vec3 geometricNormal;
layout(location = 0) out vec4 radiance;

// The receivers around this point and their weights: three of a triangle, or four of the grid.
uint receiver[4];
float weight[4];

void triangleReceivers() {
  receiver = uint[4](triangle.x, triangle.y, triangle.z, triangle.x);
  weight = float[4](barycentric.x, barycentric.y, barycentric.z, 0.0);
}

// False where the point falls on rows that another draw shades.
bool texelReceivers(vec2 uv) {
  vec2 at = clamp(uv * vec2(grid) - 0.5, vec2(0.0), vec2(grid - 1));
  ivec2 a = ivec2(at), b = min(a + 1, grid - 1);
  if (a.y < rows.x || a.y >= rows.y) return false;
  vec2 w = at - vec2(a);
  uint top = uint((a.y - rows.x) * grid.x), bottom = uint((b.y - rows.x) * grid.x);
  receiver = uint[4](top + uint(a.x), top + uint(b.x), bottom + uint(a.x), bottom + uint(b.x));
  weight = float[4]((1.0 - w.y) * (1.0 - w.x), (1.0 - w.y) * w.x, w.y * (1.0 - w.x), w.y * w.x);
  return true;
}

vec3 diffuseRadiance() {
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    uint at = 3u * receiver[k];
    sum += weight[k] * vec3(diffuse[at], diffuse[at + 1u], diffuse[at + 2u]);
  }
  return sum;
}

#if LAMBENT_GLOSSY
vec3 glossyRadiance(vec3 reflected) {
  float y[kCoefficients];
  harmonics(reflected, y);
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    if (weight[k] == 0.0) continue;
    uint at = 3u * uint(kCoefficients) * receiver[k];
    vec3 here = vec3(0.0);
    for (int i = 0; i < kCoefficients; ++i, at += 3u)
      here += y[i] * vec3(lobe[at], lobe[at + 1u], lobe[at + 2u]);
    sum += weight[k] * here;
  }
  return sum;
}
#endif

void main() {
  radiance = vec4(0.0, 0.0, 0.0, 1.0);
  Vertex a = vertices[triangle.x], b = vertices[triangle.y], c = vertices[triangle.z];
  vec3 w = barycentric;
  vec2 uv = w.x * vec2(a.positionU.w, a.normalV.w) + w.y * vec2(b.positionU.w, b.normalV.w) +
            w.z * vec2(c.positionU.w, c.normalV.w);
  if (kind == kTexels) {
    if (!texelReceivers(uv)) discard;
  } else {
    triangleReceivers();
  }
  if (kind == kBlack || !gl_FrontFacing) return;

  vec3 position = w.x * a.positionU.xyz + w.y * b.positionU.xyz + w.z * c.positionU.xyz;
  vec3 front = normalize(geometricNormal);
  vec3 normal = w.x * a.normalV.xyz + w.y * b.normalV.xyz + w.z * c.normalV.xyz;
  normal = dot(normal, normal) > 1e-30 ? normalize(normal) : front;
  float side = dot(normal, front);
  if (side < 0.0) normal = normalize(normal - 2.0 * side * front);  // as scene::surfaceAt
  vec3 toViewer = eye.w > 0.0 ? normalize(eye.xyz - position) : eye.xyz;
  vec3 reflected = 2.0 * dot(normal, toViewer) * normal - toViewer;

  vec3 base = w.x * a.color.rgb + w.y * b.color.rgb + w.z * c.color.rgb;
  if (hasTexture) base *= sampleBaseColor(uv);
  if (kind == kMirror) {
    radiance.rgb = mirror * base * sampleEnvironment(reflected);
    return;
  }
  if (hasDiffuse) radiance.rgb += (albedoOutside ? base : vec3(1.0)) * diffuseRadiance();
#if LAMBENT_GLOSSY
  radiance.rgb += base * glossyRadiance(reflected);
#endif
}
