// Exit radiance of a surface with meso-structure: B(q, v) · (M L), sloan2003biscale eq. 4, as
// shaders/opengl/patch.frag.glsl and shade::LitPatch, times the base colour.
//
// Before this text stand: #define LAMBENT_FETCH, LAMBENT_FILTER, LAMBENT_RELIEF, LAMBENT_ID_MAP,
// LAMBENT_ALPHA, each 0 or 1, and what these want: incident.glsl, rtt_response.glsl, view_square.glsl, rtt_footprint.glsl,
// rtt_look_up.glsl, tangent_frame.glsl, shading_normal.glsl, patch_place.glsl; the textures of the
// first two; base_color.glsl, with LAMBENT_ALPHA coverage.glsl, with a map base_color_map.glsl; shading_point.glsl; LAMBENT_AIR, with what air_texels.glsl says, or 0;
// LAMBENT_CAPTURED 1 with captured.glsl, or 0.

#include <common>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>

in vec3 tangent_;
#if LAMBENT_ALPHA
in float vertexAlpha;
#endif
#if LAMBENT_FETCH
flat in uvec3 corners;
in vec3 barycentric;
#endif

uniform bool viewDependent;
uniform vec2 pixelWidth;  // of a sub-sample, in metres: for each metre of distance, and anyway
#if LAMBENT_ID_MAP
uniform highp usampler2D idMap;
uniform vec2 periodsPerMetre;
uniform vec4 seams;  // radiance of the lines where pieces of the patch meet, 1; or 0: none

ivec2 idMapSize() { return textureSize(idMap, 0); }
uvec2 idMapTexel(ivec2 texel) { return texelFetch(idMap, texel, 0).rg; }
#else
uniform vec2 tiles;  // q = tiles (u, −v)
#endif

void main() {
#include <clipping_planes_fragment>
#include <logdepthbuf_fragment>
  ShadingPoint point = shadingPoint();
#if LAMBENT_FILTER && LAMBENT_ID_MAP
  // What a step of 1 in u, or v, is along the triangle: both are linear over it.
  vec3 px = dFdx(point.position), py = dFdy(point.position);
  vec2 uvx = dFdx(point.uv), uvy = dFdy(point.uv);
  float area = uvx.x * uvy.y - uvy.x * uvx.y;
  vec3 alongU = area != 0.0 ? (uvy.y * px - uvx.y * py) / area : vec3(0.0);
  vec3 alongV = area != 0.0 ? (uvx.x * py - uvy.x * px) / area : vec3(0.0);
#endif
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
#if LAMBENT_ALPHA
  if (!isThere(vertexAlpha, point.uv, gl_FragCoord.xyz)) discard;
#endif
  gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
  if (gl_FrontFacing) {
#if LAMBENT_FETCH
    interpolateIncident(ivec3(corners), barycentric);
#endif
    mat3 frame = worldFromPatch(point.normal, tangent_);
    vec3 toViewer = point.toViewer * frame;
    chooseViews(viewDependent ? toViewer : vec3(0.0, 0.0, 1.0));
    vec3 reflected = baseColor(vertexColor, point.uv);
#if LAMBENT_FILTER
    float width = pixelWidth.x * point.distance + pixelWidth.y;
#if LAMBENT_ID_MAP
    vec3 gradientX = frame[0] * periodsPerMetre.x, gradientY = frame[1] * periodsPerMetre.y;
    vec2 texels = vec2(idMapSize());
    vec2 qx = vec2(dot(gradientX, alongU), dot(gradientY, alongU)) / texels.x;
    vec2 qy = vec2(dot(gradientX, alongV), dot(gradientY, alongV)) / texels.y;
    if (seams.w > 0.0 && nearSeam(point.uv, qx, qy, uvx, uvy, kSeamReach)) {
      gl_FragColor.rgb = seams.rgb;
      reflected = vec3(1.0);  // a mark is not tinted
    } else {
      Places places = mappedPlaces(point.uv, qx, qy);
      for (int i = 0; i < places.count; ++i)
        gl_FragColor.rgb += places.share[i] * averaged(places.q[i], frame, toViewer, width,
                                                       gradientX, gradientY);
    }
#else
    gl_FragColor.rgb =
        averaged(tiledPlace(tiles, point.uv), frame, toViewer, width, gradientX, gradientY);
#endif
#elif LAMBENT_ID_MAP
    gl_FragColor.rgb = nearest(mappedPlace(point.uv));
#else
    gl_FragColor.rgb = nearest(tiledPlace(tiles, point.uv));
#endif
    gl_FragColor.rgb *= reflected;
  }
#if LAMBENT_ALPHA
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
