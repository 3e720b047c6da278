// libFuzzer's way to a mutator.
#include "tests/fuzz/json_mutator.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  using namespace lambent::fuzz;
  Dice dice(seed);
  return giveBack(mutated({reinterpret_cast<const char*>(data), size}, most, dice), data, most);
}
