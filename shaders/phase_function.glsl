// Phase functions, sr⁻¹, for the cosine between the directions of travel before and after: those of
// media::evaluate.

// Of aerosols: x says which (the place in media::PhaseFunction), yzw its parameters.
uniform vec4 aerosolPhase;

const float kInverseSphere = 0.0795774715459477;  // 1 / 4π

float rayleighPhase(float cosine) { return 0.75 * kInverseSphere * (1.0 + cosine * cosine); }

float henyeyGreenstein(float g, float cosine) {
  float base = 1.0 + g * g - 2.0 * g * cosine;
  return kInverseSphere * (1.0 - g * g) / (base * sqrt(base));
}

float phaseOfAerosols(float cosine) {
  float a = aerosolPhase.y, b = aerosolPhase.z;
  if (aerosolPhase.x == 1.0) return rayleighPhase(cosine);
  if (aerosolPhase.x == 2.0) return henyeyGreenstein(a, cosine);
  if (aerosolPhase.x == 3.0) {
    return 1.5 * (1.0 + cosine * cosine) / (2.0 + a * a) * henyeyGreenstein(a, cosine);
  }
  if (aerosolPhase.x == 4.0) {
    return mix(henyeyGreenstein(b, cosine), henyeyGreenstein(aerosolPhase.w, cosine), a);
  }
  if (aerosolPhase.x == 5.0) {
    float base = 1.0 - a * cosine;
    return kInverseSphere * (1.0 - a * a) / (base * base);
  }
  return kInverseSphere;
}
