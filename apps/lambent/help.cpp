#include "apps/lambent/help.h"

#include <sstream>

namespace lambent::tool {

const std::string_view kOverview =
    R"(Lambent bakes how light moves over an asset once, and then relights it under any sky.)";

const std::string_view kOverviewShort = "bake how light moves over an asset, and relight it";

const std::string_view kOverviewExamples =
    R"(  lambent info model.glb                               what is in the file?
  lambent bake model.glb -o baked.glb                  simulate once how light moves over it
  lambent render baked.glb --light sky.exr -o a.png    relight it, as often as you like
  lambent render baked.glb --light disc:30,45,20 -o b.png
  lambent view baked.glb sky.exr studio.exr            move light, object and camera
  lambent reference model.glb --light sky.exr -o truth.exr
  lambent render baked.glb --light sky.exr -o ours.exr
  lambent compare truth.exr ours.exr --strip strip.png how far from the truth is it?
  lambent rtt weave -o weave.rtt                       a patch of texture with depth
  lambent synthesize model.glb --rtt weave.rtt -o woven.glb   spread over a surface
  lambent sky --date 2026-06-21 --time 05:40 --utc-offset 2 --lat 46.2 --lon 6.1 -o sky.exr
)";

const std::string_view kExitCodesInWords = "0 done, 1 the work failed, 2 wrong usage, 3 bad input.";

std::string overviewFooter() {
  return "In the sequence in which a person uses them:\n" + std::string(kOverviewExamples) +
         "\n'lambent VERB --help' explains a verb with examples.\nExit codes: " +
         std::string(kExitCodesInWords) + "\n";
}

std::string helpOf(const CLI::App& app) {
  return app.get_formatter()->make_help(&app, "lambent", CLI::AppFormatMode::Normal);
}

HelpFormatter::HelpFormatter() {
  column_width(32);
}

std::string wrapped(std::string_view text, std::size_t width, std::string_view indent) {
  std::string out;
  std::size_t column = 0;
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == '\n') {
      out += '\n';
      out += indent;
      column = 0;
      ++at;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::size_t length = end - at;
    if (column > 0 && column + 1 + length > width) {
      out += '\n';
      out += indent;
      column = 0;
    }
    if (column > 0) {
      out += ' ';
      ++column;
    }
    out.append(text.substr(at, length));
    column += length;
    at = end < text.size() && text[end] == ' ' ? end + 1 : end;
  }
  return out;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
  for (std::size_t at; (at = help.find("\n\n\n")) != help.npos;) help.erase(at, 1);
  return help;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool isPositional) const {
  const std::size_t left = get_column_width();
  std::string description = make_option_desc(option);
  if (!option->get_default_str().empty())
    description += " (default: " + option->get_default_str() + ")";
  const std::string indent(left, ' ');
  std::string name = "  " + make_option_name(option, isPositional);
  if (!isPositional) name += make_option_opts(option);
  if (name.size() + 2 > left)
    name += "\n" + indent;
  else
    name.resize(left, ' ');
  return name + wrapped(description, 98 - left, indent) + "\n";
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  if (!option->get_option_text().empty()) return " " + option->get_option_text();
  if (option->get_type_size() == 0) return "";
  return option->get_type_name().empty() ? "" : " " + option->get_type_name();
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::ostringstream out;
  out << "\nUsage: " << (app->get_parent() ? "lambent " + app->get_name() : name);
  for (const CLI::Option* option : app->get_options())
    if (option->get_positional()) out << ' ' << option->get_name(true, false);
  for (const CLI::Option* option : app->get_options())
    if (option->nonpositional() && option->get_required())
      out << ' ' << option->get_name(false, false) << make_option_opts(option);
  out << (app->get_parent() ? " [OPTIONS]\n" : " VERB …\n");
  return out.str();
}

}  // namespace lambent::tool
