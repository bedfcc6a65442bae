// What is known of the paths that a shell came along: where no shell stays, and where something
// happened. A branch may lose its stability and have it again before a step of the hand ends; the
// pivots of the load steps in between tell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/gridshell.h"

namespace gridshell::window {

/// A piece of a path, or one place on it. Of the boundary's path places are its progress, 0 at the
/// original and 1 at the actuated boundary; of the push of a joint how far it is from where it was
/// taken, mm.
struct PathMark {
  double from = 0, to = 0;  ///< from <= to
  int joint = -1;           ///< that is pushed; -1: the boundary moves
  bool unstable = false;    ///< no state between is stable; else something happened at `from`
  std::string what = {};
};

/// The marks of a path by the pivots of its load steps and by its events; `place` takes the path
/// parameter to the place. Between a load step that is stable and one that is not, stability ends
/// where an event says so; else the stretch ends at the one that is not, as far as it is known.
std::vector<PathMark> marks_of(const PathRecord& path, const std::vector<Event>& events, int joint,
                               const std::function<double(double)>& place);

/// Adds them. Stretches of the same kind and joint that meet or overlap are one, which reaches from
/// the first begin to the last end: ways there and back are marked once.
void add_marks(std::vector<PathMark>& marks, const std::vector<PathMark>& more);

/// "the path lost its stability; came to rest in another state" of what a step came past.
std::string text_of_events(const std::vector<Event>& events);

/// "124.2 to 122.9" of a stretch, one number of a place, by what `shown` makes of places.
std::string text_of_place(const PathMark& mark, const std::function<double(double)>& shown);

}  // namespace gridshell::window
