// Light along a ray, by the source function's integral (preetham2003modeling, "Skylight Models":
// I¹ from the Sun, Iⁱ⁺¹ from Iⁱ):
//   radiance = Σ weight · e^(−τ) · Σ_part scattering · density · (phase · e^(−τ_sun) + ∫ phase · I)
#include "lambent/sky/march.h"

#define LAMBENT_INLINE inline __attribute__((always_inline))

namespace lambent::sky {
namespace LAMBENT_ISA {
namespace {

#if defined(__AVX512F__)
constexpr int kNative = 16;
#elif defined(__AVX2__)
constexpr int kNative = 8;
#else
constexpr int kNative = 4;
#endif

typedef float V __attribute__((vector_size(4 * kNative)));
typedef float VUnaligned __attribute__((vector_size(4 * kNative), aligned(4)));
typedef int I __attribute__((vector_size(4 * kNative)));

LAMBENT_INLINE V load(const float* p) {
  return *reinterpret_cast<const VUnaligned*>(p);
}
LAMBENT_INLINE void store(float* p, V v) {
  *reinterpret_cast<VUnaligned*>(p) = v;
}

// 2^n · 2^f with a polynomial for 2^f, −½ ≤ f ≤ ½ (minimax, 2e-8 relative).
LAMBENT_INLINE V exponential(V x) {
  const V low = V{} - 87.0f, high = V{} + 88.0f;
  const I under = x < low;
  x = x < low ? low : x;
  x = x > high ? high : x;
  const V t = x * 1.44269504088896341f;
  const V magic = V{} + 12582912.0f;  // 1.5·2²³: its sum rounds to the nearest whole number
  const V whole = (t + magic) - magic;
  const V f = (x - whole * 0.693145751953125f) - whole * 1.428606765330187e-06f;
  V p = V{} + 1.9875691500e-4f;
  p = p * f + 1.3981999507e-3f;
  p = p * f + 8.3334519073e-3f;
  p = p * f + 4.1665795894e-2f;
  p = p * f + 1.6666665459e-1f;
  p = p * f + 5.0000001201e-1f;
  p = p * f * f + f + 1.0f;
  const I bits = (__builtin_convertvector(whole, I) + 127) << 23;
  const V value = p * (V)bits;
  return (V)((I)value & ~under);
}

void march(const MarchTables& tables, const MarchNode* nodes, int count, bool once, bool again,
           MarchSums& sums) {
  for (int lane = 0; lane < kLanes; lane += kNative) {
    const V extAir = load(tables.extinction[0] + lane),
            extAerosol = load(tables.extinction[1] + lane),
            extOzone = load(tables.extinction[2] + lane);
    const V scatAir = load(tables.scattering[0] + lane),
            scatAerosol = load(tables.scattering[1] + lane);
    V sumAir = {}, sumAerosol = {}, sumMultiple = {};
    for (int n = 0; n < count; ++n) {
      const MarchNode& node = nodes[n];
      const V depth =
          extAir * node.length[0] + extAerosol * node.length[1] + extOzone * node.length[2];
      const V air = scatAir * (node.density[0] * node.weight);
      const V aerosol = scatAerosol * (node.density[1] * node.weight);
      if (once && node.sunVisible > 0) {
        const V sun = extAir * node.sunLength[0] + extAerosol * node.sunLength[1] +
                      extOzone * node.sunLength[2];
        const V light = exponential(V{} - depth - sun) * node.sunVisible;
        sumAir += air * light;
        sumAerosol += aerosol * light;
      }
      if (again) {
        V logScale = {}, moments = {}, phased = {};
        for (int c = 0; c < node.cellCount; ++c) {
          const float w = node.cellWeight[c];
          const float* scale = tables.logScale + long(node.cell[c]) * kLanes + lane;
          const float* moment = tables.moments + long(node.cell[c]) * 4 * kLanes + lane;
          const float* directed =
              tables.aerosol + (long(node.cell[c]) * tables.directions + node.direction) * kLanes +
              lane;
          logScale += w * load(scale);
          V m = node.moment[0] * load(moment);
          m += node.moment[1] * load(moment + kLanes);
          m += node.moment[2] * load(moment + 2 * kLanes);
          m += node.moment[3] * load(moment + 3 * kLanes);
          moments += w * m;
          V d = {};
          for (int i = 0; i < 4; ++i) {
            const float* row = directed + long(i) * tables.azimuthStride * kLanes;
            V r = node.azimuthWeight[0] * load(row);
            r += node.azimuthWeight[1] * load(row + kLanes);
            r += node.azimuthWeight[2] * load(row + 2 * kLanes);
            r += node.azimuthWeight[3] * load(row + 3 * kLanes);
            d += node.zenithWeight[i] * r;
          }
          phased += w * d;
        }
        const V zero = {};
        // Interpolation may overshoot where there is next to nothing.
        moments = moments > zero ? moments : zero;
        phased = phased > zero ? phased : zero;
        const float kRayleigh = 0.05968310365946075f;  // 3/16π
        sumMultiple +=
            exponential(logScale - depth) * (air * (moments * kRayleigh) + aerosol * phased);
      }
    }
    store(sums.air + lane, sumAir);
    store(sums.aerosol + lane, sumAerosol);
    store(sums.multiple + lane, sumMultiple);
  }
}

void expOfLanes(const float* x, float* out) {
  for (int lane = 0; lane < kLanes; lane += kNative) store(out + lane, exponential(load(x + lane)));
}

void weigh(const float* weights, int rows, int count, const float* in, float* out) {
  for (int lane = 0; lane < kLanes; lane += kNative) {
    // Four rows at a time share what they read.
    int row = 0;
    for (; row + 4 <= rows; row += 4) {
      const float* w = weights + long(row) * count;
      V a = {}, b = {}, c = {}, d = {};
      for (int i = 0; i < count; ++i) {
        const V x = load(in + long(i) * kLanes + lane);
        a += w[i] * x;
        b += w[count + i] * x;
        c += w[2 * count + i] * x;
        d += w[3 * count + i] * x;
      }
      float* to = out + long(row) * kLanes + lane;
      store(to, a);
      store(to + kLanes, b);
      store(to + 2 * kLanes, c);
      store(to + 3 * kLanes, d);
    }
    for (; row < rows; ++row) {
      V sum = {};
      for (int i = 0; i < count; ++i)
        sum += weights[long(row) * count + i] * load(in + long(i) * kLanes + lane);
      store(out + long(row) * kLanes + lane, sum);
    }
  }
}

}  // namespace

MarchKernels marchKernels() {
  return {march, expOfLanes, weigh};
}

}  // namespace LAMBENT_ISA
}  // namespace lambent::sky
