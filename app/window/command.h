// Commands on the edited shell, and the kinds of changes that they are.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "engine/gridshell.h"

namespace gridshell::window {

/// The steps that were done to a shell, in order. Copies point to the same steps.
using StepHistory = std::vector<std::shared_ptr<const preset::Step>>;

std::vector<preset::Step> steps_of(const StepHistory& history);

// The edits of a shell. The engine's thread executes one command after the other.

/// Opens another shell, which is formed along its path.
struct Open {
  preset::Preset preset;
};
/// Replaces the preset by one with other values of some keys.
struct Change {
  preset::Preset preset;
  std::string remark = {};  ///< for the message of its result
};
/// Moves the boundary to a progress of its motion.
struct Move {
  double progress = 1;
};
/// Moves a joint to a position and constrains it: along the direction `along`, or, if that is zero,
/// in every direction.
struct Push {
  int joint = 0;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};
/// Releases a joint, or all of them (-1).
struct Release {
  int joint = -1;
};
/// Moves one edge point to a position.
struct DragEdge {
  int edge_point = 0;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};
/// Moves a dragged edge point, or all of them (-1), back onto the boundary's motion.
struct ResetEdgePoint {
  int edge_point = -1;
};
/// Minimises the energy to a stable equilibrium; from an unstable one it starts towards `side`.
struct Rest {
  BranchSide side = BranchSide::lower;
};
/// Applies a random load and removes it again.
struct Jitter {
  int seed = 1;
};
/// Undoes the last step, or all of them.
struct Undo {
  bool all = false;
};
/// Does the last undone step again.
struct Redo {};
/// Changes the ends or rods of the shell until it meets its surface. The steps are shown; if it is
/// cancelled, the last of them remains.
struct Design {
  preset::Inverse inverse;
  int most_iterations = 25;
};
/// Continues with the designed shell.
struct AcceptDesign {};
/// Restores the shell before the design, bit for bit.
struct DiscardDesign {};
/// Restores one of the states that were found, bit for bit.
struct Recall {
  int state = 0;
};
/// Ends a drag: no edit, but finer meshes follow.
struct RefineAfterDrag {};

using Edit = std::variant<Open, Change, Move, Push, Release, DragEdge, ResetEdgePoint, Rest, Jitter,
                          Undo, Redo, Design, AcceptDesign, DiscardDesign, Recall, RefineAfterDrag>;

/// Whether an edit is of one of these kinds.
template <class... Kinds>
bool is_any(const Edit& edit) {
  return (std::holds_alternative<Kinds>(edit) || ...);
}

/// An edit and the drag that it belongs to. Commands of one drag are one step to undo. A `passing`
/// command is one of a drag that continues: a large shell is then followed on its coarsest mesh,
/// and a newer command of the drag replaces a waiting one.
struct Command {
  Edit edit;
  int drag = 0;  ///< number of the drag; 0: none
  bool passing = false;
};

// Changes of the preset's keys, and what they require of the edited shell.

/// What a change affects: pictures alone, the meshes, the position of the boundary, the rods and
/// their loads, or the complete shape, which is formed again.
enum class ChangeKind { none, looks, accuracy, boundary, rods, shape };

/// The kind of the change between two presets; changes of two kinds at once form the shell again.
ChangeKind kind_of_change(const preset::Preset& before, const preset::Preset& after);

/// A preset that works instead of a refused one: a circle too small for its rods gets radii with
/// the longest leg over d and the ratio of radii of `before`. Null if either footprint is no
/// circle, or if that preset is refused, too.
std::shared_ptr<const preset::Preset> nearest_that_works(const preset::Preset& before,
                                                         preset::Preset refused);

/// Checks that the keys agree with one another. Errors: bad_input, as for a file with these keys.
Result<void> check_preset(const preset::Preset& preset);

}  // namespace gridshell::window
