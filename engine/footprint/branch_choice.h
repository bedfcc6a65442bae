// What chooses among the states that a symmetric shell can go to.
#pragma once

namespace gridshell {

/// Which of the many buckled shapes a flat footprint is pushed towards.
struct BuckleSeed {
  double up = 1;        ///< +1 or -1
  double diagonal = 1;  ///< +1: the corners on y = x end up lower, -1: those on y = -x
};

/// What chooses where a path that loses its stability goes: the side on which the imperfection's
/// part along the modes that went soft points. It only chooses; every certified state is one of the
/// perfect shell.
struct Imperfection {
  double size_mm = 2e-3;  ///< with which a leaving branch is entered; 0: the path stays on the
                          ///< symmetric branch, through states that are not stable
  int seed = 1;
  /// false: a direction a joint, drawn from the seed; true: the softest mode itself, to one side of
  /// it with odd seeds and to the other with even ones
  bool soft_mode = false;

  bool chooses() const { return size_mm > 0; }
};

}  // namespace gridshell
