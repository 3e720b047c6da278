// Half conversion with the machine's instructions (F16C, which every AVX2 machine has). Compiled
// once for every instruction set into namespace LAMBENT_ISA; the baseline has no such instruction,
// so there half.h's functions do the work and this file is empty. 8 lanes saturate memory already.
#if defined(__F16C__)

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lambent::transfer::LAMBENT_ISA {

namespace {

constexpr std::size_t kLanes = 8;

void encodeLanes(const float* values, std::uint16_t* halves) {
  const __m256 limit = _mm256_set1_ps(65504.0f), signBit = _mm256_set1_ps(-0.0f);
  const __m256 x = _mm256_loadu_ps(values);
  const __m256 infinite =
      _mm256_cmp_ps(_mm256_andnot_ps(signBit, x), _mm256_set1_ps(__builtin_inff()), _CMP_EQ_OQ);
  // min and max return their second operand where one is NaN.
  const __m256 clamped = _mm256_max_ps(_mm256_or_ps(signBit, limit), _mm256_min_ps(limit, x));
  const __m256 kept = _mm256_blendv_ps(clamped, x, infinite);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(halves),
                   _mm256_cvtps_ph(kept, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
}

void decodeLanes(const std::uint16_t* halves, float* values) {
  _mm256_storeu_ps(values,
                   _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(halves))));
}

}  // namespace

void halvesFromFloats(const float* values, std::uint16_t* halves, std::size_t count) {
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) encodeLanes(values + i, halves + i);
  if (i < count) {
    float in[kLanes] = {};
    std::uint16_t out[kLanes];
    std::memcpy(in, values + i, (count - i) * sizeof(float));
    encodeLanes(in, out);
    std::memcpy(halves + i, out, (count - i) * sizeof(std::uint16_t));
  }
}

void floatsFromHalves(const std::uint16_t* halves, float* values, std::size_t count) {
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) decodeLanes(halves + i, values + i);
  if (i < count) {
    std::uint16_t in[kLanes] = {};
    float out[kLanes];
    std::memcpy(in, halves + i, (count - i) * sizeof(std::uint16_t));
    decodeLanes(in, out);
    std::memcpy(values + i, out, (count - i) * sizeof(float));
  }
}

}  // namespace lambent::transfer::LAMBENT_ISA

#endif  // __F16C__
