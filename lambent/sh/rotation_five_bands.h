// Rotation of one vector of five bands, the usual number, four coefficients at a time; the method
// is that of rotation_kernel.cpp, the one file that includes this, inside its own namespace.
//
// A turn about z works on pairs (c_m, s_m) = (f_lm, f_l−m), so these stand lane by lane in two
// vectors. The coefficients z = f_l0, which it leaves alone, take the free lanes, turned by nothing
// (cosine 1, sine 0):
//   cosine4 = (c1 c2 c3 c4)   sine4 = (s1 s2 s3 s4)   zonal4 = (z z z z)       of band 4
//   cosine3 = (c1 c2 c3 z)    sine3 = (s1 s2 s3 ·)                             of band 3
//   cosine2 = (c1 c2 z c1′)   sine2 = (s1 s2 z′ s1′)       of band 2, and of band 1 where primed
using V4 = float __attribute__((vector_size(16)));

inline V4 load(const float* p) {
  V4 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

inline void store(float* p, const V4& v) {
  __builtin_memcpy(p, &v, sizeof v);
}

struct Function {
  V4 cosine4, sine4, zonal4, cosine3, sine3, cosine2, sine2;
};

/// One turn about z, as the lanes of each band want it.
struct LaneTurn {
  V4 cosine4, sine4, cosine3, sine3, cosine2, sine2;

  /// cosine: cos mφ for m = 1 … 4; sine likewise.
  LaneTurn(const V4& cosine, const V4& sine) : cosine4(cosine), sine4(sine) {
    const V4 one = {1, 1, 1, 1}, zero = {};
    cosine3 = __builtin_shufflevector(cosine, one, 0, 1, 2, 4);
    sine3 = __builtin_shufflevector(sine, zero, 0, 1, 2, 4);
    cosine2 = __builtin_shufflevector(cosine, one, 0, 1, 4, 0);
    sine2 = __builtin_shufflevector(sine, zero, 0, 1, 4, 0);
  }
};

inline void turn(const V4& c, const V4& s, V4& cosine, V4& sine) {
  const V4 turned = c * cosine - s * sine;
  sine = s * cosine + c * sine;
  cosine = turned;
}

inline void turnAboutZ(const LaneTurn& t, Function& f) {
  turn(t.cosine4, t.sine4, f.cosine4, f.sine4);
  turn(t.cosine3, t.sine3, f.cosine3, f.sine3);
  turn(t.cosine2, t.sine2, f.cosine2, f.sine2);
}

/// The entry that takes column n to row m, as a constant.
template <int L, int M, int N>
inline constexpr float kEntry = kSwap.band[L][(M + L) * (2 * L + 1) + N + L];

inline void swapAxes(Function& f) {
  {  // Band 4 swaps (1 3) with (−2 −4); (0 2 4) and (−1 −3) stay among themselves.
    const V4 low = __builtin_shufflevector(f.sine4, f.cosine4, 0, 4, 1, 5);
    const V4 high = __builtin_shufflevector(f.sine4, f.cosine4, 2, 6, 3, 7);
    const V4 m1 = __builtin_shufflevector(low, low, 0, 1, 0, 1);    // s1 c1 s1 c1
    const V4 m2 = __builtin_shufflevector(low, low, 2, 3, 2, 3);    // s2 c2 s2 c2
    const V4 m3 = __builtin_shufflevector(high, high, 0, 1, 0, 1);  // s3 c3 s3 c3
    const V4 m4 = __builtin_shufflevector(high, high, 2, 3, 2, 3);  // s4 c4 s4 c4
    f.cosine4 = m2 * V4{kEntry<4, 1, -2>, kEntry<4, 2, 2>, kEntry<4, 3, -2>, kEntry<4, 4, 2>} +
                m4 * V4{kEntry<4, 1, -4>, kEntry<4, 2, 4>, kEntry<4, 3, -4>, kEntry<4, 4, 4>} +
                f.zonal4 * V4{0, kEntry<4, 2, 0>, 0, kEntry<4, 4, 0>};
    f.sine4 = m1 * V4{kEntry<4, -1, -1>, kEntry<4, -2, 1>, kEntry<4, -3, -1>, kEntry<4, -4, 1>} +
              m3 * V4{kEntry<4, -1, -3>, kEntry<4, -2, 3>, kEntry<4, -3, -3>, kEntry<4, -4, 3>};
    const V4 zonal = m2 * kEntry<4, 0, 2> + m4 * kEntry<4, 0, 4> + f.zonal4 * kEntry<4, 0, 0>;
    f.zonal4 = __builtin_shufflevector(zonal, zonal, 1, 1, 1, 1);
  }
  {  // Band 3 swaps (0 2) with (−1 −3); (1 3) and −2 stay.
    const V4 low = __builtin_shufflevector(f.cosine3, f.sine3, 0, 4, 1, 5);
    const V4 high = __builtin_shufflevector(f.cosine3, f.sine3, 2, 6, 3, 7);
    const V4 m1 = __builtin_shufflevector(low, low, 0, 1, 0, 1);    // c1 s1 c1 s1
    const V4 m2 = __builtin_shufflevector(low, low, 2, 3, 2, 3);    // c2 s2 c2 s2
    const V4 m3 = __builtin_shufflevector(high, high, 0, 1, 0, 1);  // c3 s3 c3 s3
    const V4 m0 = __builtin_shufflevector(high, high, 2, 2, 2, 2);  // z
    f.cosine3 = m1 * V4{kEntry<3, 1, 1>, kEntry<3, 2, -1>, kEntry<3, 3, 1>, kEntry<3, 0, -1>} +
                m3 * V4{kEntry<3, 1, 3>, kEntry<3, 2, -3>, kEntry<3, 3, 3>, kEntry<3, 0, -3>};
    f.sine3 = m2 * V4{kEntry<3, -1, 2>, kEntry<3, -2, -2>, kEntry<3, -3, 2>, 0} +
              m0 * V4{kEntry<3, -1, 0>, 0, kEntry<3, -3, 0>, 0};
  }
  {  // Band 2 swaps 1 with −2, and band 1 swaps 0 with −1; (0 2) and −1 of band 2, 1 of band 1
     // stay.
    const V4 mixed = __builtin_shufflevector(f.cosine2, f.sine2, 5, 2, 1, 3);
    const V4 cosine = f.cosine2 * V4{0, kEntry<2, 2, 2>, kEntry<2, 0, 0>, 1} +
                      mixed * V4{1, kEntry<2, 2, 0>, kEntry<2, 0, 2>, 0};
    f.sine2 = __builtin_shufflevector(f.cosine2, f.sine2, 4, 0, 7, 6);
    f.cosine2 = cosine;
  }
}

template <>
void rotateFixed<5>(const float* q, const float* in, float* out) {
  const ZyzTurns turns = zyzTurns(q);
  const float c2Gamma = turns.cosine2Gamma, s2Gamma = turns.sine2Gamma;
  const V4 low = {turns.cosine[0], turns.sine[0], c2Gamma, s2Gamma};
  const V4 high = low * c2Gamma + __builtin_shufflevector(low, low, 1, 0, 3, 2) *
                                      V4{-s2Gamma, s2Gamma, -s2Gamma, s2Gamma};
  const LaneTurn gamma(__builtin_shufflevector(low, high, 0, 2, 4, 6),
                       __builtin_shufflevector(low, high, 1, 3, 5, 7));
  // The multiples of the other two at once; a Newton step puts them onto the circle first.
  V4 c = {turns.cosine[1], turns.cosine[2], 0, 0};
  V4 s = {turns.sine[1], turns.sine[2], 0, 0};
  const V4 scale = 1.5f - 0.5f * (c * c + s * s);
  c *= scale;
  s *= scale;
  const V4 c2 = c * c - s * s, s2 = 2 * (c * s);
  const V4 c3 = c * c2 - s * s2, s3 = s * c2 + c * s2;
  const V4 c4 = c2 * c2 - s2 * s2, s4 = 2 * (c2 * s2);
  const V4 c12 = __builtin_shufflevector(c, c2, 0, 4, 1, 5);
  const V4 c34 = __builtin_shufflevector(c3, c4, 0, 4, 1, 5);
  const V4 s12 = __builtin_shufflevector(s, s2, 0, 4, 1, 5);
  const V4 s34 = __builtin_shufflevector(s3, s4, 0, 4, 1, 5);
  const LaneTurn beta(__builtin_shufflevector(c12, c34, 0, 1, 4, 5),
                      __builtin_shufflevector(s12, s34, 0, 1, 4, 5));
  const LaneTurn alpha(__builtin_shufflevector(c12, c34, 2, 3, 6, 7),
                       __builtin_shufflevector(s12, s34, 2, 3, 6, 7));

  const V4 at1 = load(in + 1), at5 = load(in + 5), at9 = load(in + 9);
  const V4 at12 = load(in + 12), at16 = load(in + 16);
  Function f;
  f.cosine4 = load(in + 21);
  f.sine4 = __builtin_shufflevector(at16, at16, 3, 2, 1, 0);
  f.zonal4 = V4{in[20], in[20], in[20], in[20]};
  f.cosine3 = __builtin_shufflevector(at12, at12, 1, 2, 3, 0);
  f.sine3 = __builtin_shufflevector(at9, at9, 2, 1, 0, 3);
  f.cosine2 = __builtin_shufflevector(at5, at1, 2, 3, 1, 6);
  f.sine2 = __builtin_shufflevector(at5, at1, 0, 7, 5, 4);
  const float mean = in[0];

  turnAboutZ(gamma, f);
  swapAxes(f);
  turnAboutZ(beta, f);
  swapAxes(f);
  turnAboutZ(alpha, f);

  // Neighbours may write one lane twice, the same value.
  out[0] = mean;
  store(out + 1, __builtin_shufflevector(f.sine2, f.cosine2, 3, 2, 7, 1));
  store(out + 5, __builtin_shufflevector(f.sine2, f.cosine2, 0, 6, 4, 5));
  store(out + 9, __builtin_shufflevector(f.sine3, f.cosine3, 2, 1, 0, 7));
  store(out + 12, __builtin_shufflevector(f.cosine3, f.cosine3, 3, 0, 1, 2));
  store(out + 16, __builtin_shufflevector(f.sine4, f.sine4, 3, 2, 1, 0));
  out[20] = f.zonal4[0];
  store(out + 21, f.cosine4);
}
