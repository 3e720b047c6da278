// What options and arguments are called and take, read off the texts that --help shows: completions
// and manual pages are made of the same.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lambent::tool {

/// What may stand for a value, as far as it can be listed.
struct OptionValues {
  std::vector<std::string> words;  ///< whole words: "shadowed"; "disc:" is the beginning of one
  bool files = false;              ///< or a file
  std::vector<std::string> extensions;  ///< that it may well have, without dots; empty: any
};
OptionValues valuesOf(const CLI::Option& option);

/// "OUT.png|OUT.exr": what stands for the value in the help; empty if the option takes none.
std::string valueLabel(const CLI::Option& option);
/// "-o", "--output"; of a positional nothing.
std::vector<std::string> namesOf(const CLI::Option& option);
/// How many values may follow one naming of it, at least and at most.
struct ValueCount {
  int least = 0, most = 0;
};
ValueCount valueCount(const CLI::Option& option);
/// Whether it may be given again.
bool repeats(const CLI::Option& option);

std::vector<const CLI::Option*> positionalsOf(const CLI::App& app);
std::vector<const CLI::Option*> optionsOf(const CLI::App& app);

/// What an option does in at most about `most` letters: the beginning of its description, to the
/// end of a sentence, a clause or a word.
std::string inShort(std::string_view description, std::size_t most);

}  // namespace lambent::tool
