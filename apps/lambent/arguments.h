// Text of the command line → values.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/lambent/numbers.h"
#include "lambent/math/types.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::tool {

using report::badInput, report::badUsage, report::failed;

struct Size {
  int width = 0, height = 0;
};

/// "1024x768", or "512" for a square; each side from 1 to `most`.
Result<Size> parseSize(std::string_view text, int most);
/// The same to hand to addParsed.
inline auto sizesUpTo(int most) {
  return [most](std::string_view text) { return parseSize(text, most); };
}
Result<Vec3> parsePoint(std::string_view text);      ///< "1,2,3", each of kCoordinates
Result<Vec3> parseDirection(std::string_view text);  ///< the same, not 0,0,0; of length 1
/// "0.2,0.5,0.9", or "0.5" for grey: what a surface sends back of the light that it gets.
Result<Rgb> parseReflectance(std::string_view text);
std::string formatSize(const Size& size);

/// An option whose text goes through `parse` (text → Result) into `value`; what does not parse is
/// wrong usage.
template <class V, class Parse>
CLI::Option* addParsed(CLI::App& app, const std::string& name, V& value, Parse parse,
                       const std::string& description) {
  return app.add_option_function<std::string>(
      name,
      [&value, parse, name](const std::string& text) {
        auto parsed = parse(std::string_view(text));
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

/// BadUsage that names what there is: "--mesh ear: there is no such mesh; there are head, foot".
/// `names`: what the file calls them; of many the first few are told, with how many more.
Error noSuch(std::string_view option, std::string_view given, std::string_view kind,
             const std::vector<std::string>& names);
/// What an option may call the meshes of a scene: by name, or by number where there is none.
std::vector<std::string> meshNames(const scene::Scene& scene);

/// The error of writing an output file: a full disk or a forbidden folder is a matter of what the
/// person gave, as an unusable input is.
Status written(Status status);
/// Lower-case, with the dot.
std::string extensionOf(const std::filesystem::path& path);

}  // namespace lambent::tool
