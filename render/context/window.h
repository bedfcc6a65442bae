// A window of the desktop with its OpenGL context, mouse and keys; GLFW, loaded while the program
// runs.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "render/context/context.h"

namespace gridshell::render {

/// What happens to a window. Positions are pixels from the top left.
struct WindowListener {
  std::function<void(double x, double y)> mouse = [](double, double) {};
  /// 0 left, 1 right, 2 middle
  std::function<void(int button, bool down)> button = [](int, bool) {};
  std::function<void(double steps)> wheel = [](double) {};
  /// a key by the name printed on it: "A", "F1", "Ctrl", "Esc"; others are left out
  std::function<void(const std::string& name, bool down)> key = [](const std::string&, bool) {};
  std::function<void(unsigned codepoint)> text = [](unsigned) {};
};

struct WindowWish {
  std::string title = "gridshell";
  int width = 1280, height = 720;         ///< at a pixel a point
  int least_width = 0, least_height = 0;  ///< that a hand can make it; 0: any
  bool visible = true;
};

class Window : public Context {
 public:
  /// Errors: io with what is missing: GLFW, a display, OpenGL 3.3.
  static Result<std::unique_ptr<Window>> open(const WindowWish& wish);

  /// Hands on what happened, after waiting for it so many seconds at most.
  virtual void listen(const WindowListener& listener, double wait_seconds) = 0;
  virtual bool wants_to_close() const = 0;
  virtual int width() const = 0;  ///< pixels
  virtual int height() const = 0;
  virtual double density() const = 0;  ///< pixels a point of text
  /// Shows what was drawn into framebuffer 0.
  virtual void present() = 0;
};

}  // namespace gridshell::render
