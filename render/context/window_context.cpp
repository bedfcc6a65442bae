#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "render/context/backends.h"
#include "render/context/library.h"

namespace gridshell::render {
namespace {

/// The entry points of libglfw.
struct Glfw {
  decltype(&glfwInit) init;
  decltype(&glfwTerminate) terminate;
  decltype(&glfwGetError) error;
  decltype(&glfwWindowHint) hint;
  decltype(&glfwCreateWindow) create;
  decltype(&glfwDestroyWindow) destroy;
  decltype(&glfwMakeContextCurrent) make_current;
  decltype(&glfwGetProcAddress) proc_address;

  explicit Glfw(const Library& library)
      : init(library.function<decltype(&glfwInit)>("glfwInit")),
        terminate(library.function<decltype(&glfwTerminate)>("glfwTerminate")),
        error(library.function<decltype(&glfwGetError)>("glfwGetError")),
        hint(library.function<decltype(&glfwWindowHint)>("glfwWindowHint")),
        create(library.function<decltype(&glfwCreateWindow)>("glfwCreateWindow")),
        destroy(library.function<decltype(&glfwDestroyWindow)>("glfwDestroyWindow")),
        make_current(library.function<decltype(&glfwMakeContextCurrent)>("glfwMakeContextCurrent")),
        proc_address(library.function<decltype(&glfwGetProcAddress)>("glfwGetProcAddress")) {}

  bool complete() const {
    return init && terminate && error && hint && create && destroy && make_current && proc_address;
  }
  std::string reason() const {
    const char* text = nullptr;
    error(&text);
    return text ? text : "unknown reason";
  }
};

class WindowContext final : public Context {
 public:
  WindowContext(const Glfw& glfw, GLFWwindow* window) : glfw_(glfw), window_(window) {
    glfw_.make_current(window_);
  }
  ~WindowContext() override {
    glfw_.make_current(nullptr);
    glfw_.destroy(window_);
    glfw_.terminate();
  }
  WindowContext(const WindowContext&) = delete;
  WindowContext& operator=(const WindowContext&) = delete;

  const char* kind_name() const override { return "window"; }
  void* proc_address(const char* function) const override {
    return reinterpret_cast<void*>(glfw_.proc_address(function));
  }

 private:
  Glfw glfw_;
  GLFWwindow* window_;
};

}  // namespace

Result<std::unique_ptr<Context>> create_window_context() {
  auto library = Library::open({"libglfw.so.3", "libglfw.so"});
  if (!library) return fail(Fault::io, "window: " + library.error().message);
  const Glfw glfw(*library);
  if (!glfw.complete()) return fail(Fault::io, "window: GLFW is too old; 3.3 is needed");
  if (!glfw.init())
    return fail(Fault::io, "window: " + glfw.reason() + " (use --context osmesa or egl instead)");

  glfw.hint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfw.hint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfw.hint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw.hint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfw.hint(GLFW_VISIBLE, GLFW_FALSE);
  GLFWwindow* window = glfw.create(64, 64, "gridshell", nullptr, nullptr);
  if (!window) {
    const std::string reason = glfw.reason();
    glfw.terminate();
    return fail(Fault::io, "window: no OpenGL 3.3 core context: " + reason);
  }
  return std::make_unique<WindowContext>(glfw, window);
}

}  // namespace gridshell::render
