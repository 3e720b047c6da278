// .rtt (spec/rtt.md): the header's JSON is changed apart from the numbers, and most times there are
// as many numbers as it says.
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/fuzz/json_mutator.h"

namespace lambent::fuzz {
namespace {

constexpr std::size_t kHead = 12;  ///< "LRTT", version, length of the JSON

/// Bytes of numbers that the header asks for; 0 if it makes no sense.
std::size_t bytesFor(std::string_view header) {
  const auto json = nlohmann::json::parse(header, nullptr, false);
  if (!json.is_object()) return 0;
  const auto member = [&](const char* key) -> std::size_t {
    const auto at = json.find(key);
    if (at == json.end() || !at->is_number()) return 0;
    const double value = at->get<double>();
    return value >= 1 && value <= 64 ? std::size_t(value) : 0;
  };
  const std::size_t coefficients = member("bands") * member("bands");
  const std::size_t plane =
      member("width") * member("height") * member("views") * member("views") * 3;
  const auto encoding = json.find("encoding");
  if (encoding == json.end() || !encoding->is_string()) return 0;
  if (*encoding == "snorm8") return coefficients * (4 + plane);
  return coefficients * plane * (*encoding == "float16" ? 2 : 4);
}

}  // namespace

std::string mutated(std::string_view file, std::size_t most, Dice& dice) {
  if (!file.starts_with("LRTT") || file.size() < kHead || dice.roll(20) == 0) {
    return mutatedBytes(file, 16);
  }
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + 8, 4);
  length = std::uint32_t(std::min<std::size_t>(length, file.size() - kHead));
  std::string json(file.substr(kHead, length)), numbers(file.substr(kHead + length));
  if (dice.roll(3) == 0 && !numbers.empty()) {
    numbers = mutatedBytes(numbers, 0);
  } else {
    json = mutatedJson(json, dice);
    while (json.size() % 4 != 0) json += ' ';
  }
  const std::size_t wanted = bytesFor(json);
  if (dice.roll(8) != 0 && wanted > 0 && kHead + json.size() + wanted <= most) {
    numbers.resize(wanted, '\1');
  }
  length = std::uint32_t(json.size());
  std::string made(file.substr(0, 8));
  made.append(reinterpret_cast<const char*>(&length), 4);
  made += json + numbers;
  return made.size() <= most ? made : std::string(file);
}

}  // namespace lambent::fuzz
