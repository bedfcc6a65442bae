// The shell of a Session: formed as its preset says, then moved step by step. This file does not
// depend on Python.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gridshell.h"

namespace gridshell::python {

/// A state of a session or of a run, which never changes. Arrays in Python are views of it.
struct State {
  std::shared_ptr<const preset::Preset> preset;  ///< for the style of its pictures
  std::shared_ptr<const record::Layout> layout;
  record::Frame frame;
  Certificate certificate;
  std::vector<std::array<int, 2>> constrained = {};  ///< (i, j) of the constrained joints
  /// For each of them the unit vector along which it is constrained; NaN: in all directions.
  std::vector<std::array<double, 3>> directions = {};
  std::vector<record::LoadedJoint> pushed = {};  ///< those that were moved, which pictures mark
};

/// Result of a step.
struct Done {
  Report report;
  std::string reported = {};  ///< for the first actuation: the limit_reason that a run would report
};

/// A saved state of a shell, to return to.
struct Saved {
  std::shared_ptr<const Scene> scene;
  Checkpoint checkpoint;
  bool formed = false, as_drawn = false;
};

/// A shell that is moved step by step.
class Shell {
 public:
  /// The flat shell of a preset; a network drawn in space is in its drawn shape. Errors
  /// (bad_input): those of scene_of(); a preset with the model "net".
  static Result<Shell> open(const preset::Preset& preset);

  /// Moves the boundary. The first call forms the shell as a run of its preset does: it follows the
  /// same path, chooses the meshes by the tolerance and confirms events on finer ones. Errors:
  /// bad_input, no_equilibrium (also if the path ends early), cancelled; the shell is then in its
  /// last certified state.
  Result<Done> move(const preset::Step& step, const Watch& watch);
  /// Does a step with a shell that is formed. Errors: as move().
  Result<Done> take(const preset::Step& step, const Watch& watch);
  /// Refines the meshes until the error estimate is at most `tolerance_mm`; NaN: the tolerance of
  /// the preset. Errors: bad_input, no_equilibrium (the tolerance is not met), cancelled.
  Result<Done> refine(double tolerance_mm, const Watch& watch);

  /// The current state, to return to.
  Saved save() const;
  /// Returns to a saved state. Errors (bad_input): it is of another shell.
  Result<void> restore(const Saved& saved);

  const preset::Preset& preset() const { return *preset_; }
  const std::vector<int>& meshes() const { return session_->shell().plan().edges_per_segment; }
  /// The current state with its layout. Errors: those of layout_of().
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
  bool as_drawn_ = false;  // a network drawn in space to which nothing was done yet
};

}  // namespace gridshell::python
