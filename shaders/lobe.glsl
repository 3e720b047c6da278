// Glossy exit radiance towards a mirrored view, without the base colour: shade::LitMesh::glossyAt
// (sloan2002precomputed eq. 12) of what incident.glsl holds.
//
// Before this text stand: harmonics() and kCoefficients (sh.glsl); incident.glsl.

uniform vec4 lobeGain;  // shade::LobeGain

vec3 lobeRadiance(vec3 reflected, vec3 normal) {
  float y[kCoefficients];
  harmonics(reflected, y);
  vec4 sums[3];
  sums[0] = sums[1] = sums[2] = vec4(0.0);
  // Where the last group is not full, it ends in zeros.
#define LAMBENT_FACTOR(number) y[min((number) / 3, kCoefficients - 1)]
#define LAMBENT_ADD_LOBE(i)                                                                  \
  sums[(i) % 3] += vec4(LAMBENT_FACTOR(4 * i), LAMBENT_FACTOR(4 * i + 1),                    \
                        LAMBENT_FACTOR(4 * i + 2), LAMBENT_FACTOR(4 * i + 3)) *              \
                   incident[i];
  LAMBENT_EACH_GROUP(LAMBENT_ADD_LOBE)
  float mu = clamp(dot(reflected, normal), 0.0, 1.0);
  float gain = 1.0 + mu * (lobeGain.x + mu * (lobeGain.y + mu * (lobeGain.z + mu * lobeGain.w)));
  return gain * sumOfChannels(sums[0], sums[1], sums[2]);
}
