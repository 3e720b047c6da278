// The light that arrives at a place of a surface (or what is left of it after a glossy lobe), from
// that of the receivers around. The n² RGB numbers of a receiver lie coefficient after coefficient,
// each R, G, B, in groups of four: RGBR GBRG BRGB …
//
// Before this text stand: #define LAMBENT_GROUPS; LAMBENT_EACH_GROUP(DO), which is DO(0) DO(1) … for
// all of them: written out, as loops over arrays took three times as long on a CPU's OpenGL;
// LAMBENT_INTERPOLATED 1 where the rasteriser interpolates between a triangle's corners, or 0; if 0,
// LAMBENT_LIGHT_PLACE, the type of a place where receivers' light lies. After it, if 0: the functions
// that read there.

#if LAMBENT_INTERPOLATED
in vec4 incident[LAMBENT_GROUPS];
#else
vec4 incident[LAMBENT_GROUPS];

LAMBENT_LIGHT_PLACE lightPlace(int receiver);
vec4 lightGroup(LAMBENT_LIGHT_PLACE first, int group);

void clearIncident() {
#define LAMBENT_CLEAR(i) incident[i] = vec4(0.0);
  LAMBENT_EACH_GROUP(LAMBENT_CLEAR)
}

// Adds a share of one receiver's light.
void addIncident(int receiver, float weight) {
  LAMBENT_LIGHT_PLACE first = lightPlace(receiver);
#define LAMBENT_ADD_GROUP(i) incident[i] += weight * lightGroup(first, i);
  LAMBENT_EACH_GROUP(LAMBENT_ADD_GROUP)
}

// Linear between the corners of a triangle.
void interpolateIncident(ivec3 corners, vec3 weights) {
  clearIncident();
  addIncident(corners.x, weights.x);
  addIncident(corners.y, weights.y);
  addIncident(corners.z, weights.z);
}

// Bilinear between four texels (texel_receivers.glsl).
void interpolateIncident(ivec4 texels, vec4 weights) {
  clearIncident();
  for (int k = 0; k < 4; ++k)
    if (weights[k] != 0.0) addIncident(texels[k], weights[k]);
}
#endif

// Every third group holds each channel in the same places. Of three sums of every third: the sums of
// the channels.
vec3 sumOfChannels(vec4 sum0, vec4 sum1, vec4 sum2) {
  return vec3(sum0.x + sum0.w + sum1.z + sum2.y, sum0.y + sum1.x + sum1.w + sum2.z,
              sum0.z + sum1.y + sum2.x + sum2.w);
}
