// Inputs that are JSON from beginning to end.
#include "tests/fuzz/json_mutator.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  using namespace lambent::fuzz;
  Dice dice(seed);
  return giveBack(mutatedJson({reinterpret_cast<const char*>(data), size}, dice), data, most);
}
