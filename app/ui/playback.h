// The interface without a hand: a recording played off-screen, and the bench that drags by itself.
#pragma once

#include <vector>

#include "app/ui/interface.h"

namespace gridshell::ui {

/// Plays events one by one, each with the equilibrium that it asks for awaited: the same states on
/// every machine. Ends with the view sharp. Errors: those of the events and the renderer, naming
/// the event.
Result<void> play(Interface& interface, window::Desk& desk,
                  const std::vector<window::InputEvent>& events);

/// What a bench measured.
struct BenchFigures {
  double interface_fps = 0, equilibria_per_s = 0, worst_frame_ms = 0, cancel_ms = 0;
  /// of the processor's own time, on a machine that does something else as well
  double frame_cpu_ms = 0;
};

/// Drags the radius to and fro for so many seconds with the engine on its own thread; frames of the
/// first second are no worst ones. Errors: no_equilibrium where the preset has no shell; the
/// renderer's.
Result<BenchFigures> bench(Interface& interface, window::Desk& desk, double seconds);

}  // namespace gridshell::ui
