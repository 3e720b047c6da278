#include "lambent/file/budget.h"

#include <algorithm>
#include <cstdio>

namespace lambent::file {
namespace {

/// a + b, or the largest number there is.
std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
  return a + b < a ? ~std::uint64_t(0) : a + b;
}
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > ~std::uint64_t(0) / b ? ~std::uint64_t(0) : a * b;
}

constexpr const char* kRemedy = "; make it smaller, or allow more (--memory-limit)";

}  // namespace

std::string inBinaryUnits(std::uint64_t bytes) {
  constexpr const char* kUnits[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  double value = double(bytes);
  std::size_t unit = 0;
  for (; value >= 1024.0; ++unit) value /= 1024.0;
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", value, kUnits[unit]);
  return text;
}

std::uint64_t Budget::limit() const {
  if (given_) return *given_;
  return std::min(kMostBytes, sum(kFloorBytes, times(read_, kBytesPerByte)));
}

Status Budget::hold(std::uint64_t bytes, std::string_view what) {
  const std::uint64_t total = sum(held_, bytes);
  if (total > limit()) {
    const std::string before =
        held_ == 0 ? "" : ", with " + inBinaryUnits(held_) + " for what came before it";
    return report::badInput(std::string(what) + " would take " + inBinaryUnits(bytes) + before +
                            ", over the limit of " + inBinaryUnits(limit()) + " for one file of " +
                            inBinaryUnits(read_) + kRemedy);
  }
  if (Status status = work(bytes, what); !status) return status;
  held_ = total;
  return Status::ok();
}

Status Budget::work(std::uint64_t bytes, std::string_view what) {
  const std::uint64_t most =
      given_ ? times(*given_, kWorkPerByte) : sum(kFloorBytes, times(read_, kBytesPerByte));
  worked_ = sum(worked_, bytes);
  if (worked_ <= most) return Status::ok();
  return report::badInput(std::string(what) + " would bring what has to be gone through to " +
                          inBinaryUnits(worked_) + ", over the limit of " + inBinaryUnits(most) +
                          " for one file of " + inBinaryUnits(read_) + kRemedy);
}

}  // namespace lambent::file
