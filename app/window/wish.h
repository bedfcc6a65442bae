// What a hand can wish of the shell. The engine's thread fulfils one wish after the other.
#pragma once

#include <Eigen/Core>
#include <variant>

#include "engine/preset/preset.h"
#include "engine/solve/rest.h"

namespace gridshell::window {

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
/// A joint to a place, held from now on: along a fixed direction, or (zero) in every one.
struct Push {
  int joint = 0;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};
/// Lets go of a joint; of all (-1).
struct Release {
  int joint = -1;
};
/// One edge point to a place.
struct DragEdge {
  int edge_point = 0;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};
/// One edge point back onto the boundary's motion; every one (-1).
struct PutEdgeBack {
  int edge_point = -1;
};
/// Down the energy to rest, off a saddle to a side.
struct Rest {
  Leave side = Leave::lower;
};
/// A random field comes on and goes away again.
struct Jitter {
  int seed = 1;
};
/// The last step, or every one.
struct Undo {
  bool all = false;
};
struct Redo {};
/// The ends or rods of the shell moved until it meets its surface; the steps on the way are seen,
/// and stopped it stands in the last of them.
struct Design {
  preset::Inverse inverse;
  int most_iterations = 25;
};
/// What was designed is the shell now.
struct KeepDesign {};
/// The shell before the design, to the bit.
struct PutBack {};
/// Nothing but the finer meshes that follow a stroke.
struct Settle {};

using Deed = std::variant<Open, Change, Move, Push, Release, DragEdge, PutEdgeBack, Rest, Jitter,
                          Undo, Redo, Design, KeepDesign, PutBack, Settle>;

/// Wishes of one stroke (a drag) are one step to undo. While a stroke passes, the shell is followed
/// on its coarsest mesh, and a newer wish of the stroke takes the place of one not yet begun.
struct Wish {
  Deed deed;
  int stroke = 0;  ///< 0: a step of its own
  bool passing = false;
};

}  // namespace gridshell::window
