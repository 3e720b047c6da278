// How a long stage says how far it is, and is asked to stop.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace lambent::report {

struct ProgressUpdate {
  std::string_view stage;   ///< "shadows and first bounce", "bounce 2", …
  std::uint64_t done = 0;   ///< units finished
  std::uint64_t total = 0;  ///< units in this stage
  std::string_view unit;    ///< "rays", "vertices", "pixels"
};

/// Called from one thread at a time, a few times a second. Return false to cancel: the stage then
/// returns ErrorKind::Cancelled. An empty function means: nobody listens.
using Progress = std::function<bool(const ProgressUpdate&)>;

}  // namespace lambent::report

namespace lambent {
using report::Progress;
using report::ProgressUpdate;
}  // namespace lambent
