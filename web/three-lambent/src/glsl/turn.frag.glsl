// Light turned into the tangent frames of vertices, where nothing hides it: what is left of M L of
// sloan2003biscale without shadows. A band of 2l + 1 coefficients is known from its values in as
// many directions: those are looked up where the frame carries them, and what turns values into
// coefficients is the same for all frames (src/gpu/turn-samples.ts).
//
// Before this text stand: #define LAMBENT_ROWS, of the result, and LAMBENT_TEXELS that a receiver
// takes; sh.glsl with LAMBENT_BANDS, of the light; row_place.glsl; tangent_frame.glsl. After it:
// pass_main.glsl.

uniform sampler2DArray normals;
uniform sampler2DArray tangents;
uniform ivec3 frameRows;
uniform sampler2D samples;  // (k, i): direction k of the band, and its value's share in coefficient i
uniform vec3 light[kCoefficients];
uniform vec4 factors[(LAMBENT_ROWS + 3) / 4];

mat3 frame;

void begin(int receiver) {
  ivec3 place = rowPlace(frameRows, receiver);
  frame = worldFromPatch(normalize(texelFetch(normals, place, 0).xyz),
                         texelFetch(tangents, place, 0).xyz);
}

vec3 result(int i) {
  if (i >= kCoefficients) return vec3(0.0);
  int l = 0;
  while ((l + 1) * (l + 1) <= i) ++l;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 2 * l + 1; ++k) {
    float y[kCoefficients];
    vec4 from = texelFetch(samples, ivec2(k, i), 0);
    harmonics(frame * from.xyz, y);
    vec3 value = vec3(0.0);
    for (int m = l * l; m < (l + 1) * (l + 1); ++m) value += light[m] * y[m];
    sum += from.w * value;
  }
  return sum * factors[i >> 2][i & 3];
}
