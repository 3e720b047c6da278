// Exit radiance of a relit surface, as shaders/opengl/surface.frag.glsl: at receivers' results, linear
// between them. Surfaces seen from behind are black.
//
// Before this text stand: #define LAMBENT_KIND 0 vertices, 1 texels, 2 mirror, 3 black, 4 unlit;
// LAMBENT_DIFFUSE, LAMBENT_GLOSSY, LAMBENT_FETCH, LAMBENT_ALBEDO_OUTSIDE; with glossy sh.glsl,
// incident.glsl, incident_texture.glsl, lobe.glsl; shading_normal.glsl, shading_point.glsl;
// base_color.glsl, with LAMBENT_ALPHA coverage.glsl, with a map base_color_map.glsl; for texels
// texel_receivers.glsl; LAMBENT_SUN (0: no sharp Sun, else sun_light.glsl with what it wants),
// LAMBENT_SUN_SHARE; LAMBENT_AIR, with what air_texels.glsl and air_behind.glsl say, or 0; for a
// mirror environment.glsl, environment_map.glsl; LAMBENT_CAPTURED 1 with captured.glsl, and for a
// mirror local_capture.glsl, or 0.

#include <common>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>

uniform vec3 reflectance;  // of a mirror, or the factor of an unlit surface

#if LAMBENT_KIND == 2
uniform mat4 modelMatrix;

// Where a direction of the object points to in the world; in a capture, which is drawn in the
// asset's own frame, as the asset stands.
vec3 inWorld(vec3 direction) {
#if LAMBENT_CAPTURED
  if (capturing) return worldFromAsset * direction;
#endif
  return mat3(modelMatrix) * direction;
}
#endif

#if LAMBENT_KIND == 0 && LAMBENT_DIFFUSE
in vec3 diffuseRadiance;
#endif
#if LAMBENT_FETCH
flat in uvec3 corners;
in vec3 barycentric;
#endif

#if LAMBENT_KIND == 1
in vec2 texelUv;
uniform ivec2 grid;
#if LAMBENT_DIFFUSE
uniform highp usampler2D diffuseLit;  // bits of floats
uniform int diffuseALine;
#if LAMBENT_SUN_SHARE
uniform highp usampler2D sunLit;  // beside it, to be taken out
#endif

vec3 diffuseAt(Texels texels) {
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    int line = texels.receiver[k] / diffuseALine;
    ivec2 place = ivec2(texels.receiver[k] - line * diffuseALine, line);
    vec3 texel = uintBitsToFloat(texelFetch(diffuseLit, place, 0).rgb);
#if LAMBENT_SUN_SHARE
    texel -= uintBitsToFloat(texelFetch(sunLit, place, 0).rgb);
#endif
    sum += texels.weight[k] * texel;
  }
  return sum;
}
#endif
#endif

#if LAMBENT_ALPHA
in float vertexAlpha;
#endif

void main() {
#include <clipping_planes_fragment>
#include <logdepthbuf_fragment>
  ShadingPoint point = shadingPoint();
#if LAMBENT_ALPHA
  if (!isThere(vertexAlpha, point.uv, gl_FragCoord.xyz)) discard;
#endif
  gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
#if LAMBENT_KIND != 3
  if (gl_FrontFacing) {
    vec3 base = baseColor(vertexColor, point.uv);
    vec3 reflected = reflectAbout(point.toViewer, point.normal);
#if LAMBENT_KIND == 4
    gl_FragColor.rgb = reflectance * base;
#elif LAMBENT_KIND == 2
    vec4 met = vec4(0.0);
#if LAMBENT_CAPTURED
    met = capturedAlong(captureScale.y * point.position, reflected);
    met.rgb /= captureScale.x;
#endif
    if (met.a < 1.0) {
      vec3 shown = environmentRadiance(normalize(inWorld(reflected)));
#if LAMBENT_AIR
      if (eye.w > 0.0) shown = seenBehindAir(point.position, reflected, shown);
#endif
      met.rgb += (1.0 - met.a) * shown;
    }
    gl_FragColor.rgb = reflectance * base * met.rgb;
#else
    vec3 diffuse = vec3(0.0);
#if LAMBENT_KIND == 1
    Texels texels = texelsAround(texelUv, grid);
#endif
#if LAMBENT_DIFFUSE
#if LAMBENT_KIND == 0
    diffuse = diffuseRadiance;
#else
    diffuse = diffuseAt(texels);
#endif
#if LAMBENT_ALBEDO_OUTSIDE
    diffuse *= base;
#endif
#endif
    gl_FragColor.rgb = diffuse;
#if LAMBENT_SUN
    gl_FragColor.rgb += base * sunRadiance(point.position, point.normal, point.front);
#endif
#if LAMBENT_GLOSSY
#if LAMBENT_KIND == 1
    interpolateIncident(texels.receiver, texels.weight);
#elif LAMBENT_FETCH
    interpolateIncident(ivec3(corners), barycentric);
#endif
    gl_FragColor.rgb += base * lobeRadiance(reflected, point.normal);
#endif
#endif
  }
#endif
#if LAMBENT_ALPHA && LAMBENT_KIND != 4
  gl_FragColor.rgb /= max(kept, 1e-4);
#endif
#if LAMBENT_AIR
  if (eye.w > 0.0) gl_FragColor.rgb = seenThroughAir(point.position - eye.xyz, gl_FragColor.rgb);
#endif
#if LAMBENT_CAPTURED
  if (capturing) gl_FragColor = keptByCapture(gl_FragColor.rgb, point.distance);
#endif
#include <tonemapping_fragment>
#include <colorspace_fragment>
#include <fog_fragment>
}
