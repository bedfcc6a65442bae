// Runs the interface: in a window of the desktop, from a recording, or in a bench.

#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "app/window/interface.h"
#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "render/gl/context.h"
#include "render/gl/renderer.h"

namespace gridshell::window {
namespace {

// time without motion before the view is drawn at full resolution: if the engine is idle, and if it
// is busy and such a picture takes less than the third time
constexpr double sharp_after_s = 0.15, sharp_while_busy_s = 0.6, longest_while_busy_s = 0.05;
// if a picture at half resolution takes longer, one at full resolution is drawn on another thread
constexpr double longest_moving_s = 0.003;

constexpr double frame_s = 1.0 / 60;
constexpr double still_wait_s = 0.05;  // time of waiting for events if nothing moves

/// A listener that turns what happens to the window into events.
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
    if (code >= 0x20) take({.kind = InputKind::type, .text = utf8_of(code)});
  };
  listener.dropped = [take](const std::string& path) {
    take({.kind = InputKind::open, .text = path});
  };
  return listener;
}

constexpr int most_frames = 2000;  // of rest()
constexpr int frames_to_sharpen = 30;
constexpr double turn_deg = 0.2;            // per frame of a bench
constexpr double longest_to_sharpen_s = 5;  // of a bench

/// Draws frames until all events are taken, the engine is idle and the view shows its result.
Result<void> run_until_idle(Interface& interface, ViewerState& viewer) {
  for (int k = 0; k < most_frames; ++k) {
    viewer.engine.wait();
    for (BackgroundTask* task : viewer.tasks()) task->wait();
    TRY_DO(interface.frame_offscreen(frame_s));
    const bool idle = viewer.engine.idle() && viewer.engine.shell() == viewer.shell &&
                      !viewer.playing && std::ranges::all_of(viewer.tasks(), &BackgroundTask::idle);
    if (idle && !interface.events_wait()) return {};
  }
  return {};
}

Result<void> wait_for(Interface& interface, ViewerState& viewer, double seconds) {
  for (double t = 0; t < seconds; t += frame_s) {
    viewer.engine.wait();
    TRY_DO(interface.frame_offscreen(frame_s));
  }
  return {};
}

/// Draws a frame, then sleeps until the next one is `due`, as the window does. Returns the seconds
/// that the frame itself took.
Result<double> paced_frame(Interface& interface, double& due) {
  const double begin = seconds_now();
  TRY_DO(interface.frame_offscreen(frame_s));
  const double end = seconds_now();
  due = std::max(due + frame_s, end);
  std::this_thread::sleep_for(std::chrono::duration<double>(due - end));
  return end - begin;
}

}  // namespace

/// Draws the shell again if something that it shows is new; at full resolution only without motion.
Result<void> Interface::draw_shell() {
  if (!viewer_.shell->any() || viewer_.view.width < 16) return {};
  const ShownShell shown{viewer_.camera, viewer_.view, viewer_.show};
  const bool again = redraw_shell_ || shown != shown_;
  if (again) still_seconds_ = 0;
  const bool idle = viewer_.engine.idle();
  const bool sharp = !again && still_seconds_ >= (idle ? sharp_after_s : sharp_while_busy_s) &&
                     (idle || picture_.took_s(Resolution::still) < longest_while_busy_s);
  if (!again && (!sharp || sharp_)) return {};
  if (sharp && take_still(viewer_.picture_request())) return {};
  shown_ = shown;
  redraw_shell_ = false;
  sharp_ = sharp;
  ++pictures_;
  return picture_.draw(viewer_.picture_request(), sharp ? Resolution::still : Resolution::moving);
}

/// Has the picture at full resolution drawn on another thread, and shows it when it is ready.
/// Returns false if this thread shall draw it.
bool Interface::take_still(const PictureRequest& shown) {
  const auto& draw = viewer_.library.draw_still;
  if (!draw || picture_.took_s(Resolution::moving) < longest_moving_s) return false;
  if (still_.valid()) {
    if (still_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
    const Result<render::Image> image = still_.get();
    if (!image) return false;
    if (still_of_ == pictures_) {
      picture_.show(*image);
      ++pictures_;
      return sharp_ = true;
    }
  }
  still_of_ = pictures_;
  still_ = std::async(std::launch::async, [draw, shown] { return draw(shown); });
  return true;
}

/// Draws small pictures of the states that were found, each once, with the current camera.
Result<void> Interface::draw_states() {
  const auto& found = viewer_.shell->found;
  if (!found) return states_.clear(), Result<void>();
  std::size_t same = 0, most = std::min(states_.size(), found->size());
  while (same < most && states_[same].first == (*found)[same]) ++same;
  states_.erase(states_.begin() + std::ptrdiff_t(same), states_.end());
  for (std::size_t k = same; k < found->size(); ++k) {
    const auto& state = (*found)[k];
    PictureRequest small{state, viewer_.camera, {160, 100}, viewer_.show, {}};
    small.show.other.reset();
    small.show.mode_mm = 0;
    fit(small.camera, small.view, state->frame.nodes);
    states_.emplace_back(state, ShellPicture(gl_, renderer_));
    ++pictures_;
    TRY_DO(states_.back().second.draw(small, Resolution::still));
  }
  return {};
}

/// Whether the current draw lists differ from those of the last frame.
bool Interface::is_new() {
  std::vector<char> now;
  const auto put = [&now](const auto& list) {
    const char* begin = reinterpret_cast<const char*>(list.Data);
    now.insert(now.end(), begin, begin + list.size_in_bytes());
  };
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    put(list.VtxBuffer), put(list.IdxBuffer);
    put(list.CmdBuffer);
  }
  const char* count = reinterpret_cast<const char*>(&pictures_);
  now.insert(now.end(), count, count + sizeof pictures_);
  const bool same = now == drawn_;
  drawn_ = std::move(now);
  return !same;
}

