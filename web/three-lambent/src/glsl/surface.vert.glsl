// A relit surface. Vertices fetch what the transfer pass made for them by their number.
//
// Before this text stand: #define LAMBENT_VERTICES, LAMBENT_DIFFUSE, LAMBENT_GLOSSY, LAMBENT_PATCH,
// LAMBENT_UV, LAMBENT_TEXEL_UV (texels lie by a second set of texture coordinates), LAMBENT_COLOR,
// LAMBENT_SUN_SHARE, LAMBENT_ALPHA (it may be there in parts alone), LAMBENT_FETCH, each 0 or 1
// (FETCH: the fragment shader fetches the light at the triangle's corners, and vertices know their
// triangle); where they interpolate it incident_texture.glsl.

#include <common>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>

#if LAMBENT_PATCH
attribute vec3 lambentTangent;
out vec3 tangent_;
#endif
#if LAMBENT_TEXEL_UV && !defined(USE_UV1)
attribute vec2 uv1;
#endif
#if LAMBENT_KIND == 1
out vec2 texelUv;
#endif
#if LAMBENT_FETCH
attribute uvec3 lambentCorners;
flat out uvec3 corners;
out vec3 barycentric;
#endif

// As deep as layers that lie on it.
invariant gl_Position;

out vec4 positionU;
out vec4 normalV;
out vec3 vertexColor;
#if LAMBENT_ALPHA
out float vertexAlpha;
#endif
#if LAMBENT_VERTICES && LAMBENT_DIFFUSE
uniform highp usampler2D diffuseLit;  // bits of floats
uniform int diffuseALine;
out vec3 diffuseRadiance;
#if LAMBENT_SUN_SHARE
uniform highp usampler2D sunLit;  // beside it, to be taken out
#endif
#endif
#if LAMBENT_VERTICES && (LAMBENT_GLOSSY || LAMBENT_PATCH) && !LAMBENT_FETCH
out vec4 incident[LAMBENT_GROUPS];
#endif

void main() {
#if LAMBENT_UV
  vec2 place = uv;
#else
  vec2 place = vec2(0.0);
#endif
  positionU = vec4(position, place.x);
  normalV = vec4(normal, place.y);
#if LAMBENT_TEXEL_UV
  texelUv = uv1;
#elif LAMBENT_KIND == 1
  texelUv = place;
#endif
#if LAMBENT_COLOR
  vertexColor = color.rgb;
#else
  vertexColor = vec3(1.0);
#endif
#if LAMBENT_ALPHA
#ifdef USE_COLOR_ALPHA
  vertexAlpha = color.a;
#else
  vertexAlpha = 1.0;
#endif
#endif
#if LAMBENT_PATCH
  tangent_ = lambentTangent;
#endif
  int receiver = gl_VertexID;
#if LAMBENT_FETCH
  int corner = gl_VertexID % 3;
  corners = lambentCorners;
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
  receiver = int(lambentCorners[corner]);
#endif
#if LAMBENT_VERTICES && LAMBENT_DIFFUSE
  int line = receiver / diffuseALine;
  ivec2 diffusePlace = ivec2(receiver - line * diffuseALine, line);
  diffuseRadiance = uintBitsToFloat(texelFetch(diffuseLit, diffusePlace, 0).rgb);
#if LAMBENT_SUN_SHARE
  diffuseRadiance -= uintBitsToFloat(texelFetch(sunLit, diffusePlace, 0).rgb);
#endif
#endif
#if LAMBENT_VERTICES && (LAMBENT_GLOSSY || LAMBENT_PATCH) && !LAMBENT_FETCH
  ivec2 first = lightPlace(receiver);
  for (int g = 0; g < LAMBENT_GROUPS; ++g) incident[g] = lightGroup(first, g);
#endif
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * mvPosition;
#include <logdepthbuf_vertex>
#include <clipping_planes_vertex>
#include <fog_vertex>
}
