#include "lambent/math/isa.h"

#include <cstdlib>
#include <string_view>

namespace lambent::math {

static Isa detect() {
  Isa best = Isa::Baseline;
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("f16c"))
    best = Isa::Avx2;
  if (best == Isa::Avx2 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd"))
    best = Isa::Avx512;
#endif
  if (const char* asked = std::getenv("LAMBENT_ISA")) {
    const std::string_view name = asked;
    if (name == "baseline") return Isa::Baseline;
    if (name == "avx2" && best == Isa::Avx512) return Isa::Avx2;
  }
  return best;
}

Isa bestIsa() {
  static const Isa isa = detect();
  return isa;
}

}  // namespace lambent::math
