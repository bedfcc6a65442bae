// The bifurcation diagram of a preset: its path by arc length, where it loses and regains its
// stability, and the branches that leave there.
#pragma once

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/branches.h"

namespace gridshell::study {

struct BranchesOptions {
  int most_branches = 13;  ///< the path itself among them
  int most_steps = 200;    ///< of a branch
};

/// A diagram, on one mesh.
struct BranchDiagram {
  std::vector<record::BranchPoint> points;
  int edges_per_segment = 0;
  int symmetry_order = 0;  ///< of the path's symmetry, 1 to 8; the amplitude is of what breaks it
  double original_radius_mm = record::unknown;  ///< R_o of a circular boundary
  bool of_push = false;                         ///< progress is that of the push
  bool all_followed = true;                     ///< false: more branches were found than followed
};

/// Follows the actuation (from the first buckled state towards the flat and on to the end, or from
/// the net backwards), or the push after it, on the finest mesh that the tolerance begins with. At
/// every bifurcation the branches along the modes that went soft are entered on both sides
/// [Keller 1977], each once: `imperfection` chooses nothing here. Errors: bad_input for a preset of
/// which nothing is solved, whose path has no begin or whose actuation ends before the push;
/// no_equilibrium; cancelled.
Result<BranchDiagram> branches_study(const preset::Preset& preset, const BranchesOptions& options,
                                     Watch& watch);

}  // namespace gridshell::study
