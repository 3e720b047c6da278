#include "apps/viewer/script_runner.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <fstream>

#include "apps/viewer/actions.h"
#include "apps/viewer/gestures.h"
#include "apps/viewer/panels.h"
#include "lambent/light/windowing.h"
#include "lambent/render/gl_objects.h"
#include "lambent/view/orbit.h"

namespace lambent::viewer {

namespace {

using report::badInput;

/// Coordinates and whatever has no range of its own: beyond, the square of a float is none.
constexpr double kMost = 1e15;
/// Angles, and pictures' heights: what a float tells apart after the motion.
constexpr double kFurthest = 1e6;

Result<double> number(const std::string& text, double most = kMost) {
  double value = 0.0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value))
    return badInput(fmt::format("'{}' is not a number", text));
  if (std::abs(value) > most)
    return badInput(fmt::format("'{}' is not a number from {:g} to {:g}", text, -most, most));
  return value;
}

Result<long> count(const std::string& text) {
  const Result<double> value = number(text);
  if (!value || *value < 0.0 || *value != std::floor(*value) || *value > 1e9)
    return badInput(fmt::format("'{}' is not a whole number from 0", text));
  return long(*value);
}

/// Numbers from the word at `first` on.
Result<std::vector<double>> numbers(const ScriptCommand& command, std::size_t first, double most) {
  std::vector<double> values;
  for (std::size_t i = first; i < command.words.size(); ++i) {
    const Result<double> value = number(command.words[i], most);
    if (!value) return value.error();
    values.push_back(*value);
  }
  return values;
}

/// "1,2,3", or "1" for three times the same.
Result<Vec3d> triple(const std::string& text) {
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const Result<double> value = number(text.substr(at, end - at));
    if (!value) return value.error();
    values.push_back(*value);
    at = end + 1;
  }
  if (values.size() == 1) return Vec3d(Vec3d::Constant(values[0]));
  if (values.size() != 3) return badInput(fmt::format("'{}' is not X,Y,Z", text));
  return Vec3d(values[0], values[1], values[2]);
}

Result<Vec3d> axis(const std::string& text) {
  if (text == "x") return Vec3d(Vec3d::UnitX());
  if (text == "y") return Vec3d(Vec3d::UnitY());
  if (text == "z") return Vec3d(Vec3d::UnitZ());
  const Result<Vec3d> given = triple(text);
  if (!given || !(given->norm() > 0.0))
    return badInput(fmt::format("'{}' is not an axis: x, y, z or X,Y,Z", text));
  return Vec3d(given->normalized());
}

Result<PixelSize> pixelSize(const std::string& text) {
  const std::size_t cross = text.find('x');
  const Result<long> width = count(text.substr(0, cross));
  const Result<long> height = cross == text.npos ? width : count(text.substr(cross + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > 16384 || *height > 16384)
    return badInput(fmt::format("'{}' is not a size: WIDTHxHEIGHT, as 800x600", text));
  return PixelSize{int(*width), int(*height)};
}

Result<bool> onOff(const std::string& text) {
  if (text == "on") return true;
  if (text == "off") return false;
  return badInput(fmt::format("'{}' is neither on nor off", text));
}

/// What a `drag` or `wheel` says.
Result<Gesture> gestureOf(const ScriptCommand& command) {
  using Kind = Gesture::Kind;
  constexpr std::pair<std::string_view, Kind> kKinds[] = {{"orbit", Kind::Orbit},
                                                          {"pan", Kind::Pan},
                                                          {"environment", Kind::TurnEnvironment},
                                                          {"object", Kind::TurnObject},
                                                          {"move", Kind::MoveObject}};
  const bool wheel = command.words[0] == "wheel";
  const auto given = numbers(command, wheel ? 1 : 2, kFurthest);
  if (!given) return given.error();
  if (wheel) {
    const Vec2 at = Vec2d((*given)[1], (*given)[2]).cast<float>();
    return Gesture{Kind::Zoom, Vec2::Zero(), at, float((*given)[0])};
  }
  for (const auto& [name, kind] : kKinds)
    if (command.words[1] == name)
      return Gesture{kind, Vec2(float((*given)[0]), float((*given)[1])), Vec2::Zero(), 0.0f};
  return badInput(fmt::format("'{}' is not dragged: orbit, pan, environment, object, move or sky",
                              command.words[1]));
}

/// Bytes of this process that are in memory.
std::size_t residentBytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * std::size_t(sysconf(_SC_PAGESIZE));
}

