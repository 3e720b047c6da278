// The mean of linear pictures, exposed, through the tone curve, sRGB-coded.
//
// Before this text stands: tone.glsl.

uniform sampler2D picture;
uniform float factor;  // 2^EV, over the number of pictures that were added up
uniform bool isFilmic;

out vec4 coded;

void main() {
  vec4 sum = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  vec3 exposed = sum.rgb * factor;
  coded = vec4(srgbEncode(isFilmic ? filmic(exposed) : cutToOne(exposed)), 1.0);
}
