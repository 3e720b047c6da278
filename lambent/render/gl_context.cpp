#include "lambent/render/gl_context.h"

#include <string>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace lambent::render {

namespace {

constexpr const char* kRemedy =
    "Install Mesa (on Debian: libegl1 libegl-mesa0 libgl1-mesa-dri; software GL will do), or make "
    "the picture on the CPU";

std::string eglErrorName() {
  const EGLint code = eglGetError();
  switch (code) {
    case EGL_SUCCESS:
      return "no error given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    default:
      return fmt::format("EGL error {:#x}", code);
  }
}

/// Every display worth trying, best first.
std::vector<EGLDisplay> candidateDisplays() {
  std::vector<EGLDisplay> displays;
  const bool platforms = epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base");
  if (platforms && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    displays.push_back(
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (platforms && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    EGLint count = 0;
    if (eglQueryDevicesEXT(0, nullptr, &count) && count > 0) {
      std::vector<EGLDeviceEXT> devices(count);
      eglQueryDevicesEXT(count, devices.data(), &count);
      for (EGLint i = 0; i < count; ++i)
        displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
  }
  return displays;
}

}  // namespace

struct GlContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLDisplay displayBefore = EGL_NO_DISPLAY;
  EGLContext contextBefore = EGL_NO_CONTEXT;
  EGLSurface drawBefore = EGL_NO_SURFACE, readBefore = EGL_NO_SURFACE;

  ~Impl() {
    if (context == EGL_NO_CONTEXT) return;
    if (contextBefore != EGL_NO_CONTEXT)
      eglMakeCurrent(displayBefore, drawBefore, readBefore, contextBefore);
    else
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    // The display stays initialised: it belongs to the process, and other threads may be using it.
  }

  /// Empty on success, else why not.
  std::string tryDisplay(EGLDisplay candidate) {
    EGLint major = 0, minor = 0;
    if (candidate == EGL_NO_DISPLAY || !eglInitialize(candidate, &major, &minor))
      return "cannot be initialised: " + eglErrorName();
    if (!epoxy_has_egl_extension(candidate, "EGL_KHR_surfaceless_context") ||
        !epoxy_has_egl_extension(candidate, "EGL_KHR_create_context"))
      return "cannot work without a surface";
    if (!eglBindAPI(EGL_OPENGL_API)) return "has no OpenGL: " + eglErrorName();
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (!eglChooseConfig(candidate, wanted, &config, 1, &configs) || configs < 1)
      config = nullptr;  // EGL_NO_CONFIG_KHR
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    const EGLContext made = eglCreateContext(candidate, config, EGL_NO_CONTEXT, attributes);
    if (made == EGL_NO_CONTEXT) return "has no OpenGL 4.5 core: " + eglErrorName();
    if (!eglMakeCurrent(candidate, EGL_NO_SURFACE, EGL_NO_SURFACE, made)) {
      const std::string why = "context cannot be made current: " + eglErrorName();
      eglDestroyContext(candidate, made);
      return why;
    }
    display = candidate;
    context = made;
    return {};
  }
};

GlContext::GlContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GlContext::GlContext(GlContext&&) noexcept = default;
GlContext& GlContext::operator=(GlContext&&) noexcept = default;
GlContext::~GlContext() = default;

Result<GlContext> GlContext::create() {
  if (!epoxy_has_egl())
    return report::failed(fmt::format("no EGL library on this machine. {}", kRemedy));
  auto impl = std::make_unique<Impl>();
  impl->displayBefore = eglGetCurrentDisplay();
  impl->contextBefore = eglGetCurrentContext();
  impl->drawBefore = eglGetCurrentSurface(EGL_DRAW);
  impl->readBefore = eglGetCurrentSurface(EGL_READ);

  const std::vector<EGLDisplay> displays = candidateDisplays();
  if (displays.empty())
    return report::failed(
        fmt::format("EGL offers neither the surfaceless platform nor a device. {}", kRemedy));
  std::string reasons;
  for (std::size_t i = 0; i < displays.size(); ++i) {
    const std::string why = impl->tryDisplay(displays[i]);
    if (why.empty()) return GlContext(std::move(impl));
    reasons += fmt::format("{}display {} {}", i ? "; " : "", i, why);
  }
  return report::failed(fmt::format("no OpenGL 4.5 context: {}. {}", reasons, kRemedy));
}

}  // namespace lambent::render
