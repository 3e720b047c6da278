// What the tool says about itself.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace lambent::tool {

extern const std::string_view kOverview;          ///< what `lambent` alone begins with
extern const std::string_view kOverviewShort;     ///< the same for a list of manual pages
extern const std::string_view kOverviewExamples;  ///< the verbs as a person uses them
extern const std::string_view kExitCodesInWords;  ///< "0 done, …"

/// What `lambent` alone ends with.
std::string overviewFooter();
/// What `lambent --help` or `lambent VERB --help` prints.
std::string helpOf(const CLI::App& app);

/// CLI11's help with wrapped descriptions and defaults at their end.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_option(const CLI::Option* option, bool isPositional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
};

/// Breaks text at spaces so that no line is longer than `width`; keeps the line breaks it has.
std::string wrapped(std::string_view text, std::size_t width, std::string_view indent);

}  // namespace lambent::tool
