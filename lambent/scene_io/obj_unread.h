// The statements of an OBJ file that are not read, counted.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "lambent/scene_io/diagnosis.h"

namespace lambent::scene_io {

class UnreadStatements {
 public:
  void add(std::string_view key, std::size_t line);
  /// A finding for each kind: points and lines, free-form surfaces, calls of other files, what
  /// nobody knows. Statements that change no look (groups, levels of detail, what belongs to a
  /// free-form surface) are none.
  void tell(Diagnosis& diagnosis) const;

 private:
  struct Count {
    std::size_t count = 0, line = 0;
  };
  std::map<std::string, Count, std::less<>> counts_;
};

}  // namespace lambent::scene_io
