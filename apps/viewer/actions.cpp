#include "apps/viewer/actions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lambent/view/orbit.h"
#include "lambent/view/placement.h"

namespace lambent::viewer {

namespace {

constexpr double kStep = 10.0 * kPi / 180.0;  // of an arrow key
constexpr int kShift = GLFW_MOD_SHIFT, kCtrl = GLFW_MOD_CONTROL;
using Choice = std::optional<transfer::Kind>;

void orbit(Session& session, const PixelSize& picture, double azimuth, double elevation) {
  view::LookAt& hand = session.hand(picture);
  hand = view::orbited(hand, azimuth * kStep, elevation * kStep);
}

void zoom(Session& session, const PixelSize& picture, double factor) {
  const float size = session.stage.empty() ? 1.0f : session.stage.bounds(session.state).diagonal();
  view::LookAt& hand = session.hand(picture);
  hand = view::zoomed(hand, factor, Vec2::Zero(), 0.01 * double(size), 100.0 * double(size));
}

void turnObject(Session& session, const PixelSize& picture, int column, double steps) {
  const Vec3 axis =
      session.stage.camera(session.state, picture).worldFromCamera.block<3, 1>(0, column);
  session.turnObject(axis.cast<double>().normalized(), steps * kStep);
}

void turnEnvironment(Session& session, const PixelSize& picture, int column, double steps) {
  const Vec3 right = session.stage.camera(session.state, picture).worldFromCamera.block<3, 1>(0, 0);
  session.turnEnvironment(column == 1 ? Vec3d(Vec3d::UnitY()) : right.cast<double>().normalized(),
                          steps * kStep);
}

/// By so many minutes, within the day.
void shiftTime(Session& session, int minutes) {
  if (!session.sky() || !byMoment(*session.sky()))
    return session.notices.remark("there is no sky of a moment: the panel's Sky makes one");
  sky::SkyRequest request = *session.sky();
  setMinute(request, minuteOf(request) + minutes);
  session.showSky(request);
}

void choose(Session& session, Choice choice, bool offered, std::string_view name) {
  if (offered)
    session.state.transfer = choice;
  else
    session.notices.remark(fmt::format("this asset has no {} transfer of its own", name));
}

void cycleWindow(Session& session, const PixelSize&) {
  const std::vector<std::string> windows = {"auto", "none", "hann", "lanczos", "minimal"};
  const auto now = std::find(windows.begin(), windows.end(), session.state.window);
  const std::size_t next = now == windows.end() ? 0 : std::size_t(now - windows.begin() + 1);
  session.state.window = windows[next % windows.size()];
  session.notices.remark("window: " + session.state.window);
}

std::vector<Action> makeActions() {
  using S = Session&;
  using P = const PixelSize&;
  const std::string_view view = "View", light = "Light", object = "Object", shown = "What is shown",
                         files = "Files and window";
  const auto toggle = [](auto member) {
    return [member](S s, P) { s.state.*member = !(s.state.*member); };
  };
  using What = FileQuestion::What;
  const auto ask = [](What what) { return [what](S s, P p) { s.ask(what, p); }; };
  const auto expose = [](double step) { return [step](S s, P) { s.state.exposure += step; }; };
  return {
      {"F", {GLFW_KEY_F, 0}, view, "frame the whole object", [](S s, P p) { s.frameAll(p); }},
      {"R", {GLFW_KEY_R, 0}, view, "as the file has it", [](S s, P) { s.resetView(); }},
      {"Left",
       {GLFW_KEY_LEFT, 0},
       view,
       "walk around to the left",
       [](S s, P p) { orbit(s, p, -1, 0); }},
      {"Right", {GLFW_KEY_RIGHT, 0}, view, "… to the right", [](S s, P p) { orbit(s, p, 1, 0); }},
      {"Up", {GLFW_KEY_UP, 0}, view, "… upwards", [](S s, P p) { orbit(s, p, 0, 1); }},
      {"Down", {GLFW_KEY_DOWN, 0}, view, "… downwards", [](S s, P p) { orbit(s, p, 0, -1); }},
      {"+", {GLFW_KEY_EQUAL, 0}, view, "nearer", [](S s, P p) { zoom(s, p, 0.87); }},
      {"-", {GLFW_KEY_MINUS, 0}, view, "farther", [](S s, P p) { zoom(s, p, 1 / 0.87); }},
      {"B", {GLFW_KEY_B, 0}, view, "background on and off", toggle(&view::ViewState::background)},

      {"E", {GLFW_KEY_E, 0}, light, "next environment", [](S s, P) { s.nextEnvironment(1); }},
      {"Shift+E",
       {GLFW_KEY_E, kShift},
       light,
       "previous environment",
       [](S s, P) { s.nextEnvironment(-1); }},
      {"Shift+Left",
       {GLFW_KEY_LEFT, kShift},
       light,
       "turn the environment to the left",
       [](S s, P p) { turnEnvironment(s, p, 1, 1); }},
      {"Shift+Right",
       {GLFW_KEY_RIGHT, kShift},
       light,
       "… to the right",
       [](S s, P p) { turnEnvironment(s, p, 1, -1); }},
      {"Shift+Up",
       {GLFW_KEY_UP, kShift},
       light,
       "… upwards",
       [](S s, P p) { turnEnvironment(s, p, 0, 1); }},
      {"Shift+Down",
       {GLFW_KEY_DOWN, kShift},
       light,
       "… downwards",
       [](S s, P p) { turnEnvironment(s, p, 0, -1); }},
      {"A",
       {GLFW_KEY_A, 0},
       light,
       "the environment turns by itself",
       [](S s, P) { s.desk.turnEnvironment = !s.desk.turnEnvironment; }},
      {"P",
       {GLFW_KEY_P, 0},
       light,
       "what moves around the object stands still, or goes on",
       [](S s, P) { s.desk.moveSurroundings = !s.desk.moveSurroundings; }},
      {",",
       {GLFW_KEY_COMMA, 0},
       light,
       "the sky of five minutes before",
       [](S s, P) { shiftTime(s, -5); }},
      {".", {GLFW_KEY_PERIOD, 0}, light, "… and after", [](S s, P) { shiftTime(s, 5); }},
      {"D",
       {GLFW_KEY_D, 0},
       light,
       "a disc of light at the camera",
       [](S s, P p) {
         view::Disc disc;
         view::aim(disc, s.stage.camera(s.state, p).worldFromCamera.block<3, 1>(0, 2));
         disc.radiance = Rgb::Constant(10.0f);
         s.addDisc(disc);
       }},
      {"Delete",
       {GLFW_KEY_DELETE, 0},
       light,
       "remove the chosen disc",
       [](S s, P) { s.removeDisc(s.desk.disc); }},
      {"W", {GLFW_KEY_W, 0}, light, "next window against ringing", cycleWindow},

      {"Ctrl+Left",
       {GLFW_KEY_LEFT, kCtrl},
       object,
       "turn the object to the left",
       [](S s, P p) { turnObject(s, p, 1, -1); }},
      {"Ctrl+Right",
       {GLFW_KEY_RIGHT, kCtrl},
       object,
       "… to the right",
       [](S s, P p) { turnObject(s, p, 1, 1); }},
      {"Ctrl+Up",
       {GLFW_KEY_UP, kCtrl},
       object,
       "… upwards",
       [](S s, P p) { turnObject(s, p, 0, -1); }},
      {"Ctrl+Down",
       {GLFW_KEY_DOWN, kCtrl},
       object,
       "… downwards",
       [](S s, P p) { turnObject(s, p, 0, 1); }},
      {"Shift+A",
       {GLFW_KEY_A, kShift},
       object,
       "the object turns by itself",
       [](S s, P) { s.desk.turnObject = !s.desk.turnObject; }},

      {"1",
       {GLFW_KEY_1, 0},
       shown,
       "unshadowed",
       [](S s, P) {
         choose(s, transfer::Kind::Unshadowed, s.stage.possibilities().unshadowed, "unshadowed");
       }},
      {"2",
       {GLFW_KEY_2, 0},
       shown,
       "with shadows",
       [](S s, P) {
         choose(s, transfer::Kind::Shadowed, s.stage.possibilities().shadowed, "shadowed");
       }},
      {"3",
       {GLFW_KEY_3, 0},
       shown,
       "with interreflections",
       [](S s, P) {
         choose(s, transfer::Kind::Interreflected, s.stage.possibilities().interreflected,
                "interreflected");
       }},
      {"0",
       {GLFW_KEY_0, 0},
       shown,
       "the best that the asset holds",
       [](S s, P) { s.state.transfer = Choice(); }},
      {"M",
       {GLFW_KEY_M, 0},
       shown,
       "macro-scale (meso-structure)",
       toggle(&view::ViewState::macro)},
      {"V",
       {GLFW_KEY_V, 0},
       shown,
       "view dependence (meso-structure)",
       toggle(&view::ViewState::viewDependent)},
      {"U",
       {GLFW_KEY_U, 0},
       shown,
       "base colour alone, without light",
       [](S s, P) { s.stage.unlit = !s.stage.unlit; }},
      {"L",
       {GLFW_KEY_L, 0},
       shown,
       "how the patch lies: field, singularities, seams, cuts",
       [](S s, P) {
         if (!s.stage.possibilities().mesoStructure)
           return s.notices.remark("this asset has no meso-structure");
         s.stage.overlays =
             s.stage.overlays.any() ? PatchOverlays() : PatchOverlays{true, true, true, true};
       }},
      {"]", {GLFW_KEY_RIGHT_BRACKET, 0}, shown, "brighter by a third of a stop", expose(1.0 / 3)},
      {"[", {GLFW_KEY_LEFT_BRACKET, 0}, shown, "darker by a third of a stop", expose(-1.0 / 3)},
      {"T",
       {GLFW_KEY_T, 0},
       shown,
       "filmic or linear tone",
       [](S s, P) {
         using Tone = tone::Curve;
         s.state.tone = s.state.tone == Tone::Filmic ? Tone::Linear : Tone::Filmic;
       }},

      {"O", {GLFW_KEY_O, 0}, files, "open an asset, a light or a view", ask(What::OpenAsset)},
      {"Ctrl+O", {GLFW_KEY_O, kCtrl}, files, "the same", ask(What::OpenAsset)},
      {"Shift+O", {GLFW_KEY_O, kShift}, files, "open a light", ask(What::OpenLight)},
      {"S",
       {GLFW_KEY_S, 0},
       files,
       "save the picture here, by a free name",
       [](S s, P p) { s.saveScreenshot(s.freeName(".png"), p); }},
      {"Shift+S", {GLFW_KEY_S, kShift}, files, "… where you say", ask(What::SavePicture)},
      {"Ctrl+S",
       {GLFW_KEY_S, kCtrl},
       files,
       "save the view here, by a free name",
       [](S s, P) { s.saveState(s.freeName(".json")); }},
      {"Ctrl+Shift+S", {GLFW_KEY_S, kCtrl | kShift}, files, "… where you say", ask(What::SaveView)},
      {"Tab",
       {GLFW_KEY_TAB, 0},
       files,
       "hide or show the panel",
       [](S s, P) { s.desk.panel = !s.desk.panel; }},
      {"?",
       {GLFW_KEY_SLASH, kShift},
       files,
       "this list",
       [](S s, P) { s.desk.help = !s.desk.help; }},
      {"Escape",
       {GLFW_KEY_ESCAPE, 0},
       files,
       "close what lies over it",
       [](S s, P) {
         s.desk.help = false;
         s.askNoMore();
         s.notices.putAway();
       }},
      {"Ctrl+Q", {GLFW_KEY_Q, kCtrl}, files, "quit", [](S s, P) { s.desk.quit = true; }},
  };
}

}  // namespace

std::span<const Action> actions() {
  static const std::vector<Action> all = makeActions();
  return all;
}

const Action* actionOf(const KeyPress& press) {
  for (const Action& action : actions())
    if (action.press.key == press.key && action.press.modifiers == press.modifiers) return &action;
  // '+' is Shift+= on many keyboards, and has a key of its own on the number pad.
  if (press.key == GLFW_KEY_EQUAL || press.key == GLFW_KEY_KP_ADD) return actionNamed("+");
  if (press.key == GLFW_KEY_KP_SUBTRACT) return actionNamed("-");
  return nullptr;
}

const Action* actionNamed(std::string_view keys) {
  const auto same = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
  for (const Action& action : actions())
    if (std::equal(action.keys.begin(), action.keys.end(), keys.begin(), keys.end(), same))
      return &action;
  return nullptr;
}

}  // namespace lambent::viewer
