// MeshLevel: a shell on one mesh, with its model, the motion of its ends and the solver. LevelPlan:
// the meshes of a shell.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/shell_rods.h"
#include "engine/footprint/actuation.h"
#include "engine/solve/pinned_motion.h"
#include "engine/solve/turning_rods.h"

namespace gridshell {

/// A shell on one mesh. It must not be moved, since `system` refers to `model`.
struct MeshLevel {
  MeshLevel();
  ~MeshLevel();

  RodMesh mesh;
  const std::unique_ptr<Model>
      own_model;  // a pointer, so that this header does not include the model
  Model& model;
  PinnedMotion motion;
  std::unique_ptr<Linearisation> system;
  std::vector<TurningNodes> turning;  ///< rods that rotate about a line without force

  /// Builds mesh, model and solver for a number of edges per segment. Errors (bad_input): rods that
  /// the rod model does not support.
  Result<void> build(const Footprint& footprint, const ShellRods& rods, RodModel rod_model,
                     const BoundaryMotion& boundary, int edges_per_segment);
};

// Choice of the meshes from the requested accuracy.

/// Edges per segment of the meshes and their use: the last is followed, the others give its error.
struct LevelPlan {
  std::vector<int> edges_per_segment;  ///< coarse to fine, each twice the one before, at most three
  /// Whether positions, forces and energies are extrapolated from the last two meshes. A third mesh
  /// shows the error that remains; without it the estimate is that of the finer mesh alone.
  bool extrapolate = false;
  /// Largest error estimate, mm: a path ends at the first load step with a larger one, or if no
  /// coarser mesh has had a state over an interval `events_apart` of the path parameter.
  double allowed_mm = std::numeric_limits<double>::infinity();
  double events_apart = 0.05;

  bool operator==(const LevelPlan&) const = default;
};

/// The cheapest plan for a tolerance of the largest joint error, relative to the length scale. The
/// error of k edges falls as 1/k^2, extrapolated as 1/k^4, and is about 3e-3 at four edges for
/// shells of the paper's kind. The estimate shows afterwards whether the tolerance was met; `finer`
/// is the next plan to try. The meshes are multiples of `base` edges per segment, or of half of it.
/// `growth`: factor on the errors of shells whose rods are long.
LevelPlan plan_levels(double tolerance, int base = 4, double growth = 1);

/// The plan of a mesh with `edges` per segment and its nested coarser meshes, at most two, from
/// four edges up. If none is nested, there is one mesh and no error estimate.
LevelPlan plan_of_mesh(int edges);

/// Expected largest error estimate of a plan, over the length scale, before a run.
double expected_error(const LevelPlan& plan);

/// The plan with an additional mesh of twice as many edges, at most three meshes, extrapolated.
/// Empty if it would exceed 128 edges per segment.
std::optional<LevelPlan> finer(const LevelPlan& plan);

}  // namespace gridshell
