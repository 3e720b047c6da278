#include "apps/lambent/command_line.h"

#include <fmt/format.h>

#include "apps/lambent/help.h"
#include "apps/lambent/nearest_word.h"

namespace lambent::tool {

namespace {

/// "--directions" of "--directions=64".
std::string nameOfOption(const std::string& text) {
  return text.substr(0, text.find('='));
}

std::string didYouMean(const std::string& word) {
  return word.empty() ? "" : fmt::format(". Did you mean '{}'?", word);
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

UsageError noSuchOption(const CLI::App& app, const std::string& given) {
  const bool root = app.get_parent() == nullptr;
  const std::string name = nameOfOption(given);
  const std::string whole = root ? "lambent" : "lambent " + app.get_name();
  std::string hint = didYouMean(nearestWord(name, optionNames(app)));
  if (root && hint.empty()) {
    for (const CLI::App* verb : verbsOf(app))
      if (verb->get_option_no_throw(name))
        hint = ": options of a verb stand after it, as in 'lambent info FILE --json'";
  }
  return {fmt::format("{} has no option '{}'{}", whole, name, hint), whole + " --help"};
}

/// What CLI11 found no place for, in the sequence in which it was written, and where.
struct Unplaced {
  const CLI::App* app = nullptr;
  std::vector<std::string> words;
};
Unplaced unplacedIn(const CommandLine& line) {
  for (const CLI::App* verb : line.root.get_subcommands())
    if (auto words = verb->remaining(); !words.empty()) return {verb, std::move(words)};
  return {&line.root, line.root.remaining()};
}

bool isOption(const std::string& word) {
  return word.size() > 1 && word.front() == '-' && !(word[1] >= '0' && word[1] <= '9') &&
         word[1] != '.';
}

}  // namespace

CommandLine::CommandLine() : root(std::string(kOverview), "lambent") {
  root.formatter(std::make_shared<HelpFormatter>());
  root.set_version_flag("--version", "lambent " LAMBENT_VERSION, "Print the version");
  root.require_subcommand(0, 1);
  root.footer(overviewFooter());
  for (const auto add : {addBake, addLight, addShade, addRender, addReference, addCompare, addRtt,
                         addSynthesize, addView, addSky, addInfo, addHelp, addCompletion})
    verbs.push_back(add(root, options));
}

const Verb* CommandLine::named() const {
  for (const Verb& verb : verbs)
    if (verb.app->parsed()) return &verb;
  return nullptr;
}

std::vector<const CLI::App*> verbsOf(const CLI::App& root) {
  return root.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> verbNames(const CLI::App& root) {
  std::vector<std::string> names;
  for (const CLI::App* verb : verbsOf(root)) names.push_back(verb->get_name());
  return names;
}

UsageError noSuchVerb(const CLI::App& root, const std::string& given) {
  return {fmt::format("lambent has no verb '{}'{}", given,
                      didYouMean(nearestWord(given, verbNames(root)))),
          "lambent --help"};
}

UsageError explain(const CommandLine& line, const CLI::ParseError& error) {
  const auto [app, words] = unplacedIn(line);
  // An option that nobody knows explains what is missing, too.
  for (const std::string& word : words)
    if (isOption(word)) return noSuchOption(*app, word);
  if (app == &line.root && !words.empty()) return noSuchVerb(line.root, words.front());
  const auto named = line.root.get_subcommands();
  return {error.what(),
          named.empty() ? "lambent --help" : "lambent " + named.front()->get_name() + " --help"};
}

}  // namespace lambent::tool
