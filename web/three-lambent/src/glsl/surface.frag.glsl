// Exit radiance of a relit surface, as shaders/opengl/surface.frag.glsl: at receivers' results, linear
// between them. Surfaces seen from behind are black.
//
// Before this text stand: #define LAMBENT_KIND 0 vertices, 1 texels, 2 mirror, 3 black, 4 unlit;
// LAMBENT_DIFFUSE, LAMBENT_GLOSSY, LAMBENT_FETCH, LAMBENT_MAP, LAMBENT_ALBEDO_OUTSIDE; with glossy
// LAMBENT_LOBE, which adds y[i] times coefficient i for all of incident[], incident.glsl and sh.glsl; shading_point.glsl, base_color.glsl with a map, environment.glsl for a
// mirror.

#include <common>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>

uniform vec3 reflectance;  // of a mirror, or the factor of an unlit surface

#if LAMBENT_KIND == 0
#if LAMBENT_DIFFUSE
in vec3 diffuseRadiance;
#endif
#if LAMBENT_GLOSSY && !LAMBENT_FETCH
in vec4 incident[LAMBENT_GROUPS];
#endif
#endif
#if LAMBENT_FETCH
flat in uvec3 corners;
in vec3 barycentric;
#endif

#if LAMBENT_KIND == 1 && LAMBENT_DIFFUSE
uniform highp usampler2D diffuseLit;  // bits of floats
uniform int diffuseALine;
#endif
#if LAMBENT_KIND == 1
uniform ivec2 grid;
// The four texels around the place, and their weights.
int receiver[4];
vec4 weight;

void chooseTexels(vec2 uv) {
  vec2 at = clamp(uv * vec2(grid) - 0.5, vec2(0.0), vec2(grid - 1));
  ivec2 a = ivec2(at), b = min(a + 1, grid - 1);
  vec2 w = at - vec2(a);
  receiver = int[4](a.y * grid.x + a.x, a.y * grid.x + b.x, b.y * grid.x + a.x,
                    b.y * grid.x + b.x);
  weight = vec4((1.0 - w.y) * (1.0 - w.x), (1.0 - w.y) * w.x, w.y * (1.0 - w.x), w.y * w.x);
}
#endif

#if LAMBENT_GLOSSY && (LAMBENT_KIND == 1 || LAMBENT_FETCH)
vec4 incident[LAMBENT_GROUPS];

void addIncident(int p, float weight) {
  ivec2 first = incidentPlace(p);
  for (int g = 0; g < LAMBENT_GROUPS; ++g) incident[g] += weight * incidentGroup(first, g);
}
#endif

void main() {
#include <clipping_planes_fragment>
#include <logdepthbuf_fragment>
  ShadingPoint point = shadingPoint();
  gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
#if LAMBENT_KIND != 3
  if (gl_FrontFacing) {
    vec3 base = vertexColor;
#if LAMBENT_MAP
    base *= sampleBaseColor(point.uv);
#endif
    vec3 reflected = 2.0 * dot(point.normal, point.toViewer) * point.normal - point.toViewer;
#if LAMBENT_KIND == 4
    gl_FragColor.rgb = reflectance * base;
#elif LAMBENT_KIND == 2
    gl_FragColor.rgb = reflectance * base * environmentRadiance(worldFromAsset * reflected);
#else
    vec3 diffuse = vec3(0.0);
#if LAMBENT_KIND == 1
    chooseTexels(point.uv);
#endif
#if LAMBENT_DIFFUSE
#if LAMBENT_KIND == 0
    diffuse = diffuseRadiance;
#else
    for (int k = 0; k < 4; ++k) {
      int line = receiver[k] / diffuseALine;
      ivec2 place = ivec2(receiver[k] - line * diffuseALine, line);
      diffuse += weight[k] * uintBitsToFloat(texelFetch(diffuseLit, place, 0).rgb);
    }
#endif
#if LAMBENT_ALBEDO_OUTSIDE
    diffuse *= base;
#endif
#endif
    gl_FragColor.rgb = diffuse;
#if LAMBENT_GLOSSY
    float y[kCoefficients];
    harmonics(reflected, y);
    vec3 lobe = vec3(0.0);
#if LAMBENT_KIND == 1 || LAMBENT_FETCH
    for (int g = 0; g < LAMBENT_GROUPS; ++g) incident[g] = vec4(0.0);
#endif
#if LAMBENT_KIND == 1
    for (int k = 0; k < 4; ++k)
      if (weight[k] != 0.0) addIncident(receiver[k], weight[k]);
#elif LAMBENT_FETCH
    for (int k = 0; k < 3; ++k) addIncident(int(corners[k]), barycentric[k]);
#endif
    LAMBENT_LOBE
    gl_FragColor.rgb += base * lobe;
#endif
#endif
  }
#endif
#include <tonemapping_fragment>
#include <colorspace_fragment>
}
