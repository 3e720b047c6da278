// lambent help [VERB], lambent completion SHELL
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/lambent/arguments.h"
#include "apps/lambent/command_line.h"
#include "apps/lambent/completion.h"
#include "apps/lambent/help.h"
#include "apps/lambent/manual.h"
#include "apps/lambent/standard_streams.h"
#include "apps/lambent/verbs.h"

namespace lambent::tool {

namespace {

struct HelpRequest {
  std::string verb;
  bool man = false;
  std::filesystem::path folder;
  const CLI::App* root = nullptr;
};

constexpr std::string_view kHelpExamples = R"(Examples:
  lambent help bake             the same as 'lambent bake --help'
  lambent help bake --man | man -l -
  lambent help --man-pages /usr/local/share/man/man1
      Where an installation does it by itself.
)";

constexpr std::string_view kCompletionExamples = R"(Examples:
  source <(lambent completion bash)
      In this bash; in every new one if ~/.bashrc has that line.
  lambent completion zsh > ~/.zsh/_lambent
      Into a folder of $fpath.
  lambent completion fish > ~/.config/fish/completions/lambent.fish
)";

Status runHelp(const HelpRequest& request) {
  const CLI::App* verb = nullptr;
  for (const CLI::App* each : verbsOf(*request.root))
    if (each->get_name() == request.verb) verb = each;
  if (!verb && !request.verb.empty())
    return badUsage(noSuchVerb(*request.root, request.verb).message);
  if (!request.folder.empty()) return written(writeManual(*request.root, request.folder));
  if (request.man) return print(manualPage(*request.root, verb));
  return print(helpOf(verb ? *verb : *request.root));
}

}  // namespace

Verb addHelp(CLI::App& root, ConsoleOptions&) {
  auto request = std::make_shared<HelpRequest>();
  request->root = &root;
  CLI::App* app = root.add_subcommand("help", "Explain the tool or one of its verbs");
  app->group("Verbs");
  app->footer(std::string(kHelpExamples));
  std::string names;
  for (const std::string& name : verbNames(root)) names += name + ",";
  app->add_option("VERB", request->verb, "The verb to explain; without it: all of them in short")
      ->type_name("{" + names + "completion}");  // for completions
  CLI::Option* man = app->add_flag("--man", request->man, "As a manual page, for 'man -l -'");
  app->add_option("--man-pages", request->folder, "Write all manual pages to a folder")
      ->option_text("DIR")
      ->excludes(man);
  return {app, [request](Console&) { return runHelp(*request); }};
}

Verb addCompletion(CLI::App& root, ConsoleOptions&) {
  auto shell = std::make_shared<Shell>(Shell::Bash);
  CLI::App* app = root.add_subcommand(
      "completion", "Print a script that lets a shell complete verbs, options and files");
  app->group("Verbs");
  app->footer(std::string(kCompletionExamples));
  addChoice(*app, "SHELL", *shell,
            {{"bash", Shell::Bash}, {"zsh", Shell::Zsh}, {"fish", Shell::Fish}},
            "bash, zsh or fish")
      ->default_str("")
      ->required();
  return {app, [shell, &root](Console&) { return print(completionFor(*shell, root)); }};
}

}  // namespace lambent::tool
