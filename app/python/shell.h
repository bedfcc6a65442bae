// The shell of a Python program: formed as its preset says, then moved step by step. It does not
// depend on Python.
// no Python.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gridshell.h"

namespace gridshell::python {

/// One state, of a session or of a run, which never changes: what arrays look into.
struct State {
  std::shared_ptr<const preset::Preset> preset;  ///< how its pictures look
  std::shared_ptr<const record::Layout> layout;
  record::Frame frame;
  Certificate certificate;
  std::vector<std::array<int, 2>> held = {};  ///< (i, j) of the constrained joints
  /// The unit vector along which each of them is constrained and was first pushed; NaN: in all
  /// directions.
  std::vector<std::array<double, 3>> directions = {};
  std::vector<record::LoadedJoint> pushed =
      {};  ///< those of them that were moved, as pictures show
};

/// Result of a step.
struct Done {
  Report report;
  std::string reported =
      {};  ///< of the forming: what a run would report as its limit; empty: nothing
};

/// A state to go back to, of one shell.
struct Kept {
  std::shared_ptr<const Scene> scene;
  Checkpoint checkpoint;
  bool formed = false;
};

class Shell {
 public:
  /// Flat. Errors (bad_input): as scene_of(); a preset that asks for the net alone.
  static Result<Shell> open(const preset::Preset& preset);

  /// Forms the shell along the path that a run of its preset follows, with meshes chosen and events
  /// confirmed, to a progress; for a formed shell this is an ordinary step. Errors: bad_input,
  /// no_equilibrium (also if the path ends early), cancelled; the shell is in the last certified
  /// state.
  Result<Done> move(const preset::Step& step, const Watch& watch);
  /// Does a step. Errors as move().
  Result<Done> take(const preset::Step& step, const Watch& watch);
  /// Finer meshes until the error estimate is below `tolerance_mm`; not a number: as the preset has
  /// it. Errors: bad_input, no_equilibrium (the tolerance is not met), cancelled.
  Result<Done> refine(double tolerance_mm, const Watch& watch);

  Kept save() const;
  /// Errors (bad_input): a state of another shell.
  Result<void> restore(const Kept& kept);

  const preset::Preset& preset() const { return *preset_; }
  const std::vector<int>& meshes() const { return session_->shell().plan().edges_per_segment; }
  /// The current state.
  Result<State> look();

 private:
  Shell(std::shared_ptr<const preset::Preset> preset, std::shared_ptr<const Scene> scene)
      : preset_(std::move(preset)), scene_(std::move(scene)) {}
  Result<Done> form(double progress, const Watch& watch);
  Result<Done> ended(const std::string& what, Report report) const;

  std::shared_ptr<const preset::Preset> preset_;
  std::shared_ptr<const Scene> scene_;
  std::optional<Simulation> session_;
  std::shared_ptr<const record::Layout> layout_;
  int layout_nodes_ = 0;
  bool formed_ = false;
  bool as_drawn_ = false;  // a network in space to which nothing was done yet
};

}  // namespace gridshell::python
