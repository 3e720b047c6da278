#include "apps/lambent/option_words.h"

#include <algorithm>
#include <cctype>

#include "lambent/sources/source.h"

namespace lambent::tool {

namespace {

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

bool isLower(char c) {
  return c >= 'a' && c <= 'z';
}

/// "on", "two-sided": a word to be written as it stands.
bool isWord(std::string_view text) {
  return !text.empty() && isLower(text.front()) &&
         std::all_of(text.begin(), text.end(), [](char c) { return isLower(c) || c == '-'; });
}

void addOnce(std::vector<std::string>& list, std::string word) {
  if (std::find(list.begin(), list.end(), word) == list.end()) list.push_back(std::move(word));
}

/// "png" of every ".png" in a text.
void addExtensions(std::string_view text, std::vector<std::string>& extensions) {
  for (std::size_t at = 0; (at = text.find('.', at)) != text.npos;) {
    std::size_t end = ++at;
    while (end < text.size() && isLower(text[end])) ++end;
    if (end > at + 1) addOnce(extensions, std::string(text.substr(at, end - at)));
  }
}

/// The words that CLI11 checks for, which it describes as {a,b,c}.
std::vector<std::string> checkedWords(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == type.npos || close == type.npos || close <= open + 1) return {};
  return split(std::string_view(type).substr(open + 1, close - open - 1), ',');
}

bool mentions(std::string_view text, std::string_view word) {
  return text.find(word) != text.npos;
}

}  // namespace

OptionValues valuesOf(const CLI::Option& option) {
  OptionValues values;
  values.words = checkedWords(option);
  if (!values.words.empty() || valueCount(option).most == 0) return values;
  const bool positional = option.get_positional();
  const std::string label = positional ? option.get_name(true, false) : valueLabel(option);
  for (std::string part : split(label, '|')) {
    std::erase_if(part, [](char c) { return c == '[' || c == ']'; });
    if (isWord(part)) values.words.push_back(part);
  }
  if (mentions(label, "SOURCE") || (positional && mentions(option.get_description(), "SOURCE")))
    for (const sources::SourceKind& kind : sources::sourceKinds()) {
      const bool more = kind.syntax.substr(kind.word.size()).starts_with(':');
      values.words.push_back(std::string(kind.word) + (more ? ":" : ""));
    }
  addExtensions(positional ? option.get_description() : label, values.extensions);
  values.files = positional || !values.extensions.empty();
  for (const char* word : {"FILE", "SCENE", "ASSET", "SOURCE", "DIR"})
    values.files |= mentions(label, word);
  return values;
}

std::string valueLabel(const CLI::Option& option) {
  if (!option.get_option_text().empty()) return option.get_option_text();
  return option.get_type_size() == 0 ? "" : option.get_type_name();
}

std::vector<std::string> namesOf(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

ValueCount valueCount(const CLI::Option& option) {
  if (option.get_type_size() == 0) return {0, 0};
  if (repeats(option)) return {1, 1};
  return {option.get_items_expected_min(), option.get_items_expected_max()};
}

bool repeats(const CLI::Option& option) {
  return option.get_type_size() != 0 && option.get_items_expected_max() > 8;
}

std::vector<const CLI::Option*> positionalsOf(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

std::vector<const CLI::Option*> optionsOf(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) {
    return option->nonpositional() && !namesOf(*option).empty();
  });
}

std::string inShort(std::string_view description, std::size_t most) {
  std::size_t end = description.size();
  for (const std::string_view stop : {". ", "; ", ": ", " (", ", "}) {
    if (end <= most) break;
    const std::size_t at = description.rfind(stop, most);
    // The sentence if it is short enough, else a clause that says something.
    const std::size_t first = description.find(stop);
    if (stop == ". " && first != description.npos && first <= most) end = first;
    if (stop != ". " && at != description.npos && at >= most / 3) end = at;
  }
  if (end > most) end = std::min(description.rfind(' ', most), most);
  std::string text(description.substr(0, end));
  while (!text.empty() && (text.back() == '.' || text.back() == ',')) text.pop_back();
  return text;
}

}  // namespace lambent::tool
