// The mean of the frames that were added up, over its background, exposed and coded for a screen:
// shade::finishPicture, tone::toneMap and sRGB coding.
//
// Before this text stands: tone.glsl.

layout(binding = 0) uniform sampler2D sum;     // radiance and coverage
layout(binding = 1) uniform sampler2D behind;  // radiance, and how many frames it is of
uniform float share;                           // 1 / frames
uniform float exposure;                        // a factor
uniform bool filmicCurve;
uniform bool cutLast;  // the sum holds what shadows in the air take from the background

layout(location = 0) out vec4 color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 mean = texelFetch(sum, at, 0) * share;
  vec4 back = texelFetch(behind, at, 0);
  vec3 radiance = cutLast ? mean.rgb : max(mean.rgb, 0.0);
  if (back.a > 0.0) radiance += (1.0 - mean.a) / back.a * back.rgb;
  vec3 exposed = exposure * max(radiance, 0.0);
  color = vec4(srgbEncode(filmicCurve ? filmic(exposed) : cutToOne(exposed)), 1.0);
}
