#include "apps/lambent/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "apps/lambent/command_line.h"
#include "apps/lambent/help.h"
#include "apps/lambent/option_words.h"
#include "lambent/file/atomic_file.h"

namespace lambent::tool {

namespace {

/// As the text stands, whatever is in it.
std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == '\n';
    if (begins && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\')
      out += "\\e";
    else if (text[i] == '-')
      out += "\\-";
    else if (text[i] == '\'')
      out += "\\(aq";
    else
      out += text[i];
  }
  return out;
}

std::string bold(std::string_view text) {
  return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(std::string_view text) {
  return "\\fI" + escaped(text) + "\\fR";
}

std::string upper(std::string_view text) {
  std::string out;
  for (const char c : text) out += char(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

/// Text whose lines stay as they are.
std::string asItStands(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  return fmt::format(".nf\n{}\n.fi\n", escaped(text));
}

/// A footer of the help in parts: a line that begins at the left and ends in a colon is the title
/// of what follows.
struct Part {
  std::string title;  ///< "Examples"; empty: what stands before the first title
  std::string text;
};
std::vector<Part> partsOf(std::string_view footer) {
  std::vector<Part> parts = {{}};
  while (!footer.empty()) {
    const std::size_t end = std::min(footer.find('\n'), footer.size());
    const std::string_view line = footer.substr(0, end);
    footer.remove_prefix(std::min(end + 1, footer.size()));
    if (line.size() > 1 && line.front() != ' ' && line.back() == ':') {
      const std::size_t comma = line.find(',');
      parts.push_back({std::string(line.substr(0, std::min(comma, line.size() - 1))), ""});
      if (comma != line.npos) parts.back().text = std::string(line) + "\n";
    } else if (!line.empty() || !parts.back().text.empty()) {
      parts.back().text += std::string(line) + "\n";
    }
  }
  return parts;
}

std::string tagOf(const CLI::Option& option) {
  std::string tag;
  for (const std::string& name : namesOf(option)) tag += (tag.empty() ? "" : ", ") + bold(name);
  if (option.get_positional()) tag = italic(option.get_name(true, false));
  const std::string label = option.get_positional() ? "" : valueLabel(option);
  return label.empty() ? tag : tag + " " + italic(label);
}

std::string entry(const CLI::Option& option) {
  std::string text = option.get_description();
  if (!option.get_default_str().empty())
    text += fmt::format(" (default: {})", option.get_default_str());
  return fmt::format(".TP\n{}\n{}\n", tagOf(option), escaped(text));
}

/// Options by group, in the sequence of the help.
std::string optionsText(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : positionalsOf(app)) text += entry(*option);
  std::vector<std::string> groups;
  for (const CLI::Option* option : optionsOf(app))
    if (std::find(groups.begin(), groups.end(), option->get_group()) == groups.end())
      groups.push_back(option->get_group());
  for (const std::string& group : groups) {
    if (group != "Options") text += fmt::format(".SS {}\n", escaped(group));
    for (const CLI::Option* option : optionsOf(app))
      if (option->get_group() == group) text += entry(*option);
  }
  return text;
}

std::string synopsis(const CLI::App& app) {
  std::string text = bold("lambent " + app.get_name());
  for (const CLI::Option* option : positionalsOf(app)) {
    const std::string name = italic(option->get_name(true, false)) + (repeats(*option) ? "…" : "");
    text += " " + (option->get_required() ? name : "[" + name + "]");
  }
  for (const CLI::Option* option : optionsOf(app))
    if (option->get_required())
      text += " " + bold(namesOf(*option).back()) + " " + italic(valueLabel(*option));
  return text + " [" + italic("OPTIONS") + "]\n";
}

std::string sectionsOf(std::string_view footer, bool examples) {
  std::string text;
  for (const Part& part : partsOf(footer))
    if (!part.title.empty() && examples == part.title.starts_with("Example"))
      text += fmt::format(".SH {}\n{}", escaped(upper(part.title)), asItStands(part.text));
  return text;
}

std::string head(const std::string& name, std::string_view purpose) {
  std::string sentence(purpose);
  while (sentence.ends_with('.')) sentence.pop_back();
  return fmt::format(
      ".\\\" Made by 'lambent help --man'.\n.TH {} 1 \"\" \"lambent {}\" \"Lambent\"\n"
      ".SH NAME\n{} \\- {}\n",
      escaped(upper(name)), LAMBENT_VERSION, escaped(name), escaped(sentence));
}

std::string manualOf(const CLI::App& verb) {
  const std::string footer = verb.get_footer();
  std::string text = head("lambent-" + verb.get_name(), verb.get_description());
  text += ".SH SYNOPSIS\n" + synopsis(verb);
  text += fmt::format(".SH DESCRIPTION\n{}.\n", escaped(verb.get_description()));
  if (const std::vector<Part> parts = partsOf(footer); !parts.front().text.empty())
    text += ".PP\n" + asItStands(parts.front().text);
  text += ".SH OPTIONS\n" + optionsText(verb);
  text += sectionsOf(footer, false) + sectionsOf(footer, true);
  text += fmt::format(".SH EXIT STATUS\n{}\n", escaped(kExitCodesInWords));
  return text + ".SH SEE ALSO\n.BR lambent (1)\n";
}

std::string manualOfAll(const CLI::App& root) {
  std::string text = head("lambent", kOverviewShort);
  text += fmt::format(".SH SYNOPSIS\n{} {} …\n.SH DESCRIPTION\n{}\n", bold("lambent"),
                      italic("VERB"), escaped(kOverview));
  text += ".SH VERBS\n";
  std::string also;
  for (const CLI::App* verb : verbsOf(root)) {
    text += fmt::format(".TP\n.BR {} (1)\n{}\n", escaped("lambent-" + verb->get_name()),
                        escaped(verb->get_description()));
    also += fmt::format("{}.BR {} (1)", also.empty() ? "" : ",\n",
                        escaped("lambent-" + verb->get_name()));
  }
  text += ".SH OPTIONS\n" + optionsText(root);
  text += fmt::format(".SH EXAMPLES\n{}", asItStands(kOverviewExamples));
  text += fmt::format(".SH EXIT STATUS\n{}\n", escaped(kExitCodesInWords));
  return text + ".SH SEE ALSO\n" + also + "\n";
}

}  // namespace

std::string manualPage(const CLI::App& root, const CLI::App* verb) {
  return verb ? manualOf(*verb) : manualOfAll(root);
}

Status writeManual(const CLI::App& root, const std::filesystem::path& folder) {
  if (Status s = file::writeAtomically(folder / "lambent.1", manualPage(root, nullptr)); !s)
    return s;
  for (const CLI::App* verb : verbsOf(root)) {
    const std::string name = "lambent-" + verb->get_name() + ".1";
    if (Status s = file::writeAtomically(folder / name, manualPage(root, verb)); !s) return s;
  }
  return Status::ok();
}

}  // namespace lambent::tool