/// Does everything for a frame except drawing the lists; returns whether they show anything new.
Result<bool> Interface::compose(double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {float(width_), float(height_)};
  io.DeltaTime = float(std::clamp(seconds, 1e-4, 0.5));
  still_seconds_ += seconds;
  redraw_shell_ |= viewer_.tick(seconds);
  if (dark_ != viewer_.show.dark) choose_colours(dark_ = viewer_.show.dark, density_);
  feed();
  TRY_DO(draw_states());
  // the control that has the keyboard is marked only if the keyboard is used
  if (!is_popup_open()) ImGui::GetCurrentContext()->NavDisableHighlight = !keyboard_;
  ImGui::NewFrame();
  lay_out();
  ImGui::Render();
  io.MouseWheel = 0;
  if (!viewer_.copied.empty()) ImGui::SetClipboardText(std::exchange(viewer_.copied, "").c_str());
  TRY_DO(draw_shell());
  return is_new();
}

void Interface::paint(bool upwards) {
  const ImVec4& below = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  gl_.ClearColor(below.x, below.y, below.z, 1);
  gl_.Disable(GL_FRAMEBUFFER_SRGB);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  painter_->draw(*ImGui::GetDrawData(), upwards);
}

Result<bool> Interface::frame(double seconds) {
  TRY(again, compose(seconds));
  if (!*again) return false;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  paint(true);
  return true;
}

Result<void> Interface::frame_offscreen(double seconds) {
  TRY(again, compose(seconds));
  if (!*again) return {};
  TRY_DO(target_.bind(width_, height_, GL_RGBA8));
  paint(false);
  // waits until it is drawn, as a window does
  gl_.Finish();
  return {};
}

render::Image Interface::read() {
  render::Image image(width_, height_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.frame());
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  for (std::size_t k = 3; k < image.rgba.size(); k += 4) image.rgba[k] = 255;
  return image;
}

Result<void> run_desktop(ViewerState& viewer, const std::function<void(const InputEvent&)>& seen,
                         const std::function<bool()>& stopped) {
  auto window = render::Window::open({.least_width = 640, .least_height = 400});
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
  render::WindowListener listener = listener_to(take);
  listener.uncovered = [&] { (*interface)->force_redraw(); };
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
    TRY(drawn, (*interface)->frame(now - last));
    last = now;
    (*window)->show_cursor((*interface)->cursor());
    if (*drawn) (*window)->present();
    const bool still = !(*interface)->busy() && viewer.engine.idle() && !viewer.playing;
    (*window)->listen(listener, still ? still_wait_s : 0);
    // the engine has the remaining time of the frame
    for (double left; (left = now + frame_s - seconds_now()) > 0;)
      (*window)->listen(listener, left);
  }
  return fault;
}

Result<void> play(Interface& interface, ViewerState& viewer,
                  const std::vector<InputEvent>& events) {
  TRY_DO(run_until_idle(interface, viewer));
  for (const InputEvent& event : events) {
    if (viewer.over) break;
    const auto done = interface.take(event).and_then([&] {
      return event.kind == InputKind::wait ? wait_for(interface, viewer, event.x)
                                           : run_until_idle(interface, viewer);
    });
    if (!done) return fail(done.error().fault, write_event(event) + ": " + done.error().message);
  }
  for (int k = 0; k < frames_to_sharpen && interface.busy(); ++k)
    TRY_DO(interface.frame_offscreen(frame_s));
  return interface.frame_offscreen(frame_s);
}

Result<BenchFigures> bench(Interface& interface, ViewerState& viewer, double seconds) {
  TRY_DO(run_until_idle(interface, viewer));
  if (!viewer.shell->any()) return fail(Fault::no_equilibrium, viewer.message);
  BenchFigures figures;
  const double begin = seconds_now();
  const int before = viewer.shell->equilibria;
  const double cpu = cpu_seconds_now();
  int frames = 0;
  double due = begin;
  for (double now = begin; now < begin + seconds; now = seconds_now()) {
    // between half the path and its end, forward and back in four seconds
    const double phase = std::abs(std::remainder(now - begin, 4.0)) / 2;
    viewer.post(Move{1 - 0.5 * phase}, true);
    viewer.camera.azimuth_deg += turn_deg;
    TRY(frame, paced_frame(interface, due));
    if (now - begin > 1) figures.worst_frame_ms = std::max(figures.worst_frame_ms, 1e3 * *frame);
    ++frames;
  }
  const double took = seconds_now() - begin;
  figures.interface_fps = frames / took;
  const int found = viewer.engine.shell()->equilibria - before;
  const double own = cpu_seconds_now() - cpu;
  figures.equilibria_per_s = found / took;
  figures.frame_cpu_ms = 1e3 * own / frames;
  viewer.engine.cancel();
  viewer.engine.wait();
  // without input the view becomes sharp
  for (const double until = seconds_now() + longest_to_sharpen_s;
       interface.busy() && seconds_now() < until;) {
    TRY(frame, paced_frame(interface, due));
    figures.worst_frame_ms = std::max(figures.worst_frame_ms, 1e3 * *frame);
  }
  // time of a cancel: a long motion is stopped soon after its start
  viewer.post(Move{0.01}, true);
  viewer.send_command(Move{1.0});
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  const double requested = seconds_now();
  viewer.engine.cancel();
  viewer.engine.wait();
  figures.cancel_ms = 1e3 * (seconds_now() - requested);
  return figures;
}

}  // namespace gridshell::window
