#include "app/ui/playback.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "engine/core/clock.h"

namespace gridshell::ui {
namespace {

constexpr double frame_s = 1.0 / 60;
constexpr int most_frames = 2000;  // until nothing moves any more
constexpr int frames_to_sharpen = 30;

/// Frames until all events are taken, the engine rests and the view shows what it found.
Result<void> rest(Interface& interface, window::Desk& desk) {
  for (int k = 0; k < most_frames; ++k) {
    desk.engine.wait();
    desk.picture_work.wait();
    desk.movie_work.wait();
    if (auto drawn = interface.frame_aside(frame_s); !drawn) return drawn;
    const bool rests = desk.engine.idle() && desk.engine.sight() == desk.sight && !desk.playing &&
                       desk.picture_work.idle() && desk.movie_work.idle();
    if (rests && !interface.events_wait()) return {};
  }
  return {};
}

Result<void> wait_for(Interface& interface, window::Desk& desk, double seconds) {
  for (double t = 0; t < seconds; t += frame_s) {
    desk.engine.wait();
    if (auto drawn = interface.frame_aside(frame_s); !drawn) return drawn;
  }
  return {};
}

}  // namespace

Result<void> play(Interface& interface, window::Desk& desk,
                  const std::vector<window::InputEvent>& events) {
  if (auto first = rest(interface, desk); !first) return first;
  for (const window::InputEvent& event : events) {
    if (desk.over) break;
    const auto done = interface.take(event).and_then([&] {
      return event.kind == window::InputKind::wait ? wait_for(interface, desk, event.x)
                                                   : rest(interface, desk);
    });
    if (!done) return fail(done.error().fault, write_event(event) + ": " + done.error().message);
  }
  for (int k = 0; k < frames_to_sharpen && interface.busy(); ++k)
    if (auto drawn = interface.frame_aside(frame_s); !drawn) return drawn;
  return interface.frame_aside(frame_s);
}

Result<BenchFigures> bench(Interface& interface, window::Desk& desk, double seconds) {
  if (auto ready = rest(interface, desk); !ready) return tl::unexpected<Error>(ready.error());
  if (!desk.sight->any()) return fail(Fault::no_equilibrium, desk.message);
  BenchFigures figures;
  const double begin = seconds_now();
  const int before = desk.sight->equilibria;
  const double cpu = cpu_seconds_now();
  int frames = 0;
  for (double last = begin; last < begin + seconds;) {
    // there and back in four seconds, between half the path and its end
    const double phase = std::abs(std::remainder(last - begin, 4.0)) / 2;
    desk.move(1 - 0.5 * phase, true);
    if (auto drawn = interface.frame_aside(frame_s); !drawn)
      return tl::unexpected<Error>(drawn.error());
    const double now = seconds_now();
    if (now - begin > 1)
      figures.worst_frame_ms = std::max(figures.worst_frame_ms, 1e3 * (now - last));
    last = now;
    ++frames;
  }
  const double took = seconds_now() - begin;
  figures.interface_fps = frames / took;
  const int found = desk.engine.sight()->equilibria - before;
  const double own = cpu_seconds_now() - cpu;
  figures.equilibria_per_s = found / took;
  figures.frame_cpu_ms = 1e3 * own / frames;
  desk.engine.cancel();
  desk.engine.wait();
  // the whole path and back, stopped soon after it began
  desk.move(0.01, true);
  desk.wish(window::Move{1.0});
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  const double asked = seconds_now();
  desk.engine.cancel();
  desk.engine.wait();
  figures.cancel_ms = 1e3 * (seconds_now() - asked);
  return figures;
}

}  // namespace gridshell::ui
