// The mean of linear pictures, exposed, through the tone curve, sRGB-coded. Before it: toneGlsl.

uniform sampler2D picture;
uniform float factor;  // 2^EV, over the number of pictures that were added up
uniform bool isFilmic;

out vec4 coded;

void main() {
  vec4 sum = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  vec3 exposed = clamp(sum.rgb * factor, 0.0, 65504.0);
  vec3 shown = isFilmic ? filmic(exposed) : min(exposed, 1.0);
  coded = vec4(srgbEncode(shown), 1.0);
}
