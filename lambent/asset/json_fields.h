// Members of a JSON object that came from anywhere: the first that is missing, of another type or
// out of range is remembered with its place, and the reading goes on with a harmless value, so that
// a reader asks once at the end. Only for .cpp files: it brings in nlohmann/json.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace lambent::asset {

/// The first thing wrong, as "PLACE: WHAT"; empty while all is well.
using Fault = std::string;

class JsonFields {
 public:
  /// `value` may be anything; `place` is its path for messages, as "meshes[3].extensions.…".
  JsonFields(const nlohmann::json& value, std::string place, Fault& fault);

  bool has(std::string_view key) const;
  std::int64_t integer(std::string_view key, std::int64_t least, std::int64_t most);
  double number(std::string_view key, double least, double most);
  std::string string(std::string_view key);
  bool boolean(std::string_view key);
  JsonFields object(std::string_view key);
  std::vector<double> numbers(std::string_view key, std::size_t most);  ///< an array of finite ones

  /// Records a fault of the member itself.
  void complain(std::string_view key, std::string_view what);

 private:
  const nlohmann::json* find(std::string_view key);

  const nlohmann::json* value_;
  std::string place_;
  Fault* fault_;
};

}  // namespace lambent::asset
