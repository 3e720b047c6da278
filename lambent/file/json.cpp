#include "lambent/file/json.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lambent::file {
namespace {

/// A message of the parser quotes what it read last, which may be long.
constexpr std::size_t kLongestReason = 300;

/// Where brackets first nest too deep, as an offset. Whether the text is JSON at all is the
/// parser's to say.
std::optional<std::size_t> tooDeepAt(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"':
        for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
        break;
      case '[':
      case '{':
        if (++depth > kDeepestJson) return i;
        break;
      case ']':
      case '}':
        --depth;
        break;
      default:
        break;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<nlohmann::json> parseJson(std::string_view text) {
  if (const auto at = tooDeepAt(text)) {
    return report::badInput("its values are nested more than " + std::to_string(kDeepestJson) +
                            " deep at byte " + std::to_string(*at));
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& problem) {
    const std::string_view reason = problem.what();
    if (reason.size() <= kLongestReason) return report::badInput(std::string(reason));
    return report::badInput(std::string(reason.substr(0, kLongestReason)) + "...");
  }
}

std::optional<std::string> repeatedKey(std::string_view text) {
  using Event = nlohmann::json::parse_event_t;
  std::optional<std::string> repeated;
  std::vector<std::set<std::string>> open;  // the keys of every object that is not yet closed
  const auto look = [&](int, Event event, nlohmann::json& value) {
    if (event == Event::object_start) open.emplace_back();
    if (event == Event::object_end) open.pop_back();
    if (event == Event::key && !repeated) {
      const std::string& key = value.get_ref<const std::string&>();
      if (!open.back().insert(key).second) repeated = key;
    }
    return true;
  };
  [[maybe_unused]] const nlohmann::json again = nlohmann::json::parse(text, look, false);
  return repeated;
}

nlohmann::json& arrayAt(nlohmann::json& object, const char* key) {
  nlohmann::json& value = object[key];
  if (value.is_null()) value = nlohmann::json::array();
  return value;
}

nlohmann::json& objectAt(nlohmann::json& object, const char* key) {
  nlohmann::json& value = object[key];
  if (value.is_null()) value = nlohmann::json::object();
  return value;
}

}  // namespace lambent::file
