#include "lambent/math/isa.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

#include <cstdlib>
#include <string_view>

namespace lambent::math {

#if defined(__x86_64__)
/// __builtin_cpu_supports("f16c") is unknown to clang before 15, so this bit is read by hand.
static bool hasF16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) && (c & bit_F16C);
}
#endif

static Isa detect() {
  Isa best = Isa::Baseline;
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2") && hasF16c())
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
