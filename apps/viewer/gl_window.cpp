#include "apps/viewer/gl_window.h"

#include <dlfcn.h>
#include <epoxy/gl.h>
// After epoxy, which brings the declarations of OpenGL.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lambent::viewer {

namespace {

std::string lastProblem() {
  const char* description = nullptr;
  return glfwGetError(&description) == GLFW_NO_ERROR || !description ? "no reason given"
                                                                     : description;
}

Error noDisplay() {
  return report::failed(
      fmt::format("no display ({}): run it under a desktop, as 'xvfb-run -a lambent view …', or "
                  "with --web for a page",
                  lastProblem()));
}

Error noOpenGl() {
  return report::failed(
      fmt::format("no OpenGL 4.5 core on this display ({}). Newer drivers help, or Mesa (on "
                  "Debian: libgl1-mesa-dri); --web needs WebGL2 alone",
                  lastProblem()));
}

}  // namespace

struct GlWindow::Impl {
  GLFWwindow* window = nullptr;
  std::vector<KeyPress> keys;
  std::vector<std::filesystem::path> dropped;
  bool refresh = true;

  ~Impl() {
    if (window) glfwDestroyWindow(window);
    glfwTerminate();
  }

  static Impl& of(GLFWwindow* window) {
    return *static_cast<Impl*>(glfwGetWindowUserPointer(window));
  }

  void listen() {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
      if (action == GLFW_PRESS || action == GLFW_REPEAT)
        of(w).keys.push_back({key, modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT)});
    });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
      of(w).dropped.insert(of(w).dropped.end(), paths, paths + count);
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).refresh = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).refresh = true; });
  }
};

GlWindow::GlWindow(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GlWindow::GlWindow(GlWindow&&) noexcept = default;
GlWindow& GlWindow::operator=(GlWindow&&) noexcept = default;
GlWindow::~GlWindow() = default;

Result<GlWindow> GlWindow::open(const WindowOptions& options) {
  if (!glfwInit()) return noDisplay();
  auto impl = std::make_unique<Impl>();  // from here on, glfwTerminate is due
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // pictures are drawn elsewhere and copied here
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
  impl->window = glfwCreateWindow(std::max(options.size.width, 1), std::max(options.size.height, 1),
                                  options.title.c_str(), nullptr, nullptr);
  if (!impl->window) return noOpenGl();
  impl->listen();
  glfwMakeContextCurrent(impl->window);
  GlWindow window(std::move(impl));
  window.setVsync(options.vsync);
  return window;
}

GLFWwindow* GlWindow::handle() const {
  return impl_->window;
}

std::string GlWindow::portalName() const {
  // Of GLFW's libraries the one for X11 has it; what is linked is there either way.
  using GetX11Window = unsigned long (*)(GLFWwindow*);
  const auto get = reinterpret_cast<GetX11Window>(dlsym(RTLD_DEFAULT, "glfwGetX11Window"));
  const unsigned long id = get ? get(impl_->window) : 0;
  return id ? fmt::format("x11:{:x}", id) : std::string();
}

PixelSize GlWindow::framebufferSize() const {
  PixelSize size;
  glfwGetFramebufferSize(impl_->window, &size.width, &size.height);
  return size;
}

PixelSize GlWindow::size() const {
  PixelSize size;
  glfwGetWindowSize(impl_->window, &size.width, &size.height);
  return size;
}

void GlWindow::resize(const PixelSize& size) {
  glfwSetWindowSize(impl_->window, size.width, size.height);
}

float GlWindow::contentScale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(impl_->window, &x, &y);
  // What the framebuffer is finer than the window is the display's own business; the rest is ours.
  const int width = size().width;
  const float own = width > 0 ? float(framebufferSize().width) / float(width) : 1.0f;
  return std::clamp(std::max(x, y) / std::max(own, 1.0f), 1.0f, 4.0f);
}

bool GlWindow::closing() const {
  return glfwWindowShouldClose(impl_->window);
}
void GlWindow::close() {
  glfwSetWindowShouldClose(impl_->window, GLFW_TRUE);
}
void GlWindow::setTitle(const std::string& title) {
  glfwSetWindowTitle(impl_->window, title.c_str());
}
void GlWindow::setVsync(bool on) {
  glfwSwapInterval(on ? 1 : 0);
}

void GlWindow::poll() {
  glfwPollEvents();
}
void GlWindow::wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
}
void GlWindow::swap() {
  glfwSwapBuffers(impl_->window);
}

std::vector<KeyPress> GlWindow::takeKeys() {
  return std::exchange(impl_->keys, {});
}
std::vector<std::filesystem::path> GlWindow::takeDropped() {
  return std::exchange(impl_->dropped, {});
}
bool GlWindow::takeRefresh() {
  return std::exchange(impl_->refresh, false);
}

}  // namespace lambent::viewer
