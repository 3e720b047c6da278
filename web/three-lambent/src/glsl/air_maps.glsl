// Where air_texels.glsl, which stands after this text, finds its maps; what a mesh shows through it.

uniform highp sampler2D airTable;
#if LAMBENT_SHAFTS
uniform highp sampler2D shaftMap;
#endif
