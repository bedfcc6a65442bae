// Shared libraries opened while the program runs, and the contexts that come from them.
#pragma once

#include <initializer_list>

#include "engine/core/result.h"
#include "render/gl/context.h"

namespace gridshell::render {

/// A shared library. It is never closed, since drivers have threads and exit handlers of their own.
class SharedLibrary {
 public:
  /// Opens the first of `names` that exists. Errors: Fault::io with the loader's message for each.
  static Result<SharedLibrary> open(std::initializer_list<const char*> names);

  /// Sets `function` to the library's function `name`; returns false if there is none.
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

// GRIDSHELL_FUNCTIONS(Name, LIST) defines a struct of function pointers that load() takes from a
// library; LIST is a macro that lists them as X(member, function).
// NOLINTBEGIN: names cannot be in parentheses
#define GRIDSHELL_MEMBER(member, function) decltype(&function) member = nullptr;
#define GRIDSHELL_LOADED(member, function) &&library.load(member, #function)
#define GRIDSHELL_FUNCTIONS(Name, LIST)                                             \
  struct Name {                                                                     \
    LIST(GRIDSHELL_MEMBER)                                                          \
    bool load(const SharedLibrary& library) { return true LIST(GRIDSHELL_LOADED); } \
  }
// NOLINTEND

// One function for each kind of context; Context::create chooses among them. Errors: Fault::io.

/// An OpenGL 3.3 core context of Mesa's off-screen software rasteriser.
Result<std::unique_ptr<Context>> create_osmesa_context();

/// An OpenGL 3.3 core context of EGL without a display (EGL_MESA_platform_surfaceless).
Result<std::unique_ptr<Context>> create_egl_context();

/// A hidden GLFW window; needs a display.
Result<std::unique_ptr<Context>> create_window_context();

}  // namespace gridshell::render
