// libFuzzer's way into a target.

#include "lambent/work/thread_limit.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // One thread: what an input reaches must not depend on who was there first.
  static const lambent::work::ThreadLimit one(1);
  lambent::fuzz::LAMBENT_FUZZ_TARGET(std::as_bytes(std::span(data, size)));
  return 0;
}
