// The choice, at run time, between kernels compiled for several instruction sets (see
// lambent_isa_kernels in cmake/LambentRoom.cmake).
#pragma once

namespace lambent::math {

enum class Isa { Baseline, Avx2, Avx512 };

/// The best instruction set of this machine that kernels are compiled for. LAMBENT_ISA=baseline,
/// avx2 or avx512 in the environment asks for a lesser one (to measure, or to reproduce bytes).
Isa bestIsa();

}  // namespace lambent::math
