// Where base_color.glsl finds a texture: its sRGB code values, and what they stand for. It stands
// before this text.

layout(std430, binding = 4) readonly buffer SrgbTable { float linearFromSrgb[]; };  // 256
layout(binding = 0) uniform usampler2D baseColorTexture;
uniform bool hasTexture;

bool hasBaseColorMap() { return hasTexture; }

ivec2 baseColorSize() { return textureSize(baseColorTexture, 0); }

float baseColorAlpha(ivec2 texel) {
  return float(texelFetch(baseColorTexture, texel, 0).a) / 255.0;
}

vec3 baseColorTexel(ivec2 texel) {
  uvec4 t = texelFetch(baseColorTexture, texel, 0);
  return vec3(linearFromSrgb[t.r], linearFromSrgb[t.g], linearFromSrgb[t.b]);
}
