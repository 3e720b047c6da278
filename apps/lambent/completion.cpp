#include "apps/lambent/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/lambent/command_line.h"
#include "apps/lambent/option_words.h"

namespace lambent::tool {

namespace {

constexpr std::size_t kShort = 70;  // letters of a description

/// In single quotes, for any shell but fish.
std::string shellQuoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> allNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : optionsOf(app))
    for (std::string& name : namesOf(*option)) names.push_back(std::move(name));
  return names;
}

/// The words and the files of all positionals, whichever comes next.
OptionValues positionalValues(const CLI::App& app) {
  OptionValues all;
  bool any = false;  // extension
  for (const CLI::Option* option : positionalsOf(app)) {
    const OptionValues values = valuesOf(*option);
    all.words.insert(all.words.end(), values.words.begin(), values.words.end());
    all.extensions.insert(all.extensions.end(), values.extensions.begin(), values.extensions.end());
    all.files |= values.files;
    any |= values.files && values.extensions.empty();
  }
  if (any) all.extensions.clear();
  return all;
}

// ---- bash -----------------------------------------------------------------------------------

constexpr std::string_view kBashHead =
    R"(# bash completion for lambent; made by 'lambent completion bash'.

# _lambent_offer WORDS FILES EXTENSIONS: what may stand at the cursor. FILES: 1 or nothing;
# EXTENSIONS, with bars between them, are what files end in if there are such, else any.
_lambent_offer() {
  local file any=() fitting=()
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *: ]]; then compopt -o nospace 2>/dev/null; fi
  [[ $2 ]] || return 0
  while IFS= read -r file; do
    any+=("$file")
    if [[ -d ${file/#\~/$HOME} || ${file,,} =~ \.($3)$ ]]; then fitting+=("$file"); fi
  done < <(compgen -f -- "$cur")
  [[ $3 && ${#fitting[@]} -gt 0 ]] || fitting=("${any[@]}")
  if [[ ${#fitting[@]} -gt 0 ]]; then
    compopt -o filenames 2>/dev/null
    COMPREPLY+=("${fitting[@]}")
  fi
}

_lambent() {
  local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb= word
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if [[ $word != -* ]]; then verb=$word; break; fi
  done
  # Bash takes '=' and ':' for words of their own.
  if [[ $cur == : || ($before == : && $verb) ]]; then
    if [[ $cur == : ]]; then cur=; fi
    _lambent_offer '' 1 ''
    return
  fi
  if [[ $cur == = ]]; then
    cur=
  elif [[ $before == = && COMP_CWORD -gt 2 ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  case $verb in
)";

std::string bashOffer(const OptionValues& values) {
  return fmt::format("_lambent_offer {} {} {}", shellQuoted(joined(values.words, " ")),
                     values.files ? "1" : "''", shellQuoted(joined(values.extensions, "|")));
}

std::string bashVerb(const CLI::App& app) {
  std::string text = fmt::format("    {})\n      case $before in\n", app.get_name());
  for (const CLI::Option* option : optionsOf(app)) {
    const ValueCount count = valueCount(*option);
    if (count.most == 0) continue;
    const std::string names = joined(namesOf(*option), "|");
    // A value that may be left out does not keep anything else from standing there.
    const std::string unless = count.least == 0 ? "[[ $cur == -* ]] || " : "";
    text += fmt::format("        {}) {}{{ {}; return; }} ;;\n", names, unless,
                        bashOffer(valuesOf(*option)));
  }
  text += "      esac\n";
  text += fmt::format(
      "      if [[ $cur == -* ]]; then\n        _lambent_offer {} '' ''\n      else\n        {}\n"
      "      fi\n      ;;\n",
      shellQuoted(joined(allNames(app), " ")), bashOffer(positionalValues(app)));
  return text;
}

std::string bashScript(const CLI::App& root) {
  std::string text(kBashHead);
  std::vector<std::string> first = verbNames(root);
  for (std::string& name : allNames(root)) first.push_back(std::move(name));
  text += fmt::format("    '') _lambent_offer {} '' '' ;;\n", shellQuoted(joined(first, " ")));
  for (const CLI::App* verb : verbsOf(root)) text += bashVerb(*verb);
  return text + "  esac\n}\n\ncomplete -F _lambent lambent\n";
}

// ---- zsh ------------------------------------------------------------------------------------

/// Inside a specification of _arguments.
std::string zshText(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("[]:\\").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// What completes a value: words, files or both; a blank where neither can be listed. One that
/// begins with a blank is called without what _arguments adds.
std::string zshAction(const OptionValues& values) {
  std::string files;
  if (values.files)
    files = values.extensions.empty()
                ? "_files"
                : fmt::format("_files -g \"*.({})(-.)\"", joined(values.extensions, "|"));
  if (values.words.empty()) return files.empty() ? " " : files;
  const std::string words = zshText(joined(values.words, " "));
  if (files.empty()) return fmt::format("({})", words);
  return fmt::format(" _lambent_either \"{}\" {}", words, files);
}

std::string zshOption(const CLI::Option& option) {
  const ValueCount count = valueCount(option);
  const std::vector<std::string> names = namesOf(option);
  const std::string shown = fmt::format("[{}]", zshText(inShort(option.get_description(), kShort)));
  std::string values;
  for (int i = 0; i < count.most; ++i)
    values += fmt::format("{}{}:{}", i < count.least ? ":" : "::", zshText(valueLabel(option)),
                          zshAction(valuesOf(option)));
  std::string text;
  for (const std::string& name : names) {
    const bool isLong = name.starts_with("--");
    const std::string others = repeats(option)    ? "*"
                               : names.size() > 1 ? "(" + joined(names, " ") + ")"
                                                  : "";
    const std::string equals = count.most == 0 ? "" : isLong ? "=" : "+";
    text += fmt::format("        {} \\\n", shellQuoted(others + name + equals + shown + values));
  }
  return text;
}

std::string zshVerb(const CLI::App& app) {
  std::string text = fmt::format("    {})\n      _arguments -s -S \\\n", app.get_name());
  for (const CLI::Option* option : optionsOf(app)) text += zshOption(*option);
  int place = 0;
  for (const CLI::Option* option : positionalsOf(app)) {
    const std::string where = repeats(*option) ? "*" : std::to_string(++place);
    text += fmt::format("        {} \\\n",
                        shellQuoted(fmt::format(
                            "{}{}{}:{}", where, option->get_required() ? ":" : "::",
                            zshText(option->get_name(true, false)), zshAction(valuesOf(*option)))));
  }
  return text + "        && ret=0\n      ;;\n";
}

std::string zshScript(const CLI::App& root) {
  std::string text =
      "#compdef lambent\n# zsh completion for lambent; made by 'lambent completion zsh'.\n\n"
      "# Words, of which some go on, or files.\n"
      "_lambent_either() {\n"
      "  local words=(${=1}); shift\n"
      "  _alternative \"words:word:compadd -S '' -a words\" \"files:file:$*\"\n}\n\n"
      "_lambent() {\n  local curcontext=$curcontext state line verbs ret=1\n"
      "  _arguments -C \\\n";
  for (const CLI::Option* option : optionsOf(root)) text += zshOption(*option);
  text +=
      "        '1:verb:->verb' \\\n        '*::argument:->rest' && ret=0\n"
      "  if [[ $state == verb ]]; then\n    verbs=(\n";
  for (const CLI::App* verb : verbsOf(root))
    text += fmt::format("      {}\n", shellQuoted(verb->get_name() + ":" +
                                                  inShort(verb->get_description(), kShort)));
  text += "    )\n    _describe verb verbs && ret=0\n    return ret\n  fi\n  case $words[1] in\n";
  for (const CLI::App* verb : verbsOf(root)) text += zshVerb(*verb);
  return text +
         "  esac\n  return ret\n}\n\n"
         "if [[ $funcstack[1] == _lambent ]]; then\n  _lambent \"$@\"\n"
         "else\n  compdef _lambent lambent\nfi\n";
}

// ---- fish -----------------------------------------------------------------------------------

std::string fishQuoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

/// -a with the words, and whether files are offered too.
std::string fishValues(const OptionValues& values) {
  std::string text = values.files ? " -F" : " -f";
  if (!values.words.empty()) text += " -a " + fishQuoted(joined(values.words, " "));
  return text;
}

std::string fishOption(const CLI::Option& option, const std::string& condition) {
  std::string text = "complete -c lambent " + condition;
  for (const std::string& name : namesOf(option))
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const ValueCount count = valueCount(option);
  if (count.most > 0 && count.least > 0) text += " -r" + fishValues(valuesOf(option));
  return text + " -d " + fishQuoted(inShort(option.get_description(), kShort)) + "\n";
}

std::string fishScript(const CLI::App& root) {
  std::string text =
      "# fish completion for lambent; made by 'lambent completion fish'.\n\n"
      "# Whether the verb on the command line is this; without an argument: whether there is "
      "none.\n"
      "function __lambent_verb\n"
      "    set -l words (commandline -opc)\n"
      "    for word in $words[2..-1]\n"
      "        string match -q -- '-*' $word; and continue\n"
      "        test \"$word\" = \"$argv[1]\"\n"
      "        return\n"
      "    end\n"
      "    test -z \"$argv[1]\"\n"
      "end\n\n"
      "complete -c lambent -f\n";
  for (const CLI::Option* option : optionsOf(root))
    text += fishOption(*option, "-n __lambent_verb");
  for (const CLI::App* verb : verbsOf(root))
    text += fmt::format("complete -c lambent -n __lambent_verb -a {} -d {}\n", verb->get_name(),
                        fishQuoted(inShort(verb->get_description(), kShort)));
  for (const CLI::App* verb : verbsOf(root)) {
    const std::string condition = fmt::format("-n '__lambent_verb {}'", verb->get_name());
    text += "\n";
    const OptionValues values = positionalValues(*verb);
    if (values.files || !values.words.empty())
      text += "complete -c lambent " + condition + fishValues(values) + "\n";
    for (const CLI::Option* option : optionsOf(*verb)) text += fishOption(*option, condition);
  }
  return text;
}

}  // namespace

std::string completionFor(Shell shell, const CLI::App& root) {
  switch (shell) {
    case Shell::Bash:
      return bashScript(root);
    case Shell::Zsh:
      return zshScript(root);
    case Shell::Fish:
      return fishScript(root);
  }
  return {};
}

}  // namespace lambent::tool
