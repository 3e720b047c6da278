#include "apps/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>

#include "apps/viewer/actions.h"
#include "apps/viewer/canvas.h"
#include "apps/viewer/gestures.h"
#include "apps/viewer/panels.h"
#include "apps/viewer/script_runner.h"
#include "apps/viewer/user_interface.h"
#include "lambent/image/io.h"

namespace lambent::viewer {

namespace {

/// Everything that lives as long as the window. Members go in reverse: what holds OpenGL objects
/// before the window with their context.
struct Viewer {
  GlWindow window;
  UserInterface interface;
  Canvas canvas;
  FrameTimes times;
  Panels panels;
  Session session;
  std::optional<ScriptRunner> script;

  std::string title;
  bool vsync = true;
  int lively = 0;  ///< frames that are drawn though nothing seems to change
  std::chrono::steady_clock::time_point before = std::chrono::steady_clock::now();

  explicit Viewer(GlWindow w) : window(std::move(w)), interface(window) {}

  Status run();
  Status frame();
  double rest();
  void animate(double seconds);
  void takeInput(const Layout& layout);
};

/// ImGui answers a click one frame later, and its fades and hovers in the next.
constexpr int kLively = 4;

/// Sleeps while there is nothing to draw. Returns the time since the last frame, in seconds.
double Viewer::rest() {
  const bool scripted = script.has_value();
  const Desk& desk = session.desk;
  const bool moves = desk.moveSurroundings && session.stage.hasSurroundings();
  const bool still = !desk.turnEnvironment && !desk.turnObject && !moves &&
                     (session.stage.empty() || session.stage.settled());
  if (scripted || !still || lively > 0) {
    window.poll();
    lively = std::max(lively - 1, 0);
  } else {
    // Files that are being read and remarks that fade want a look now and then.
    const bool watching =
        session.busy() || session.fileDialog.waiting() || !session.notices.remarks().empty();
    const double longest = watching ? 0.05 : 0.5;
    const auto asleep = std::chrono::steady_clock::now();
    window.wait(longest);
    const std::chrono::duration<double> slept = std::chrono::steady_clock::now() - asleep;
    if (slept.count() < 0.9 * longest) lively = kLively;  // something woke us
  }
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - before).count();
  before = now;
  return scripted ? 1.0 / 60.0 : std::min(seconds, 0.1);
}

void Viewer::animate(double seconds) {
  // A script counts in frames: one degree each.
  const double degrees = script ? 1.0 : 24.0 * seconds;
  if (session.desk.turnEnvironment) session.turnEnvironment(Vec3d::UnitY(), degrees * kPi / 180.0);
  if (session.desk.moveSurroundings) session.stage.elapse(seconds);
  if (session.desk.turnObject) session.turnObject(Vec3d::UnitY(), degrees * kPi / 180.0);
}

void Viewer::takeInput(const Layout& layout) {
  for (const auto& path : window.takeDropped()) session.open(path);
  const std::vector<KeyPress> keys = window.takeKeys();
  const bool typing = ImGui::GetIO().WantTextInput;
  for (const KeyPress& press : keys) {
    const bool enter = press.key == GLFW_KEY_ENTER || press.key == GLFW_KEY_KP_ENTER;
    if (enter && session.notices.current()) session.notices.putAway();
    const Action* action = actionOf(press);
    if (action && (!typing || press.key == GLFW_KEY_ESCAPE)) action->run(session, layout.picture);
  }
  followMouse(session, layout);
}

Status Viewer::frame() {
  animate(rest());
  session.notices.pass(script ? 1.0 / 60.0 : ImGui::GetIO().DeltaTime);
  session.collect();
  Layout layout = layOut(window, session.desk.panel);
  if (layout.pixels.width < 1 || layout.pixels.height < 1) return Status::ok();  // minimised
  if (script)
    if (Status s = script->advance(session, window, times, layout); !s) return s;

  interface.begin(layout.scale);
  takeInput(layout);
  layout = layOut(window, session.desk.panel);
  panels.draw(session, times, layout);

  if (Status s = canvas.resize(layout.pixels, layout.picture); !s) return s;
  const bool resting = session.stage.settled();
  if (!session.stage.empty()) {
    times.begin();
    Status drawn = session.stage.draw(session.state, layout.picture);
    if (drawn) drawn = session.stage.present(canvas.pictureFramebuffer(), session.state);
    times.end(!resting || !session.stage.settled());
    if (!drawn) return drawn;
  }
  canvas.beginOver(!session.stage.empty());
  interface.end();
  if (script)
    if (const auto path = script->takeWindowShot())
      session.notices.check(image::write(canvas.read(), *path));
  canvas.toWindow();
  if (vsync != session.desk.vsync) window.setVsync(vsync = session.desk.vsync);
  window.swap();

  const std::string wanted =
      session.stage.empty() ? "Lambent"
                            : fmt::format("{} – Lambent", session.stage.path().filename().string());
  if (title != wanted) window.setTitle(title = wanted);
  return Status::ok();
}

Status Viewer::run() {
  while (!window.closing() && !session.desk.quit) {
    if (Status s = frame(); !s) return s;
    if (script && script->finished() && !session.notices.current()) break;
  }
  return Status::ok();
}

/// The files of the command line. What is wrong with one ends the viewer: whoever typed its name is
/// at the terminal.
Status openFirst(Viewer& viewer, const ViewerOptions& options) {
  Session& session = viewer.session;
  session.environments = options.environments;
  session.allow(options.reading);
  session.findLightsBy(options.findLights);
  session.fileDialog.setWindow(viewer.window.portalName());
  if (!options.environments.empty()) session.openEnvironment(options.environments.front());
  if (!options.asset.empty()) session.openAsset(options.asset);
  // The state last: it is meant for this asset.
  const auto waitForFiles = [&]() -> Status {
    while (session.busy() && !viewer.window.closing()) {
      if (Status s = viewer.frame(); !s) return s;
      if (const Error* error = session.notices.current()) return *error;
    }
    session.collect();
    if (const Error* error = session.notices.current()) return *error;
    return Status::ok();
  };
  if (Status s = waitForFiles(); !s) return s;
  if (options.state.empty()) return Status::ok();
  session.openState(options.state);
  return waitForFiles();
}

}  // namespace

Status view(ViewerOptions options) {
  WindowOptions windowOptions = options.window;
  windowOptions.vsync = windowOptions.vsync && !options.script;
  Result<GlWindow> window = GlWindow::open(windowOptions);
  if (!window) return window.error();
  Viewer viewer(std::move(*window));
  viewer.vsync = viewer.session.desk.vsync = windowOptions.vsync;
  viewer.session.desk.panel = options.panel;
  viewer.session.desk.exposeSky = !options.script;  // a script sets what it wants
  if (options.surroundings)
    if (Status s = viewer.session.stage.setSurroundings(std::move(options.surroundings)); !s)
      return s;
  if (Status s = openFirst(viewer, options); !s) return s;
  if (options.script) viewer.script.emplace(std::move(*options.script), options.print);
  return viewer.run();
}

}  // namespace lambent::viewer
