// A shared library opened while the program runs, so that the program starts without it.
#pragma once

#include <initializer_list>
#include <string>

#include "engine/core/result.h"
#include "render/gl/context.h"

namespace gridshell::render {

/// Stays open to the end of the process: drivers keep threads and exit handlers of their own.
class SharedLibrary {
 public:
  /// The first of `names` that opens. Errors: Fault::io with what the loader said of each.
  static Result<SharedLibrary> open(std::initializer_list<const char*> names);

  /// The function `name` as a pointer of type F; null when the library lacks it.
  template <class F>
  F function(const char* name) const {
    return reinterpret_cast<F>(symbol(name));
  }

 private:
  explicit SharedLibrary(void* handle) : handle_(handle) {}
  void* symbol(const char* name) const;

  void* handle_;
};

// One function for each kind of context; Context::create chooses among them.

/// Mesa's off-screen software rasteriser; asks for OpenGL 3.3 core.
Result<std::unique_ptr<Context>> create_osmesa_context();

/// EGL without a display (EGL_MESA_platform_surfaceless); asks for OpenGL 3.3 core.
Result<std::unique_ptr<Context>> create_egl_context();

/// A hidden GLFW window; needs a display.
Result<std::unique_ptr<Context>> create_window_context();

}  // namespace gridshell::render
