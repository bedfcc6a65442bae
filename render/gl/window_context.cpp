#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <map>
#include <utility>

#include "render/gl/context.h"
#include "render/gl/context_backends.h"

#define GRIDSHELL_GLFW(X)                       \
  X(init_hint, glfwInitHint)                    \
  X(init, glfwInit)                             \
  X(terminate, glfwTerminate)                   \
  X(error, glfwGetError)                        \
  X(hint, glfwWindowHint)                       \
  X(create, glfwCreateWindow)                   \
  X(destroy, glfwDestroyWindow)                 \
  X(make_current, glfwMakeContextCurrent)       \
  X(proc_address, glfwGetProcAddress)           \
  X(poll, glfwPollEvents)                       \
  X(wait, glfwWaitEventsTimeout)                \
  X(swap, glfwSwapBuffers)                      \
  X(swap_interval, glfwSwapInterval)            \
  X(should_close, glfwWindowShouldClose)        \
  X(framebuffer_size, glfwGetFramebufferSize)   \
  X(window_size, glfwGetWindowSize)             \
  X(content_scale, glfwGetWindowContentScale)   \
  X(set_user_pointer, glfwSetWindowUserPointer) \
  X(user_pointer, glfwGetWindowUserPointer)     \
  X(on_cursor, glfwSetCursorPosCallback)        \
  X(on_button, glfwSetMouseButtonCallback)      \
  X(on_scroll, glfwSetScrollCallback)           \
  X(on_key, glfwSetKeyCallback)                 \
  X(on_char, glfwSetCharCallback)               \
  X(on_drop, glfwSetDropCallback)               \
  X(on_refresh, glfwSetWindowRefreshCallback)   \
  X(new_cursor, glfwCreateStandardCursor)       \
  X(set_cursor, glfwSetCursor)                  \
  X(size_limits, glfwSetWindowSizeLimits)

namespace gridshell::render {
namespace {

GRIDSHELL_FUNCTIONS(Glfw, GRIDSHELL_GLFW);

std::string reason_of(const Glfw& glfw) {
  const char* text = nullptr;
  glfw.error(&text);
  return text ? text : "unknown reason";
}

/// The name printed on a key; empty for a key that has no use.
std::string name_of_key(int key) {
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return {char('A' + key - GLFW_KEY_A)};
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return {char('0' + key - GLFW_KEY_0)};
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return {char('0' + key - GLFW_KEY_KP_0)};
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
    return std::string("F").append(std::to_string(key - GLFW_KEY_F1 + 1));
  // clang-format off
  static const std::map<int, const char*> others{
      {GLFW_KEY_SPACE, "Space"}, {GLFW_KEY_ENTER, "Enter"}, {GLFW_KEY_KP_ENTER, "Enter"},
      {GLFW_KEY_ESCAPE, "Esc"}, {GLFW_KEY_TAB, "Tab"}, {GLFW_KEY_BACKSPACE, "Backspace"},
      {GLFW_KEY_DELETE, "Del"}, {GLFW_KEY_LEFT, "Left"}, {GLFW_KEY_RIGHT, "Right"},
      {GLFW_KEY_UP, "Up"}, {GLFW_KEY_DOWN, "Down"}, {GLFW_KEY_HOME, "Home"}, {GLFW_KEY_END, "End"},
      {GLFW_KEY_PAGE_UP, "PageUp"}, {GLFW_KEY_PAGE_DOWN, "PageDown"}, {GLFW_KEY_COMMA, "Comma"},
      {GLFW_KEY_PERIOD, "Period"}, {GLFW_KEY_MINUS, "Minus"}, {GLFW_KEY_KP_SUBTRACT, "Minus"},
      {GLFW_KEY_EQUAL, "Plus"}, {GLFW_KEY_KP_ADD, "Plus"}, {GLFW_KEY_LEFT_CONTROL, "Ctrl"},
      {GLFW_KEY_RIGHT_CONTROL, "Ctrl"}, {GLFW_KEY_LEFT_SHIFT, "Shift"},
      {GLFW_KEY_RIGHT_SHIFT, "Shift"}, {GLFW_KEY_LEFT_ALT, "Alt"}, {GLFW_KEY_RIGHT_ALT, "Alt"},
      {GLFW_KEY_KP_DECIMAL, "Period"}};
  // clang-format on
  const auto found = others.find(key);
  return found == others.end() ? "" : found->second;
}

class GlfwWindow final : public Window {
 public:
  GlfwWindow(const Glfw& glfw, GLFWwindow* window) : glfw_(glfw), window_(window) {
    glfw_.make_current(window_);
    glfw_.swap_interval(0);
    glfw_.set_user_pointer(window_, this);
    pointer_of = glfw_.user_pointer;
    glfw_.on_cursor(window_, [](GLFWwindow* w, double x, double y) {
      // on some systems screen coordinates are not pixels
      const double scale = of(w).pixels_a_unit();
      of(w).pass([&](const WindowListener& to) { to.mouse(scale * x, scale * y); });
    });
    glfw_.on_button(window_, [](GLFWwindow* w, int button, int action, int) {
      of(w).pass([&](const WindowListener& to) {
        if (button <= 2) to.button(button, action == GLFW_PRESS);
      });
    });
    glfw_.on_scroll(window_, [](GLFWwindow* w, double, double y) {
      of(w).pass([&](const WindowListener& to) { to.wheel(y); });
    });
    glfw_.on_key(window_, [](GLFWwindow* w, int key, int, int action, int) {
      of(w).pass([&](const WindowListener& to) {
        const std::string name = name_of_key(key);
        if (!name.empty()) to.key(name, action != GLFW_RELEASE);
      });
    });
    glfw_.on_char(window_, [](GLFWwindow* w, unsigned codepoint) {
      of(w).pass([&](const WindowListener& to) { to.text(codepoint); });
    });
    glfw_.on_drop(window_, [](GLFWwindow* w, int count, const char** paths) {
      of(w).pass([&](const WindowListener& to) {
        if (count > 0) to.dropped(paths[0]);
      });
    });
    glfw_.on_refresh(window_, [](GLFWwindow* w) {
      of(w).pass([](const WindowListener& to) { to.uncovered(); });
    });
  }
  ~GlfwWindow() override {
    glfw_.make_current(nullptr);
    glfw_.destroy(window_);
    glfw_.terminate();
  }
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  const char* kind_name() const override { return "window"; }
  void* proc_address(const char* function) const override {
    return reinterpret_cast<void*>(glfw_.proc_address(function));
  }
  void listen(const WindowListener& listener, double wait_seconds) override {
    listener_ = &listener;
    if (wait_seconds > 0)
      glfw_.wait(wait_seconds);
    else
      glfw_.poll();
    listener_ = nullptr;
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }
  bool wants_to_close() const override { return glfw_.should_close(window_); }
  int width() const override { return size().first; }
  int height() const override { return size().second; }
  double density() const override {
    float x = 1, y = 1;
    glfw_.content_scale(window_, &x, &y);
    return x > 0 ? x : 1;
  }
  void show_cursor(Cursor cursor) override {
    if (cursor == cursor_) return;
    cursor_ = cursor;
    // GLFW frees its cursors when it terminates
    static constexpr int shapes[] = {GLFW_ARROW_CURSOR, GLFW_HAND_CURSOR, GLFW_CROSSHAIR_CURSOR,
                                     GLFW_IBEAM_CURSOR};
    GLFWcursor*& shape = cursors_[std::size_t(cursor)];
    if (!shape) shape = glfw_.new_cursor(shapes[std::size_t(cursor)]);
    glfw_.set_cursor(window_, shape);
  }
  void present() override { glfw_.swap(window_); }

