// Where base_color.glsl, which stands before this text, finds a texture.

uniform sampler2D baseColorMap;  // sRGB, which the hardware decodes

bool hasBaseColorMap() { return true; }

ivec2 baseColorSize() { return textureSize(baseColorMap, 0); }

float baseColorAlpha(ivec2 texel) { return texelFetch(baseColorMap, texel, 0).a; }

vec3 baseColorTexel(ivec2 texel) { return texelFetch(baseColorMap, texel, 0).rgb; }
