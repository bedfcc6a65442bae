// A shared library opened while the program runs, so that the program starts without it.
#pragma once

#include <initializer_list>

#include "engine/core/result.h"
#include "render/gl/context.h"

namespace gridshell::render {

/// Stays open to the end of the process: drivers keep threads and exit handlers of their own.
class SharedLibrary {
 public:
  /// The first of `names` that opens. Errors: Fault::io with what the loader said of each.
  static Result<SharedLibrary> open(std::initializer_list<const char*> names);

  /// Sets `function` to that of this name. False where the library lacks it.
  template <class F>
  bool load(F& function, const char* name) const {
    function = reinterpret_cast<F>(symbol(name));
    return function != nullptr;
  }

 private:
  explicit SharedLibrary(void* handle) : handle_(handle) {}
  void* symbol(const char* name) const;

  void* handle_;
};

// A struct of the functions that a list X(member, function) names, to be loaded from a library.
// NOLINTBEGIN: names cannot be in parentheses
#define GRIDSHELL_MEMBER(member, function) decltype(&function) member = nullptr;
#define GRIDSHELL_LOADED(member, function) &&library.load(member, #function)
#define GRIDSHELL_FUNCTIONS(Name, LIST)                                             \
  struct Name {                                                                     \
    LIST(GRIDSHELL_MEMBER)                                                          \
    bool load(const SharedLibrary& library) { return true LIST(GRIDSHELL_LOADED); } \
  }
// NOLINTEND

// One function for each kind of context; Context::create chooses among them.

/// Mesa's off-screen software rasteriser; asks for OpenGL 3.3 core.
Result<std::unique_ptr<Context>> create_osmesa_context();

/// EGL without a display (EGL_MESA_platform_surfaceless); asks for OpenGL 3.3 core.
Result<std::unique_ptr<Context>> create_egl_context();

/// A hidden GLFW window; needs a display.
Result<std::unique_ptr<Context>> create_window_context();

}  // namespace gridshell::render