std::string reportLine(long frames, const FrameTimes& times) {
  using namespace render;
  const FrameTime median = times.median();
  return fmt::format(
      "{{\"frames\": {}, \"gpu_ms\": {:.4f}, \"cpu_ms\": {:.4f}, \"resident_bytes\": {}, "
      "\"gl_objects\": {{\"buffers\": {}, \"textures\": {}, \"framebuffers\": {}, "
      "\"vertex_arrays\": {}, \"programs\": {}, \"shaders\": {}}}}}",
      frames, median.gpu, median.cpu, residentBytes(), Buffer::alive(), Texture::alive(),
      Framebuffer::alive(), VertexArray::alive(), GlObject<DeleteProgram>::alive(),
      GlObject<DeleteShader>::alive());
}

/// What may be done while a message is shown, so that it can be looked at.
bool leavesMessages(const std::string& command) {
  return command == "expect-error" || command == "wait" || command == "settle" ||
         command == "screenshot" || command == "screenshot-window" || command == "report" ||
         command == "end";
}

}  // namespace

struct ScriptRunner::Scene {
  Session& session;
  GlWindow& window;
  FrameTimes& times;
  const Layout& layout;
};

ScriptRunner::ScriptRunner(Script script, std::function<void(const std::string&)> print)
    : script_(std::move(script)), print_(std::move(print)) {}

Status ScriptRunner::advance(Session& session, GlWindow& window, FrameTimes& times,
                             const Layout& layout) {
  ++frames_;
  Scene scene{session, window, times, layout};
  for (;;) {
    const Error* problem = session.notices.current();
    if (problem && !begun_ && (finished() || !leavesMessages(script_.commands[at_].words[0])))
      return Error{problem->kind,
                   fmt::format("{}:{}: {}", script_.name, lastLine_, problem->message)};
    if (finished()) return Status::ok();
    const ScriptCommand& command = script_.commands[at_];
    lastLine_ = command.line;
    const std::size_t here = at_;
    const Result<Step> step = run(command, scene);
    if (!step)
      return Error{step.error().kind,
                   fmt::format("{}:{}: {}", script_.name, command.line, step.error().message)};
    if (*step == Step::Again) {
      begun_ = true;
      ++waited_;
      return Status::ok();
    }
    begun_ = false;
    waited_ = 0;
    if (at_ == here) ++at_;
    // With the panel the picture changes its size, which the next command goes by.
    const bool divided = session.desk.panel == (layout.panel > 0);
    if (*step == Step::DoneAfterFrame || !divided || session.desk.quit) return Status::ok();
  }
}

Result<ScriptRunner::Step> ScriptRunner::runFile(const ScriptCommand& command, Scene& scene) {
  Session& session = scene.session;
  if (!begun_) {
    const std::string& name = command.words[0];
    if (name == "load") session.openAsset(command.words[1]);
    if (name == "environment") session.openEnvironment(command.words[1]);
    if (name == "state") session.openState(command.words[1]);
    if (name == "drop")
      for (std::size_t i = 1; i < command.words.size(); ++i) session.open(command.words[i]);
  }
  return session.busy() ? Step::Again : Step::Done;
}

