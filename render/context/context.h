// A current OpenGL context without caring where it comes from: OSMesa or EGL surfaceless
// off-screen, GLFW with a window; chosen at run time and loaded with dlopen, so none is needed to
// start.
#pragma once

#include <memory>
#include <string>

#include "engine/core/result.h"
#include "engine/core/words.h"

namespace gridshell::render {

enum class ContextKind { automatic, osmesa, egl, window };
constexpr auto words(ContextKind) {
  return word_table<ContextKind>({{ContextKind::automatic, "auto"},
                                  {ContextKind::osmesa, "osmesa"},
                                  {ContextKind::egl, "egl"},
                                  {ContextKind::window, "window"}});
}

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
