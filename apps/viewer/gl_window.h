// A window with an OpenGL 4.5 core context, by GLFW, and what a person does to it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lambent/report/result.h"

struct GLFWwindow;

namespace lambent::viewer {

struct PixelSize {
  int width = 0, height = 0;
  bool operator==(const PixelSize&) const = default;
};

struct WindowOptions {
  std::string title = "Lambent";
  PixelSize size{1280, 800};  ///< in the display's units, which are pixels unless it is scaled
  bool visible = true;
  bool vsync = true;
};

/// A key that went down: GLFW's code and modifiers.
struct KeyPress {
  int key = 0, modifiers = 0;
};

/// The context is current on the thread that opened the window, until the window goes.
class GlWindow {
 public:
  /// Failed where there is no display or no OpenGL 4.5, with the remedy.
  static Result<GlWindow> open(const WindowOptions& options);
  GlWindow(GlWindow&&) noexcept;
  GlWindow& operator=(GlWindow&&) noexcept;
  ~GlWindow();

  GLFWwindow* handle() const;
  /// As desktop portals name it: "x11:1a00007", or empty where it has no such name.
  std::string portalName() const;
  PixelSize framebufferSize() const;
  PixelSize size() const;  ///< in units of the mouse, which some displays have fewer of than pixels
  /// How many of these units make what is one at 96 dpi.
  float contentScale() const;
  void resize(const PixelSize& size);
  bool closing() const;
  void close();
  void setTitle(const std::string& title);
  void setVsync(bool on);

  /// Takes events that are there, or waits for one for at most `seconds`.
  void poll();
  void wait(double seconds);
  void swap();

  /// What came since the last call.
  std::vector<KeyPress> takeKeys();
  std::vector<std::filesystem::path> takeDropped();
  /// The window was uncovered or changed: it wants to be drawn.
  bool takeRefresh();

 private:
  struct Impl;
  explicit GlWindow(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambent::viewer
