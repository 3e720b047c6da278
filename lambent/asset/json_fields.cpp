#include "lambent/asset/json_fields.h"

#include <cmath>

namespace lambent::asset {

using nlohmann::json;

JsonFields::JsonFields(const json& value, std::string place, Fault& fault)
    : value_(&value), place_(std::move(place)), fault_(&fault) {
  if (!value.is_object() && fault_->empty()) *fault_ = place_ + ": is not an object";
}

void JsonFields::complain(std::string_view key, std::string_view what) {
  if (fault_->empty()) *fault_ = place_ + "." + std::string(key) + ": " + std::string(what);
}

bool JsonFields::has(std::string_view key) const {
  return value_->is_object() && value_->contains(key);
}

const json* JsonFields::find(std::string_view key) {
  if (!value_->is_object()) return nullptr;
  const auto found = value_->find(key);
  if (found != value_->end()) return &*found;
  complain(key, "is missing");
  return nullptr;
}

std::int64_t JsonFields::integer(std::string_view key, std::int64_t least, std::int64_t most) {
  const json* value = find(key);
  if (!value) return least;
  // A number such as 1e400 or 2^63 does not fit: compare as double before converting. 3.0 is an
  // integer, as JSON schema and JavaScript have it.
  const double number = value->is_number() ? value->get<double>() : std::nan("");
  if (number >= double(least) && number <= double(most) && number == std::floor(number))
    return std::int64_t(number);
  complain(key, "is not an integer from " + std::to_string(least) + " to " + std::to_string(most));
  return least;
}

double JsonFields::number(std::string_view key, double least, double most) {
  const json* value = find(key);
  if (!value) return least;
  if (value->is_number()) {
    const double number = value->get<double>();
    if (number >= least && number <= most) return number;  // false for NaN
  }
  complain(key, "is not a number in range");
  return least;
}

std::string JsonFields::string(std::string_view key) {
  const json* value = find(key);
  if (!value) return {};
  if (value->is_string()) return value->get<std::string>();
  complain(key, "is not a string");
  return {};
}

bool JsonFields::boolean(std::string_view key) {
  const json* value = find(key);
  if (!value) return false;
  if (value->is_boolean()) return value->get<bool>();
  complain(key, "is not true or false");
  return false;
}

JsonFields JsonFields::object(std::string_view key) {
  static const json kEmpty = json::object();
  const json* value = find(key);
  return JsonFields(value ? *value : kEmpty, place_ + "." + std::string(key), *fault_);
}

std::vector<double> JsonFields::numbers(std::string_view key, std::size_t most) {
  std::vector<double> numbers;
  const json* value = find(key);
  if (!value) return numbers;
  if (!value->is_array() || value->size() > most) {
    complain(key, "is not an array of at most " + std::to_string(most) + " numbers");
    return numbers;
  }
  for (const json& entry : *value) {
    const double number = entry.is_number() ? entry.get<double>() : std::nan("");
    if (!std::isfinite(number)) {
      complain(key, "has an entry that is not a finite number");
      return {};
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace lambent::asset
