// A current OpenGL context without caring where it comes from: OSMesa or EGL surfaceless
// off-screen, GLFW with a window; chosen at run time and loaded with dlopen, so none is needed to
// start.
#pragma once

#include <memory>
#include <string>

#include "engine/core/result.h"

namespace gridshell::render {

enum class ContextKind { automatic, osmesa, egl, window };

/// Current from creation to destruction, on the thread that made it.
class Context {
 public:
  /// `automatic` takes OSMesa, else EGL surfaceless. Errors: Fault::io, naming what was tried and
  /// why each failed.
  static Result<std::unique_ptr<Context>> create(ContextKind kind);
  virtual ~Context() = default;

  virtual const char* kind_name() const = 0;                   ///< "osmesa", "egl", "window"
  virtual void* proc_address(const char* function) const = 0;  ///< of a GL function, or null
};

}  // namespace gridshell::render
