#include "app/window/interface.h"

#include <cmath>
#include <string>

#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "render/gl/context.h"

namespace gridshell::window {
namespace {

constexpr double still_wait_s = 0.05;  // for something to happen, where nothing moves

std::string utf8(unsigned code) {
  const auto byte = [](unsigned value) { return char((unsigned char)value); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 0x3f))};
  return {byte(0xe0 | (code >> 12 & 0xf)), byte(0x80 | (code >> 6 & 0x3f)),
          byte(0x80 | (code & 0x3f))};
}

/// From what happens to the window to events.
render::WindowListener listener_to(const std::function<void(const InputEvent&)>& take) {
  render::WindowListener listener;
  listener.mouse = [take](double x, double y) {
    take({.kind = InputKind::mouse, .x = std::round(x), .y = std::round(y)});
  };
  listener.button = [take](int button, bool down) {
    take({.kind = down ? InputKind::press : InputKind::release, .button = Button(button)});
  };
  listener.wheel = [take](double steps) { take({.kind = InputKind::wheel, .y = steps}); };
  listener.key = [take](const std::string& name, bool down) {
    if (const auto key = find_word<Key>(name))
      take({.kind = down ? InputKind::down : InputKind::up, .key = *key});
  };
  listener.text = [take](unsigned code) {
    if (code > 0x20) take({.kind = InputKind::type, .text = utf8(code)});
  };
  return listener;
}

}  // namespace

Result<void> run_desktop(ViewerState& viewer, const std::function<void(const InputEvent&)>& seen,
                         const std::function<bool()>& stopped) {
  auto window = render::Window::open({.least_width = 720, .least_height = 480});
  if (!window)
    return fail(Fault::io, "no window can be opened (" + window.error().message +
                               "): 'gridshell movie' and 'gridshell figure' draw without one, and "
                               "'gridshell view --play FILE --shot PNG' plays recorded input");
  TRY(renderer, render::Renderer::create(**window));
  TRY(interface, Interface::create(**window, **renderer, viewer));
  Result<void> fault;
  const auto take = [&](const InputEvent& event) {
    seen(event);
    if (auto taken = (*interface)->take(event); !taken) fault = taken;
  };
  const render::WindowListener listener = listener_to(take);
  int width = 0, height = 0;
  for (double last = seconds_now(); fault && !viewer.over && !stopped();) {
    if ((*window)->wants_to_close()) break;
    if (width != (*window)->width() || height != (*window)->height()) {
      width = (*window)->width();
      height = (*window)->height();
      take({.kind = InputKind::size,
            .x = double(width),
            .y = double(height),
            .density = (*window)->density()});
    }
    const double now = seconds_now();
    if (auto drawn = (*interface)->frame(now - last); !drawn) return drawn;
    last = now;
    (*window)->present();
    const bool still = !(*interface)->busy() && viewer.engine.idle() && !viewer.playing;
    (*window)->listen(listener, still ? still_wait_s : 0);
  }
  return fault;
}

}  // namespace gridshell::window
