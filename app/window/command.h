// What was done to a shell, step by step.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <variant>
#include <vector>

#include "engine/gridshell.h"

namespace gridshell::window {

/// In order; copies share the steps.
using StepHistory = std::vector<std::shared_ptr<const preset::Step>>;

/// As a preset has them.
std::vector<preset::Step> steps_of(const StepHistory& history);

// What can be done to the shell. The engine's thread executes one command after the other.

/// Another shell, formed along its path.
struct Open {
  preset::Preset preset;
};
/// Some keys of the preset are something else now.
struct Change {
  preset::Preset preset;
};
/// The boundary to a progress of its motion.
struct Move {
  double progress = 1;
};
/// Moves a joint to a position, with a constraint from then on: along a fixed direction, or (zero)
/// in every one.
struct Push {
  int joint = 0;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};
/// Lets go of a joint; of all (-1).
struct Release {
  int joint = -1;
};
/// Moves one edge point to a position.
struct DragEdge {
  int edge_point = 0;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};
/// One edge point back onto the boundary's motion; every one (-1).
struct ResetEdgePoint {
  int edge_point = -1;
};
/// Minimises the energy to an equilibrium, from a saddle to a side.
struct Rest {
  BranchSide side = BranchSide::lower;
};
/// Applies a random load and removes it again.
struct Jitter {
  int seed = 1;
};
/// The last step, or every one.
struct Undo {
  bool all = false;
};
struct Redo {};
/// Moves the ends or rods of the shell until it meets its surface; the steps are shown, and a
/// cancel leaves it in the last of them.
struct Design {
  preset::Inverse inverse;
  int most_iterations = 25;
};
/// What was designed is the shell now.
struct AcceptDesign {};
/// The shell before the design, to the bit.
struct DiscardDesign {};
/// One of the states that were found, to the bit.
struct Recall {
  int state = 0;
};
/// Nothing but the finer meshes that follow a drag.
struct RefineAfterDrag {};

using Edit = std::variant<Open, Change, Move, Push, Release, DragEdge, ResetEdgePoint, Rest, Jitter,
                          Undo, Redo, Design, AcceptDesign, DiscardDesign, Recall, RefineAfterDrag>;

/// Whether it is one of some kinds.
template <class... Kinds>
bool is_any(const Edit& edit) {
  return (std::holds_alternative<Kinds>(edit) || ...);
}

/// Commands of one drag (`drag`) are one step to undo. During a drag the shell is followed on its
/// coarsest mesh, and a newer command of the drag replaces one that is waiting.
struct Command {
  Edit edit;
  int drag = 0;  ///< 0: a step of its own
  bool passing = false;
};

// What a change of a preset's keys means for the edited shell.

/// What a change affects: pictures alone, the meshes, the position of the boundary, the rods and
/// their loads, or the complete shape, which is formed again.
enum class ChangeKind { none, looks, accuracy, boundary, rods, shape };

ChangeKind kind_of_change(const preset::Preset& before, const preset::Preset& after);

/// For a circle that has no room for its rods, the same rods in one whose radii are as large as
/// they need, with the longest leg over d and the ratio of the radii of `before`; null: not that,
/// or no circle helps.
std::shared_ptr<const preset::Preset> nearest_that_works(const preset::Preset& before,
                                                         preset::Preset refused);

/// Whether the keys agree with one another. Errors: bad_input, as of a file that says the same.
Result<void> check_preset(const preset::Preset& preset);

}  // namespace gridshell::window
