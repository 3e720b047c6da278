// Where air_texels.glsl, which stands after this text, finds its maps.

layout(binding = 5) uniform sampler2D airTable;
#if LAMBENT_SHAFTS
layout(binding = 4) uniform sampler2D shaftMap;
#endif
