// A current OpenGL context without caring where it comes from: OSMesa or EGL surfaceless
// off-screen, GLFW with a window; chosen at run time and loaded with dlopen, so none is needed to
// start.
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

/// Lets Mesa keep compiled shaders in a folder of the user's cache from now on, unless the user
/// chose one; else it compiles them on every start. It changes the environment: to be called once,
/// before there are threads. Where no folder can be made, the first frame is slower.
void keep_compiled_shaders();

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

// A window of the desktop with its OpenGL context, mouse and keys; GLFW, loaded while the program
// runs.

/// What happens to a window. Positions are pixels from the top left.
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
  std::function<void()> uncovered = [] {};  ///< what it showed is lost
};

/// What the mouse would do where it is.
enum class Cursor { arrow, hand, cross, text };

struct WindowOptions {
  std::string title = "gridshell";
  int width = 1280, height = 720;         ///< at a pixel a point
  int least_width = 0, least_height = 0;  ///< that a hand can make it; 0: any
  bool visible = true;
};

class Window : public Context {
 public:
  /// Errors: io with what is missing: GLFW, a display, OpenGL 3.3.
  static Result<std::unique_ptr<Window>> open(const WindowOptions& request);

  /// Hands on what happened, after waiting for it so many seconds at most.
  virtual void listen(const WindowListener& listener, double wait_seconds) = 0;
  virtual bool wants_to_close() const = 0;
  virtual int width() const = 0;  ///< pixels
  virtual int height() const = 0;
  virtual double density() const = 0;  ///< pixels a point of text
  virtual void show_cursor(Cursor cursor) = 0;
  /// Shows what was drawn into framebuffer 0.
  virtual void present() = 0;
};

}  // namespace gridshell::render
