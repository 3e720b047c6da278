// What a stage noticed and dealt with: kept-out triangles, made normals, receivers inside a mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lambent::report {

enum class Severity { Note, Warning };

struct Finding {
  Severity severity = Severity::Note;
  std::string code;         ///< stable, for --json: "degenerate-triangles", "normals-made", …
  std::string message;      ///< for people: what, where, what was done about it
  std::uint64_t count = 0;  ///< how many triangles, vertices, … are concerned
  /// Whether something that the file says was left out, or taken as something else: what `--strict`
  /// makes an error.
  bool loss = false;
};

using Findings = std::vector<Finding>;

/// What a stage made, and what it noticed on the way. A stage that can fail returns
/// Result<WithFindings<T>>: what it noticed before it failed is in the error's message or nowhere.
template <class T>
struct WithFindings {
  T value;
  Findings findings;
};

}  // namespace lambent::report

namespace lambent {
using report::Finding;
using report::Findings;
using report::Severity;
using report::WithFindings;
}  // namespace lambent
