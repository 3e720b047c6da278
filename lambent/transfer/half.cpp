#include "lambent/transfer/half.h"

#include <cassert>
#include <cstddef>

#include "lambent/math/isa.h"

namespace lambent::transfer {

#if defined(__x86_64__) || defined(_M_X64)
#define LAMBENT_HALF_KERNELS 1
#define LAMBENT_DECLARE(isa)                                                            \
  namespace isa {                                                                       \
  void halvesFromFloats(const float* values, std::uint16_t* halves, std::size_t count); \
  void floatsFromHalves(const std::uint16_t* halves, float* values, std::size_t count); \
  }
LAMBENT_DECLARE(avx2)
LAMBENT_DECLARE(avx512)
#undef LAMBENT_DECLARE
#endif

void halvesFromFloats(std::span<const float> values, std::span<std::uint16_t> halves) {
  assert(values.size() == halves.size());
#ifdef LAMBENT_HALF_KERNELS
  switch (math::bestIsa()) {
    case math::Isa::Avx512:
      return avx512::halvesFromFloats(values.data(), halves.data(), values.size());
    case math::Isa::Avx2:
      return avx2::halvesFromFloats(values.data(), halves.data(), values.size());
    case math::Isa::Baseline:
      break;
  }
#endif
  for (std::size_t i = 0; i < values.size(); ++i) halves[i] = halfFromFloat(values[i]);
}

void floatsFromHalves(std::span<const std::uint16_t> halves, std::span<float> values) {
  assert(values.size() == halves.size());
#ifdef LAMBENT_HALF_KERNELS
  switch (math::bestIsa()) {
    case math::Isa::Avx512:
      return avx512::floatsFromHalves(halves.data(), values.data(), halves.size());
    case math::Isa::Avx2:
      return avx2::floatsFromHalves(halves.data(), values.data(), halves.size());
    case math::Isa::Baseline:
      break;
  }
#endif
  for (std::size_t i = 0; i < halves.size(); ++i) values[i] = floatFromHalf(halves[i]);
}

}  // namespace lambent::transfer
