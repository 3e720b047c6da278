// Inputs that are JSON from beginning to end.
#include "tests/fuzz/json_mutator.h"

namespace lambent::fuzz {

std::string mutated(std::string_view file, std::size_t, Dice& dice) {
  return mutatedJson(file, dice);
}

}  // namespace lambent::fuzz
