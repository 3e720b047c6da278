#include "apps/viewer/script.h"

#include <fmt/format.h>

#include "lambent/file/atomic_file.h"

namespace lambent::viewer {

const std::string_view kScriptHelp =
    R"(Commands of a script, one a line; # begins a remark, "…" holds blanks together:
  load FILE                  an asset, and wait until it is shown
  environment SOURCE         a light, and wait
  state FILE                 a saved state, and wait
  drop FILE…                 files, as if dropped on the window, and wait
  sky KEY VALUE              of the sky that lights it, as the panel's sliders do, and wait: any
                             key of SOURCE sky:…, as time 05:40, turbidity 4, model preetham
  set NAME VALUE             exposure EV | tone filmic|linear |
                             window none|hann:W|lanczos:W|minimal |
                             transfer best|unshadowed|shadowed|interreflected | lobe EXPONENT|own |
                             sun-shadow sharp|soft | air on|off, and wait | metres-per-unit METRES |
                             samples N | shafts, macro, view-dependence, background, unlit, panel,
                             expose-sky on|off | field, singularities, seams, cuts on|off: how a
                             patch lies
  orbit AZIMUTH ELEVATION    walk around, in degrees
  pan X Y | zoom FACTOR | frame    X and Y in heights of the picture; FACTOR of the distance
  turn object|environment AXIS DEGREES     AXIS is x, y, z or X,Y,Z
  move X Y Z                 the object, in metres
  disc AZIMUTH ELEVATION DIAMETER RADIANCE     a disc of light, in degrees; RADIANCE N or R,G,B
  remove-disc N              the N-th, from 1
  animate object|environment on|off     1 degree a frame
  drag sky KEY VALUE         as `sky`, without waiting for it: what is shown stays until it is made
  drag orbit|pan|environment|object|move X Y     what the mouse does, in heights of the picture
  wheel NOTCHES X Y          over a point of the picture, from its middle
  key KEY                    as on the keyboard: F, Shift+E, Ctrl+S, Left, ?
  resize WIDTHxHEIGHT        the window
  wait N                     let N frames pass
  settle                     wait until the picture is smooth
  screenshot FILE.png [WIDTHxHEIGHT]    the picture, of its own size or another
  screenshot-window FILE.png the window with all that lies over it
  save-state FILE
  report                     one line of JSON: frame times, memory, OpenGL objects alive
  expect-error TEXT          the message that the last command left holds this; put it away
  expect-discs N             so many discs there are
  await-dialog               wait until the desktop's file dialog has answered, and what it named
                             is there
  expect-question TEXT       the window itself asks for a file, and says this; leave it unanswered
  answer FILE                what would be typed there, and wait
  repeat N … end             do what is between N times
  quit
)";

