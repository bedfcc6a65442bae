// A run of a preset with steps: the shell is actuated, then a hand does one step after the other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/experiment/course.h"
#include "engine/preset/preset.h"
#include "engine/record/sink.h"

namespace gridshell::experiment {

/// How many of `frames` fall to each step, the first frame being the shell before them all: one to
/// each, and what is left to those that have a way to be shown, moves of the whole boundary and
/// pushes, evenly.
std::vector<int> frames_of_steps(const std::vector<preset::Step>& steps, int frames);

/// What became of the steps.
struct Stepped {
  Course course;
  std::vector<std::string> told = {};  ///< a sentence a step that was begun
};

/// Does the steps in order until one ends early, which is then the course's limit, and hands frames
/// to the sink: the shell before, and of each step as many as frames_of_steps() says, each
/// certified. They only sample the steps' ways. Meshes are chosen and events confirmed as for a
/// path (course.h). Errors: bad_input as take_step(), no_equilibrium (no shell to begin with),
/// cancelled, the sink's.
Result<Stepped> run_steps(const std::shared_ptr<const Scene>& scene,
                          const std::vector<preset::Step>& steps, int frames, record::Sink& sink,
                          Watch& watch);

}  // namespace gridshell::experiment