 private:
  /// GLFW's function that returns the GlfwWindow of a window; callbacks have no other access to it.
  static inline decltype(&glfwGetWindowUserPointer) pointer_of = nullptr;
  static GlfwWindow& of(GLFWwindow* window) {
    return *static_cast<GlfwWindow*>(pointer_of(window));
  }
  /// Passes an event to the listener. An exception of the listener is stored until GLFW, which is
  /// written in C, has returned; events after it are dropped.
  template <class Event>
  void pass(const Event& event) {
    if (!listener_ || thrown_) return;
    try {
      event(*listener_);
    } catch (...) {
      thrown_ = std::current_exception();
    }
  }
  std::pair<int, int> size() const {
    int w = 1, h = 1;
    glfw_.framebuffer_size(window_, &w, &h);
    return {w > 0 ? w : 1, h > 0 ? h : 1};
  }
  double pixels_a_unit() const {
    int w = 1, h = 1;
    glfw_.window_size(window_, &w, &h);
    return w > 0 ? double(width()) / w : 1;
  }

  Glfw glfw_;
  GLFWwindow* window_;
  const WindowListener* listener_ = nullptr;
  std::exception_ptr thrown_;  // by the listener
  Cursor cursor_ = Cursor::arrow;
  std::array<GLFWcursor*, 4> cursors_{};
};

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const WindowOptions& request) {
  auto library = SharedLibrary::open({"libglfw.so.3", "libglfw.so"});
  if (!library) return fail(Fault::io, "window: " + library.error().message);
  Glfw glfw;
  if (!glfw.load(*library)) return fail(Fault::io, "window: GLFW is too old; 3.3 is needed");
#ifdef GLFW_PLATFORM
  // GLFW 3.4 asks for Wayland first, whose library prints that this is missing
  if (!std::getenv("XDG_RUNTIME_DIR")) glfw.init_hint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
  if (!glfw.init()) return fail(Fault::io, "window: " + reason_of(glfw));

  glfw.hint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfw.hint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfw.hint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw.hint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfw.hint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfw.hint(GLFW_VISIBLE, request.visible ? GLFW_TRUE : GLFW_FALSE);
  GLFWwindow* window =
      glfw.create(request.width, request.height, request.title.c_str(), nullptr, nullptr);
  if (!window) {
    const std::string reason = reason_of(glfw);
    glfw.terminate();
    return fail(Fault::io, "window: no OpenGL 3.3 core context: " + reason);
  }
  if (request.least_width > 0)
    glfw.size_limits(window, request.least_width, request.least_height, GLFW_DONT_CARE,
                     GLFW_DONT_CARE);
  return std::make_unique<GlfwWindow>(glfw, window);
}

Result<std::unique_ptr<Context>> create_window_context() {
  auto window = Window::open({.title = "gridshell", .width = 64, .height = 64, .visible = false});
  if (!window)
    return fail(window.error().fault,
                window.error().message + " (use --context osmesa or egl instead)");
  return std::move(*window);
}

}  // namespace gridshell::render
