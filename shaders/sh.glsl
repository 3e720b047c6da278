// Real, orthonormal spherical harmonics with positive signs and the polar axis +z, index l(l+1)+m:
// the conventions of lambent/sh/basis.h, checked against it by a table test.
//
// Before this text stands: #define LAMBENT_BANDS n, 1 … 10.
//
// y_lm = √2 P̄_l^|m|(z) · {cos, sin}(|m| φ) sin^|m| θ, with the normalised Legendre functions by the
// recurrence in l, and the trigonometric factor as a polynomial in x and y by the recurrence in m.

const int kCoefficients = LAMBENT_BANDS * LAMBENT_BANDS;

void harmonics(vec3 d, out float y[kCoefficients]) {
  float c = 1.0, s = 0.0;             // sin^m θ · cos mφ, sin^m θ · sin mφ
  float sectoral = 0.28209479177388;  // P̄_m^m without its sin^m θ
  for (int m = 0; m < LAMBENT_BANDS; ++m) {
    float before = 0.0, legendre = sectoral;
    for (int l = m; l < LAMBENT_BANDS; ++l) {
      if (m == 0) {
        y[l * (l + 1)] = legendre;
      } else {
        y[l * (l + 1) + m] = 1.41421356237310 * legendre * c;
        y[l * (l + 1) - m] = 1.41421356237310 * legendre * s;
      }
      float next = float((l + 1) * (l + 1) - m * m);
      float a = sqrt((4.0 * float((l + 1) * (l + 1)) - 1.0) / next);
      float b = sqrt(float(l * l - m * m) / (4.0 * float(l * l) - 1.0 + (l == 0 ? 2.0 : 0.0)));
      float after = a * (d.z * legendre - b * before);
      before = legendre;
      legendre = after;
    }
    float turned = d.x * c - d.y * s;
    s = d.x * s + d.y * c;
    c = turned;
    sectoral *= sqrt(float(2 * m + 3) / float(2 * m + 2));
  }
}
