// Exit radiance of a relit surface, as shaders/surface.frag.glsl: at receivers' results, linear
// between them. Surfaces seen from behind are black.
//
// Before this text stand: #define LAMBENT_KIND 0 vertices, 1 texels, 2 mirror, 3 black, 4 unlit;
// LAMBENT_DIFFUSE, LAMBENT_GLOSSY, LAMBENT_FETCH, LAMBENT_MAP, LAMBENT_ALBEDO_OUTSIDE; with glossy
// LAMBENT_COEFFICIENTS, LAMBENT_GROUPS, LAMBENT_LOBE, which adds y[i] times coefficient i for all of
// incident[], and sh.glsl; shading_point.glsl, base_color.glsl with a map, environment.glsl for a
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
uniform sampler2D diffuseLit;
uniform int diffuseALine;
#endif
#if LAMBENT_GLOSSY && (LAMBENT_KIND == 1 || LAMBENT_FETCH)
uniform sampler2D incidentLit;
uniform int incidentALine;
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
vec3 lobeOf(int p, float y[kCoefficients]) {
  int line = p / incidentALine;
  ivec2 first = ivec2((p - line * incidentALine) * LAMBENT_COEFFICIENTS, line);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < LAMBENT_COEFFICIENTS; ++i)
    sum += y[i] * texelFetch(incidentLit, first + ivec2(i, 0), 0).rgb;
  return sum;
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
      diffuse += weight[k] *
                 texelFetch(diffuseLit, ivec2(receiver[k] - line * diffuseALine, line), 0).rgb;
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
#if LAMBENT_KIND == 1
    for (int k = 0; k < 4; ++k)
      if (weight[k] != 0.0) lobe += weight[k] * lobeOf(receiver[k], y);
#elif LAMBENT_FETCH
    for (int k = 0; k < 3; ++k) lobe += barycentric[k] * lobeOf(int(corners[k]), y);
#else
    LAMBENT_LOBE
#endif
    gl_FragColor.rgb += base * lobe;
#endif
#endif
  }
#endif
#include <tonemapping_fragment>
#include <colorspace_fragment>
}
