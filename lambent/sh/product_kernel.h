// The product of two vectors, compiled for several instruction sets. Internal to this room;
// includes nothing that has inline functions (see lambent_isa_kernels in cmake/LambentRoom.cmake).
#pragma once

namespace lambent::sh {

/// Rings kept side by side in one half of the sphere: half of the Gauss-Legendre nodes that are
/// exact for three functions of `bands`, rounded up to a vector.
constexpr int productLanes(int bands) {
  return bands <= 6 ? 4 : 8;
}

/// rings: for each (l, m ≥ 0) in the sequence l(l+1)/2 + m, `lanes` values P_lm(z) sinᵐθ on the
/// rings z ≥ 0, then the same times the quadrature's weights. Lanes left over hold zeros. a, b, c:
/// bands² each; c may be a or b.
using ProductKernel = void (*)(const float* rings, const float* a, const float* b, float* c);

struct ProductKernels {
  ProductKernel forBands[11];  ///< [1] … [10]
};

namespace baseline {
ProductKernels productKernels();
}
namespace avx2 {
ProductKernels productKernels();
}
namespace avx512 {
ProductKernels productKernels();
}

}  // namespace lambent::sh