namespace {

struct Form {
  std::string_view name;
  std::size_t least, most;
  std::string_view usage;
};

constexpr std::size_t kAny = 1000;

constexpr Form kForms[] = {
    {"load", 1, 1, "load FILE"},
    {"environment", 1, 1, "environment SOURCE"},
    {"state", 1, 1, "state FILE"},
    {"drop", 1, kAny, "drop FILE…"},
    {"sky", 2, 2, "sky KEY VALUE"},
    {"set", 2, 2, "set NAME VALUE"},
    {"orbit", 2, 2, "orbit AZIMUTH ELEVATION"},
    {"pan", 2, 2, "pan X Y"},
    {"zoom", 1, 1, "zoom FACTOR"},
    {"frame", 0, 0, "frame"},
    {"turn", 3, 3, "turn object|environment AXIS DEGREES"},
    {"move", 3, 3, "move X Y Z"},
    {"disc", 4, 4, "disc AZIMUTH ELEVATION DIAMETER RADIANCE"},
    {"remove-disc", 1, 1, "remove-disc N"},
    {"animate", 2, 2, "animate object|environment on|off"},
    {"drag", 3, 3, "drag orbit|pan|environment|object|move X Y, or drag sky KEY VALUE"},
    {"wheel", 3, 3, "wheel NOTCHES X Y"},
    {"key", 1, 1, "key KEY"},
    {"resize", 1, 1, "resize WIDTHxHEIGHT"},
    {"wait", 1, 1, "wait N"},
    {"settle", 0, 0, "settle"},
    {"screenshot", 1, 2, "screenshot FILE.png [WIDTHxHEIGHT]"},
    {"screenshot-window", 1, 1, "screenshot-window FILE.png"},
    {"save-state", 1, 1, "save-state FILE"},
    {"report", 0, 0, "report"},
    {"expect-error", 1, 1, "expect-error TEXT"},
    {"expect-discs", 1, 1, "expect-discs N"},
    {"await-dialog", 0, 0, "await-dialog"},
    {"expect-question", 1, 1, "expect-question TEXT"},
    {"answer", 1, 1, "answer FILE"},
    {"repeat", 1, 1, "repeat N … end"},
    {"end", 0, 0, "end"},
    {"quit", 0, 0, "quit"},
};

Error wrong(const std::string& name, int line, std::string_view what) {
  return report::badInput(fmt::format("{}:{}: {}", name, line, what));
}

/// Words of a line up to '#'; false if a quotation mark is left open.
bool split(std::string_view line, std::vector<std::string>& words) {
  bool inWord = false, quoted = false;
  for (const char c : line) {
    if (c == '"') {
      if (!inWord) words.emplace_back();
      inWord = true, quoted = !quoted;
    } else if (!quoted && c == '#' && !inWord) {
      return true;
    } else if (!quoted && (c == ' ' || c == '\t' || c == '\r')) {
      inWord = false;
    } else {
      if (!inWord) words.emplace_back();
      inWord = true;
      words.back() += c;
    }
  }
  return !quoted;
}

}  // namespace

Result<Script> parseScript(std::string_view text, const std::string& name) {
  Script script{name, {}};
  std::vector<std::size_t> open;  // repeats that wait for their end
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ScriptCommand command{++line, {}, 0};
    if (!split(text.substr(at, end - at), command.words))
      return wrong(name, line, "a quotation mark is left open");
    at = end + 1;
    if (command.words.empty()) continue;
    const Form* form = nullptr;
    for (const Form& each : kForms)
      if (each.name == command.words[0]) form = &each;
    if (!form)
      return wrong(
          name, line,
          fmt::format("'{}' is not a command; 'lambent view --help' lists them", command.words[0]));
    const std::size_t arguments = command.words.size() - 1;
    if (arguments < form->least || arguments > form->most)
      return wrong(name, line, fmt::format("write it as: {}", form->usage));
    const std::size_t index = script.commands.size();
    if (form->name == "repeat") open.push_back(index);
    if (form->name == "end") {
      if (open.empty()) return wrong(name, line, "this 'end' has no 'repeat'");
      command.jump = open.back();
      script.commands[open.back()].jump = index;
      open.pop_back();
    }
    script.commands.push_back(std::move(command));
  }
  if (!open.empty())
    return wrong(name, script.commands[open.back()].line, "this 'repeat' has no 'end'");
  return script;
}

std::vector<ScriptFile> filesOf(const Script& script) {
  using Use = ScriptFile::Use;
  constexpr std::pair<std::string_view, Use> kUses[] = {
      {"load", Use::Asset},         {"environment", Use::Source},
      {"state", Use::State},        {"drop", Use::Any},
      {"screenshot", Use::Written}, {"screenshot-window", Use::Written},
      {"save-state", Use::Written}};
  std::vector<ScriptFile> files;
  for (const ScriptCommand& command : script.commands)
    for (const auto& [word, use] : kUses) {
      if (command.words[0] != word) continue;
      const std::size_t end = use == Use::Any ? command.words.size() : 2;
      for (std::size_t i = 1; i < end; ++i) files.push_back({command.line, use, command.words[i]});
    }
  return files;
}

Result<Script> readScript(const std::filesystem::path& path) {
  const auto bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return parseScript({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

}  // namespace lambent::viewer