Result<ScriptRunner::Step> ScriptRunner::runSky(const ScriptCommand& command, Session& session) {
  if (!begun_) {
    sky::SkyRequest request = session.sky().value_or(firstSky());
    const std::size_t last = command.words.size() - 1;
    if (Status s = change(request, command.words[last - 1], command.words[last]); !s)
      return badInput(s.error().message);
    session.showSky(request);
    if (command.words[0] == "drag") return Step::DoneAfterFrame;
  }
  return session.busy() ? Step::Again : Step::Done;
}

namespace {

/// set air, shafts, metres-per-unit.
Status setAir(const std::string& name, const std::string& value,
              std::optional<view::AirShown>& air) {
  if (name != "air" && !air) return badInput("there is no air: 'set air on' first");
  if (name == "metres-per-unit") {
    const Result<double> given = number(value);
    if (!given) return given.error();
    if (!(*given >= shade::kLeastMetresPerUnit && *given <= shade::kMostMetresPerUnit))
      return badInput(fmt::format("'{}' metres: from {:g} to {:g}", value,
                                  shade::kLeastMetresPerUnit, shade::kMostMetresPerUnit));
    air->metresPerUnit = *given;
    return Status::ok();
  }
  const Result<bool> on = onOff(value);
  if (!on) return on.error();
  if (name == "shafts")
    air->shafts = *on;
  else if (*on != air.has_value())
    air = *on ? std::optional<view::AirShown>(std::in_place) : std::nullopt;
  return Status::ok();
}

}  // namespace

Status ScriptRunner::set(const std::string& name, const std::string& value, Scene& scene) {
  view::ViewState& state = scene.session.state;
  PatchOverlays& overlays = scene.session.stage.overlays;
  const std::pair<const char*, bool*> switches[] = {{"macro", &state.macro},
                                                    {"view-dependence", &state.viewDependent},
                                                    {"background", &state.background},
                                                    {"unlit", &scene.session.stage.unlit},
                                                    {"field", &overlays.field},
                                                    {"singularities", &overlays.singularities},
                                                    {"seams", &overlays.seams},
                                                    {"cuts", &overlays.cuts},
                                                    {"panel", &scene.session.desk.panel},
                                                    {"expose-sky", &scene.session.desk.exposeSky}};
  for (const auto& [each, target] : switches) {
    if (name != each) continue;
    const Result<bool> on = onOff(value);
    if (!on) return on.error();
    *target = *on;
    return Status::ok();
  }
  if (name == "air" || name == "shafts" || name == "metres-per-unit")
    return setAir(name, value, state.air);
  if (name == "tone") {
    if (value != "filmic" && value != "linear")
      return badInput(fmt::format("'{}' is neither filmic nor linear", value));
    using Tone = tone::Curve;
    state.tone = value == "filmic" ? Tone::Filmic : Tone::Linear;
    return Status::ok();
  }
  if (name == "sun-shadow") {
    if (value != "sharp" && value != "soft")
      return badInput(fmt::format("'{}' is neither sharp nor soft", value));
    using Shadow = shade::SunShadow;
    state.sunShadow = value == "sharp" ? Shadow::Sharp : Shadow::Soft;
    return Status::ok();
  }
  if (name == "window") {
    if (const auto windowing = light::parseWindowing(value); !windowing)
      return badInput(windowing.error().message);
    state.window = value;
    return Status::ok();
  }
  if (name == "transfer") {
    const auto choice = shade::choiceNamed(value);
    if (!choice)
      return badInput(
          fmt::format("'{}' is not best, unshadowed, shadowed or interreflected", value));
    state.transfer = *choice;
    return Status::ok();
  }
  if (name == "lobe" && value == "own") {
    state.lobe.reset();
    return Status::ok();
  }
  if (name != "exposure" && name != "lobe" && name != "samples")
    return badInput(fmt::format("'{}' cannot be set; 'lambent view --help' lists what can", name));
  const Result<double> given = number(value);
  if (!given) return given.error();
  if (name == "exposure" && std::abs(*given) > 60.0)
    return badInput(fmt::format("the exposure is {}; it must be from -60 to 60", value));
  if (name == "exposure") state.exposure = *given;
  if (name == "lobe" && !(*given >= 0.0 && *given <= 1e5))
    return badInput(fmt::format("the lobe's exponent is {}; it must be from 0 to 100000", value));
  if (name == "lobe") state.lobe = *given;
  if (name == "samples") {
    if (!(*given >= 1 && *given <= 4096) || *given != std::floor(*given))
      return badInput(fmt::format("'{}' samples: a whole number from 1 to 4096", value));
    state.samples = int(*given);
  }
  return Status::ok();
}

