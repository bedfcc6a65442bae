#include "app/window/interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "engine/core/system_info.h"
#include "engine/core/try.h"

namespace gridshell::window {
namespace {

constexpr double frame_s = 1.0 / 60;
constexpr int most_frames = 2000;  // until nothing moves any more
constexpr int frames_to_sharpen = 30;

/// Frames until all events are taken, the engine rests and the view shows what it found.
Result<void> rest(Interface& interface, ViewerState& viewer) {
  for (int k = 0; k < most_frames; ++k) {
    viewer.engine.wait();
    viewer.picture_task.wait();
    viewer.movie_task.wait();
    if (auto drawn = interface.frame_aside(frame_s); !drawn) return drawn;
    const bool rests = viewer.engine.idle() && viewer.engine.shell() == viewer.shell &&
                       !viewer.playing && viewer.picture_task.idle() && viewer.movie_task.idle();
    if (rests && !interface.events_wait()) return {};
  }
  return {};
}

Result<void> wait_for(Interface& interface, ViewerState& viewer, double seconds) {
  for (double t = 0; t < seconds; t += frame_s) {
    viewer.engine.wait();
    if (auto drawn = interface.frame_aside(frame_s); !drawn) return drawn;
  }
  return {};
}

}  // namespace

Result<void> play(Interface& interface, ViewerState& viewer,
                  const std::vector<InputEvent>& events) {
  if (auto first = rest(interface, viewer); !first) return first;
  for (const InputEvent& event : events) {
    if (viewer.over) break;
    const auto done = interface.take(event).and_then([&] {
      return event.kind == InputKind::wait ? wait_for(interface, viewer, event.x)
                                           : rest(interface, viewer);
    });
    if (!done) return fail(done.error().fault, write_event(event) + ": " + done.error().message);
  }
  for (int k = 0; k < frames_to_sharpen && interface.busy(); ++k)
    if (auto drawn = interface.frame_aside(frame_s); !drawn) return drawn;
  return interface.frame_aside(frame_s);
}

Result<BenchFigures> bench(Interface& interface, ViewerState& viewer, double seconds) {
  TRY_DO(rest(interface, viewer));
  if (!viewer.shell->any()) return fail(Fault::no_equilibrium, viewer.message);
  BenchFigures figures;
  const double begin = seconds_now();
  const int before = viewer.shell->equilibria;
  const double cpu = cpu_seconds_now();
  int frames = 0;
  for (double last = begin; last < begin + seconds;) {
    // there and back in four seconds, between half the path and its end
    const double phase = std::abs(std::remainder(last - begin, 4.0)) / 2;
    viewer.post(Move{1 - 0.5 * phase}, true);
    TRY_DO(interface.frame_aside(frame_s));
    const double now = seconds_now();
    if (now - begin > 1)
      figures.worst_frame_ms = std::max(figures.worst_frame_ms, 1e3 * (now - last));
    last = now;
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
  // the whole path and back, stopped soon after it began
  viewer.post(Move{0.01}, true);
  viewer.send_command(Move{1.0});
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  const double asked = seconds_now();
  viewer.engine.cancel();
  viewer.engine.wait();
  figures.cancel_ms = 1e3 * (seconds_now() - asked);
  return figures;
}

}  // namespace gridshell::window
