// What a body changes in the light that arrives at a sample: its own radiance instead of that of
// the distant environment behind it. Where nothing is drawn the difference is zero, so that the
// environment's coefficients, which are known exactly, are not sampled at all.
//
// Before this text stands shaders/sh.glsl with the environment's bands in LAMBENT_BANDS; without
// one, LAMBENT_BANDS is 0.

#if LAMBENT_BANDS > 0
layout(std430, binding = 1) readonly buffer Environment { float environment[]; };  // [coefficient][3]
#endif

uniform vec4 radianceReach;  // the body's radiance, and how far away bodies can be at most, metres

in vec3 fromPoint;
in float depth;

layout(location = 0) out vec4 difference;

void main() {
  vec3 behind = vec3(0.0);
#if LAMBENT_BANDS > 0
  float y[kCoefficients];
  harmonics(normalize(fromPoint), y);
  for (int i = 0; i < kCoefficients; ++i)
    behind += y[i] * vec3(environment[3 * i], environment[3 * i + 1], environment[3 * i + 2]);
#endif
  gl_FragDepth = depth / radianceReach.w;
  difference = vec4((gl_FrontFacing ? radianceReach.rgb : vec3(0.0)) - behind, 1.0);
}