Status ScriptRunner::expectError(const std::string& text, Session& session) const {
  const Error* problem = session.notices.current();
  if (!problem) return report::failed(fmt::format("there was no error that says '{}'", text));
  if (problem->message.find(text) == std::string::npos)
    return report::failed(
        fmt::format("the error does not say '{}' but: {}", text, problem->message));
  session.notices.putAway();
  return Status::ok();
}

Status ScriptRunner::expectQuestion(const std::string& text, Session& session) const {
  const auto& own = session.ownQuestion();
  if (!own) return report::failed("the window does not ask for a file");
  const std::string words = wordsOf(*own);
  if (words.find(text) == std::string::npos)
    return report::failed(fmt::format("it does not say '{}' but: {}", text, words));
  session.askNoMore();
  return Status::ok();
}

Result<ScriptRunner::Step> ScriptRunner::run(const ScriptCommand& command, Scene& scene) {
  Session& session = scene.session;
  const std::string& name = command.words[0];
  const auto word = [&](std::size_t i) -> const std::string& { return command.words[i]; };
  const auto done = [](const Status& status) -> Result<Step> {
    return status ? Result<Step>(Step::Done) : Result<Step>(status.error());
  };

  if (name == "load" || name == "environment" || name == "state" || name == "drop")
    return runFile(command, scene);
  if (name == "sky" || (name == "drag" && word(1) == "sky")) return runSky(command, session);
  if (name == "await-dialog")
    return session.fileDialog.waiting() || session.busy() ? Step::Again : Step::Done;
  if (name == "expect-question") return done(expectQuestion(word(1), session));
  if (name == "answer") {
    if (!begun_ && !session.ownQuestion())
      return report::failed("the window does not ask for a file");
    if (!begun_) session.answerOwn(word(1));
    return session.busy() ? Step::Again : Step::Done;
  }
  if (name == "set") {
    if (!begun_)
      if (Status s = set(word(1), word(2), scene); !s) return s.error();
    if (word(1) != "air") return Step::Done;
    session.seekAir();
    return session.busy() ? Step::Again : Step::Done;
  }
  if (name == "frame") session.frameAll(scene.layout.picture);
  if (name == "orbit" || name == "pan" || name == "zoom" || name == "move") {
    const auto given = numbers(command, 1, name == "move" ? kMost : kFurthest);
    if (!given) return given.error();
    if (name == "move") {
      session.state.objectTranslation += Vec3d((*given)[0], (*given)[1], (*given)[2]).cast<float>();
      return Step::Done;
    }
    view::LookAt& hand = session.hand(scene.layout.picture);
    if (name == "orbit")
      hand = view::orbited(hand, (*given)[0] * kPi / 180.0, (*given)[1] * kPi / 180.0);
    if (name == "pan") hand = view::panned(hand, Vec2(float((*given)[0]), float((*given)[1])));
    if (name == "zoom") {
      if (!((*given)[0] > 0.0)) return badInput("the factor must be above 0");
      hand = view::zoomed(hand, (*given)[0], Vec2::Zero(), 1e-9, 1e9);
    }
  }
  if (name == "turn") {
    const auto about = axis(word(2));
    const auto degrees = number(word(3), kFurthest);
    if (!about) return about.error();
    if (!degrees) return degrees.error();
    const double radians = *degrees * kPi / 180.0;
    if (word(1) == "object")
      session.turnObject(*about, radians);
    else if (word(1) == "environment")
      session.turnEnvironment(*about, radians);
    else
      return badInput(fmt::format("'{}' does not turn: object or environment", word(1)));
  }
  if (name == "disc") {
    const auto azimuth = number(word(1), kFurthest), elevation = number(word(2)),
               diameter = number(word(3));
    const auto radiance = triple(word(4));
    for (const auto* each : {&azimuth, &elevation, &diameter})
      if (!*each) return each->error();
    if (!radiance) return radiance.error();
    if (!(*diameter > 0.0 && *diameter <= 360.0) || std::abs(*elevation) > 90.0 ||
        radiance->minCoeff() < 0.0)
      return badInput("a disc is 0 to 360 degrees wide, -90 to 90 high, and not darker than black");
    session.addDisc({*azimuth, *elevation, *diameter, radiance->cast<float>().array()});
  }
  if (name == "remove-disc" || name == "expect-discs") {
    const auto given = count(word(1));
    if (!given) return given.error();
    const long discs = long(session.state.discs.size());
    if (name == "expect-discs" && *given != discs)
      return report::failed(fmt::format("there are {} discs", discs));
    if (name == "remove-disc" && (*given < 1 || *given > discs))
      return badInput(fmt::format("there is no disc {}; there are {}", *given, discs));
    if (name == "remove-disc") session.removeDisc(int(*given) - 1);
  }
  if (name == "animate") {
    const auto on = onOff(word(2));
    if (!on) return on.error();
    if (word(1) != "object" && word(1) != "environment")
      return badInput(fmt::format("'{}' does not move: object or environment", word(1)));
    (word(1) == "object" ? session.desk.turnObject : session.desk.turnEnvironment) = *on;
  }
  if (name == "drag" || name == "wheel") {
    const auto gesture = gestureOf(command);
    if (!gesture) return gesture.error();
    apply(session, *gesture, scene.layout.picture);
  }
  if (name == "key") {
    const Action* action = actionNamed(word(1));
    if (!action) return badInput(fmt::format("no key '{}' does anything", word(1)));
    action->run(session, scene.layout.picture);
    if (session.busy()) return Step::DoneAfterFrame;
  }
  if (name == "resize") {
    const auto size = pixelSize(word(1));
    if (!size) return size.error();
    if (!begun_) scene.window.resize(*size);
    // The window system has the last word; it is asked for a while, not for ever.
    return scene.window.size() == *size || waited_ > 200 ? Step::DoneAfterFrame : Step::Again;
  }
  if (name == "wait") {
    const auto frames = count(word(1));
    if (!frames) return frames.error();
    return waited_ < *frames ? Step::Again : Step::Done;
  }
  if (name == "settle")
    return session.stage.settled() || waited_ > 100000 ? Step::Done : Step::Again;
  if (name == "screenshot") {
    PixelSize size = scene.layout.picture;
    if (command.words.size() > 2) {
      const auto given = pixelSize(word(2));
      if (!given) return given.error();
      size = *given;
    }
    session.saveScreenshot(word(1), size);
  }
  if (name == "screenshot-window") {
    if (!begun_) {
      if (std::filesystem::path(word(1)).extension() != ".png")
        return badInput(fmt::format("{} must end in .png", word(1)));
      shot_ = word(1);
      return Step::Again;
    }
  }
  if (name == "save-state") session.saveState(word(1));
  if (name == "report") print_(reportLine(frames_, scene.times));
  if (name == "expect-error") return done(expectError(word(1), session));
  if (name == "repeat") {
    const auto rounds = count(word(1));
    if (!rounds) return rounds.error();
    const auto [left, isNew] = left_.try_emplace(at_, *rounds);
    if (left->second-- > 0) return Step::Done;
    left_.erase(left);
    at_ = command.jump + 1;
  }
  if (name == "end") at_ = command.jump;
  if (name == "quit") session.desk.quit = true;
  return Step::Done;
}

}  // namespace lambent::viewer
