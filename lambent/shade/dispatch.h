// The kernels of one instruction set, and memory that suits them.
#pragma once

#include "lambent/math/isa.h"
#include "lambent/shade/kernels.h"

namespace lambent::shade {

/// `isa` must be one that the machine has (math::bestIsa() or lesser).
inline Kernels kernelsFor([[maybe_unused]] math::Isa isa) {
#if defined(__x86_64__)
  if (isa == math::Isa::Avx512) return avx512::kernels();
  if (isa == math::Isa::Avx2) return avx2::kernels();
#endif
  return baseline::kernels();
}

}  // namespace lambent::shade
