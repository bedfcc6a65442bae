#include "render/gl/context.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <dlfcn.h>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "render/gl/context_backends.h"

#define GRIDSHELL_EGL(X)                \
  X(proc_address, eglGetProcAddress)    \
  X(query_string, eglQueryString)       \
  X(initialize, eglInitialize)          \
  X(terminate, eglTerminate)            \
  X(bind_api, eglBindAPI)               \
  X(choose_config, eglChooseConfig)     \
  X(create_context, eglCreateContext)   \
  X(destroy_context, eglDestroyContext) \
  X(make_current, eglMakeCurrent)

namespace gridshell::render {

Result<SharedLibrary> SharedLibrary::open(std::initializer_list<const char*> names) {
  std::string reasons;
  for (const char* name : names) {
    if (void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle);
    if (!reasons.empty()) reasons += "; ";
    const char* reason = dlerror();
    reasons += reason ? reason : name;
  }
  return fail(Fault::io, reasons);
}

void* SharedLibrary::symbol(const char* name) const { return dlsym(handle_, name); }

void keep_compiled_shaders() {
  if (std::getenv("MESA_SHADER_CACHE_DIR")) return;
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (cache && *cache)
    folder = cache;
  else if (home && *home)
    folder = std::filesystem::path(home) / ".cache";
  else
    return;
  folder /= "gridshell/shaders";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), 0);
}

namespace {

GRIDSHELL_FUNCTIONS(Egl, GRIDSHELL_EGL);

class EglContext final : public Context {
 public:
  EglContext(const Egl& egl, EGLDisplay display) : egl_(egl), display_(display) {}
  ~EglContext() override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) egl_.destroy_context(display_, context_);
    egl_.terminate(display_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Returns false if the display has no OpenGL 3.3 core context without a surface.
  bool make_current() {
    const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl_.bind_api(EGL_OPENGL_API)) return false;
    if (!egl_.choose_config(display_, config_attributes, &config, 1, &count) || count < 1)
      return false;
    // clang-format off
    const EGLint requested[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    // clang-format on
    context_ = egl_.create_context(display_, config, EGL_NO_CONTEXT, requested);
    return context_ != EGL_NO_CONTEXT &&
           egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }
  const char* kind_name() const override { return "egl"; }
  void* proc_address(const char* function) const override {
    return reinterpret_cast<void*>(egl_.proc_address(function));
  }

 private:
  Egl egl_;
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

Result<std::unique_ptr<Context>> create_off_screen() {
  auto osmesa = create_osmesa_context();
  if (osmesa) return osmesa;
  auto egl = create_egl_context();
  if (egl) return egl;
  return fail(Fault::io, "no OpenGL context: " + osmesa.error().message + "; " +
                             egl.error().message +
                             "; install libosmesa6 or libegl1 with Mesa's drivers");
}

}  // namespace

Result<std::unique_ptr<Context>> create_egl_context() {
  auto library = SharedLibrary::open({"libEGL.so.1", "libEGL.so"});
  if (!library) return fail(Fault::io, "EGL: " + library.error().message);
  Egl egl;
  if (!egl.load(*library)) return fail(Fault::io, "EGL: the library is too old");

  const char* extensions = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!extensions || !std::strstr(extensions, "EGL_MESA_platform_surfaceless"))
    return fail(Fault::io, "EGL: no EGL_MESA_platform_surfaceless (install libegl-mesa0)");
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      egl.proc_address("eglGetPlatformDisplayEXT"));
  EGLDisplay display =
      get_display ? get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)
                  : EGL_NO_DISPLAY;
  if (display == EGL_NO_DISPLAY || !egl.initialize(display, nullptr, nullptr))
    return fail(Fault::io, "EGL: no surfaceless display (install libgl1-mesa-dri)");
  auto context = std::make_unique<EglContext>(egl, display);
  if (!context->make_current()) return fail(Fault::io, "EGL: no OpenGL 3.3 core context");
  return context;
}

Result<std::unique_ptr<Context>> Context::create(ContextKind kind) {
  switch (kind) {
    case ContextKind::osmesa:
      return create_osmesa_context();
    case ContextKind::egl:
      return create_egl_context();
    case ContextKind::window:
      return create_window_context();
    case ContextKind::automatic:
      break;
  }
  return create_off_screen();
}

}  // namespace gridshell::render
