#include "lambent/transport/row_kernels.h"

#include <cassert>

#include "lambent/math/isa.h"

namespace lambent::transport {

#define LAMBENT_DECLARE_ROW_KERNELS(isa)                                                          \
  namespace isa {                                                                                 \
  void addRows(const float*, std::size_t, const std::uint32_t*, const float*, std::size_t,        \
               double*);                                                                          \
  void addTintedRows(const float*, std::size_t, const float*, const std::uint32_t*, const float*, \
                     std::size_t, double*);                                                       \
  void addOuterProducts(const float*, std::size_t, std::size_t, const float*, std::size_t,        \
                        std::size_t, float*, std::size_t);                                        \
  }
LAMBENT_DECLARE_ROW_KERNELS(baseline)
#if defined(__x86_64__)
LAMBENT_DECLARE_ROW_KERNELS(avx2)
LAMBENT_DECLARE_ROW_KERNELS(avx512)
#endif

namespace {

struct Kernels {
  decltype(&baseline::addRows) addRows = &baseline::addRows;
  decltype(&baseline::addTintedRows) addTintedRows = &baseline::addTintedRows;
  decltype(&baseline::addOuterProducts) addOuterProducts = &baseline::addOuterProducts;
};

const Kernels& kernels() {
  static const Kernels chosen = [] {
    Kernels k;
#if defined(__x86_64__)
    const math::Isa isa = math::bestIsa();
    if (isa == math::Isa::Avx2) k = {&avx2::addRows, &avx2::addTintedRows, &avx2::addOuterProducts};
    if (isa == math::Isa::Avx512)
      k = {&avx512::addRows, &avx512::addTintedRows, &avx512::addOuterProducts};
#endif
    return k;
  }();
  return chosen;
}

}  // namespace

void addRows(Rows rows, std::span<const std::uint32_t> ids, std::span<const float> weights,
             double* out) {
  assert(ids.size() == weights.size() && rows.stride % kRowUnit == 0);
  kernels().addRows(rows.data, rows.stride, ids.data(), weights.data(), ids.size(), out);
}

void addTintedRows(Rows rows, std::span<const float> masks, std::span<const std::uint32_t> ids,
                   std::span<const float> weights, double* out) {
  assert(3 * ids.size() == weights.size() && masks.size() == 3 * rows.stride);
  kernels().addTintedRows(rows.data, rows.stride, masks.data(), ids.data(), weights.data(),
                          ids.size(), out);
}

void addOuterProducts(Rows left, std::size_t leftCount, Rows right, std::size_t count, float* out,
                      std::size_t outStride) {
  assert(right.stride % kRowUnit == 0);
  kernels().addOuterProducts(left.data, left.stride, leftCount, right.data, right.stride, count,
                             out, outStride);
}

}  // namespace lambent::transport
