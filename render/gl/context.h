// OpenGL contexts of three kinds: OSMesa and surfaceless EGL, which draw off-screen, and GLFW,
// which opens a window. The library is chosen at run time and loaded with dlopen, so the program
// starts without any of them.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/core/enum_words.h"
#include "engine/core/result.h"

namespace gridshell::render {

enum class ContextKind { automatic, osmesa, egl, window };
constexpr auto words(ContextKind) {
  return names_except<ContextKind>({{ContextKind::automatic, "auto"}});
}

/// Makes Mesa save compiled shaders in a folder of the user's cache, unless the user has chosen
/// another; otherwise Mesa compiles them at every start. It changes the environment, so call it
/// once, before there are threads. If the folder cannot be made, every start is slower.
void keep_compiled_shaders();

/// An OpenGL context that is current from its creation to its destruction, on the thread that
/// created it.
class Context {
 public:
  /// `automatic` takes OSMesa or, without it, surfaceless EGL. Errors: Fault::io with the kinds
  /// that were tried and why each failed.
  static Result<std::unique_ptr<Context>> create(ContextKind kind);
  virtual ~Context() = default;

  virtual const char* kind_name() const = 0;                   ///< "osmesa", "egl", "window"
  virtual void* proc_address(const char* function) const = 0;  ///< of a GL function, or null
};

/// Functions that a window calls for its events. Positions are pixels from the top left.
struct WindowListener {
  std::function<void(double x, double y)> mouse = [](double, double) {};
  /// 0 left, 1 right, 2 middle
  std::function<void(int button, bool down)> button = [](int, bool) {};
  std::function<void(double steps)> wheel = [](double) {};
  /// a key by the name printed on it: "A", "F1", "Ctrl", "Esc"; others are left out
  std::function<void(const std::string& name, bool down)> key = [](const std::string&, bool) {};
  std::function<void(unsigned codepoint)> text = [](unsigned) {};
  /// a file or folder that was dropped on the window
  std::function<void(const std::string& path)> dropped = [](const std::string&) {};
  std::function<void()> uncovered = [] {};  ///< the contents are lost and must be drawn again
};

/// Shape of the mouse pointer.
enum class Cursor { arrow, hand, cross, text };

struct WindowOptions {
  std::string title = "gridshell";
  int width = 1280, height = 720;         ///< in points; a dense screen has more pixels
  int least_width = 0, least_height = 0;  ///< smallest size that the user can give it; 0: any
  bool visible = true;
};

/// A window of the desktop with its OpenGL context, mouse and keys, by GLFW.
class Window : public Context {
 public:
  /// Errors: io with what is missing: GLFW, a display, OpenGL 3.3.
  static Result<std::unique_ptr<Window>> open(const WindowOptions& request);

  /// Passes events to the listener, after waiting at most so many seconds for one.
  virtual void listen(const WindowListener& listener, double wait_seconds) = 0;
  virtual bool wants_to_close() const = 0;
  virtual int width() const = 0;  ///< pixels
  virtual int height() const = 0;
  virtual double density() const = 0;  ///< pixels per point
  virtual void show_cursor(Cursor cursor) = 0;
  /// Shows the contents of framebuffer 0.
  virtual void present() = 0;
};

}  // namespace gridshell::render
