// Text of the command line → values.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::tool {

using report::badInput, report::badUsage, report::failed;

struct Size {
  int width = 0, height = 0;
};

Result<double> parseNumber(std::string_view text);  ///< finite
Result<Size> parseSize(std::string_view text);      ///< "1024x768", or "512" for a square
Result<Vec3> parseTriple(std::string_view text);    ///< "1,2,3"
Result<Rgb> parseRgb(std::string_view text);        ///< "0.2,0.5,0.9", or "0.5" for grey
std::string formatSize(const Size& size);

/// An option whose text goes through `parse` into `value`; what does not parse is wrong usage.
template <class T, class V>
CLI::Option* addParsed(CLI::App& app, const std::string& name, V& value,
                       Result<T> (*parse)(std::string_view), const std::string& description) {
  return app.add_option_function<std::string>(
      name,
      [&value, parse, name](const std::string& text) {
        Result<T> parsed = parse(text);
        if (!parsed) throw CLI::ValidationError(name, parsed.error().message);
        value = *parsed;
      },
      description);
}

/// The words that an option takes, and what each stands for.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// The word for one of the values.
template <class Value>
std::string wordOf(const Value& value, const Choices<Value>& choices) {
  for (const auto& [word, meant] : choices)
    if (meant == value) return word;
  return {};
}

/// An option that takes one of a few words. The word for what `value` holds is its default; a
/// std::optional that is empty has none.
template <class Value>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Value& value,
                       const Choices<std::type_identity_t<Value>>& choices,
                       const std::string& description) {
  std::vector<std::string> words;
  for (const auto& choice : choices) words.push_back(choice.first);
  CLI::Option* option = app.add_option_function<std::string>(
      name,
      [&value, choices](const std::string& given) {
        for (const auto& [word, meant] : choices)
          if (word == given) value = meant;
      },
      description);
  return option->check(CLI::IsMember(words))->default_str(wordOf(value, choices));
}

/// Whether a file can appear at `path`, with one of `extensions`, without replacing `input`: asked
/// before long work.
Status checkOutput(const std::filesystem::path& path,
                   std::initializer_list<std::string_view> extensions,
                   const std::filesystem::path& input);
/// The error of writing an output file: a full disk or a forbidden folder is a matter of what the
/// person gave, as an unusable input is.
Status written(Status status);
/// Lower-case, with the dot.
std::string extensionOf(const std::filesystem::path& path);

}  // namespace lambent::tool
