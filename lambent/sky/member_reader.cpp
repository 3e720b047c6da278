#include "lambent/sky/member_reader.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace lambent::sky {

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t exchanged = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({exchanged, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string quotedJson(const nlohmann::json& value) {
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

std::string hint(std::string_view given, const std::vector<std::string_view>& words) {
  std::string_view nearest;
  // What is far from every word, or long, is no slip of the pen.
  std::size_t least = given.size() > 64 ? 0 : given.size() / 2 + 1;
  bool isPart = false;
  for (const std::string_view word : words) {
    const bool part = given.size() >= 3 && word.find(given) != word.npos;
    if (least == 0 || part < isPart) continue;
    const std::size_t distance = editDistance(given, word.substr(word.rfind('.') + 1));
    if (part == isPart && distance >= least) continue;
    nearest = word, least = distance, isPart = part;
  }
  if (!nearest.empty()) return fmt::format("did you mean \"{}\"?", nearest);
  return fmt::format("there are \"{}\"", fmt::join(words, "\", \""));
}

void MemberReader::complain(std::string_view path, std::string_view what) {
  if (sound()) complaint_ = fmt::format("{}: \"{}\" {}", file_, path, what);
}

const nlohmann::json* MemberReader::find(const Json& parent, std::string_view key) const {
  if (!sound()) return nullptr;
  const auto found = parent.find(key);
  return found == parent.end() ? nullptr : &*found;
}

void MemberReader::onlyKeys(const Json& parent, const std::string& prefix, Words known,
                            Words elsewhere) {
  for (const auto& member : parent.items()) {
    if (std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
    std::vector<std::string_view> words(known);
    words.insert(words.end(), elsewhere.begin(), elsewhere.end());
    const std::string quoted = quotedJson(member.key());
    return complain(prefix + quoted.substr(1, quoted.size() - (quoted.ends_with('"') ? 2 : 1)),
                    fmt::format("is not a key of {}; {}", document_, hint(member.key(), words)));
  }
}

void MemberReader::number(const Json& value, const std::string& path, Bounds bounds, double& into,
                          double scale) {
  if (!sound()) return;
  if (!value.is_number())
    return complain(path, fmt::format("is {}, not a number", quotedJson(value)));
  const double given = value.get<double>() * scale;
  if (!(given >= bounds.least && given <= bounds.most) && !(bounds.orZero && given == 0))
    return complain(
        path, fmt::format("is {}; it must be {}from {} to {}", quotedJson(value),
                          bounds.orZero ? "0 or " : "", bounds.least / scale, bounds.most / scale));
  into = given;
}

bool MemberReader::number(const Json& parent, const std::string& prefix, const std::string& key,
                          Bounds bounds, double& into) {
  const Json* value = find(parent, key);
  if (value) number(*value, prefix + key, bounds, into);
  return value != nullptr;
}

std::vector<double> MemberReader::list(const Json& value, const std::string& path, Bounds bounds,
                                       double scale) {
  std::vector<double> numbers;
  if (!sound()) return numbers;
  if (!value.is_array())
    complain(path, fmt::format("is {}, not a list of numbers", quotedJson(value)));
  else if (value.empty() || value.size() > kMostEntries)
    complain(path,
             fmt::format("has {} entries; it must have from 1 to {}", value.size(), kMostEntries));
  else
    for (std::size_t i = 0; i < value.size(); ++i)
      number(value[i], fmt::format("{}[{}]", path, i), bounds, numbers.emplace_back(0.0), scale);
  return numbers;
}

std::optional<MemberReader::Length> MemberReader::length(const Json& parent,
                                                         const std::string& prefix,
                                                         const std::string& key) {
  const Json *km = find(parent, key + "_km"), *m = find(parent, key + "_m");
  if (km && m)
    complain(prefix + key + "_m", fmt::format("and \"{}{}_km\" say the same", prefix, key));
  if (km) return Length{km, prefix + key + "_km", 1000};
  if (m) return Length{m, prefix + key + "_m", 1};
  return std::nullopt;
}

void MemberReader::length(const Json& parent, const std::string& key, Bounds bounds, double& into) {
  if (const auto found = length(parent, "", key))
    number(*found->value, found->path, bounds, into, found->metres);
}

std::optional<std::size_t> MemberReader::word(const Json& value, std::string_view path,
                                              Words words) {
  if (!sound()) return std::nullopt;
  const std::string given = value.is_string() ? value.get<std::string>() : "";
  for (std::size_t i = 0; i < words.size(); ++i)
    if (value.is_string() && given == words.begin()[i]) return i;
  complain(path, fmt::format("is {}; {}", quotedJson(value), hint(given, words)));
  return std::nullopt;
}

}  // namespace lambent::sky
