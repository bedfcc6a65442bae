// A shell on one mesh: its model, how its ends move, and what is solved with.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/shell_rods.h"
#include "engine/footprint/actuation.h"
#include "engine/solve/pinned_motion.h"

namespace gridshell {

/// Stays where it was made: `system` refers to `model`.
struct MeshLevel {
  MeshLevel();
  ~MeshLevel();

  RodMesh mesh;
  const std::unique_ptr<Model> own_model;  // what a model is, few who have a level need to know
  Model& model;
  PinnedMotion motion;
  std::unique_ptr<Linearisation> system;

  /// Builds mesh, model and solver for a number of edges per segment. Errors (bad_input): rods that
  /// the rod model does not support.
  Result<void> build(const Footprint& footprint, const ShellRods& rods, RodModel rung,
                     const BoundaryMotion& boundary, int edges_per_segment);
};

// Choice of the meshes from the requested accuracy.

/// Which meshes are solved and how they are used: the last is followed, those before measure it.
struct LevelPlan {
  std::vector<int> edges_per_segment;  ///< coarse to fine, each twice the one before, at most three
  bool extrapolate = false;  ///< over the last two (needs three, the third for the estimate)
  /// Whether forces and energies are extrapolated, also from two meshes: their error is then far
  /// below the estimate.
  bool extrapolate_forces = extrapolate;
  /// A path ends at the first load step whose estimate is above this, mm, or before which no
  /// companion has had a state over so much of the path parameter.
  double allowed_mm = std::numeric_limits<double>::infinity();
  double events_apart = 0.05;

  bool operator==(const LevelPlan&) const = default;
};

/// The cheapest plan for a tolerance of the largest joint error, relative to the length scale. The
/// error of k edges falls as 1/k^2, extrapolated as 1/k^4, and is about 3e-3 at four edges for
/// shells of the paper's kind. The estimate shows afterwards whether the tolerance was met; `finer`
/// is the next plan to try. The meshes are multiples of `base` edges per segment.
LevelPlan plan_levels(double tolerance, int base = 4);

/// A mesh of `edges` per segment with the companions that nest in it, at most two, from four edges
/// up. Where none nests in it there is one mesh, and no estimate of its error.
LevelPlan plan_of_mesh(int edges);

/// What a plan leaves of the largest joint error, over the length scale, as a rule: for plans
/// before a run.
double expected_error(const LevelPlan& plan);

/// The plan that follows a mesh of twice the edges, extrapolated. Empty when it would pass 128
/// edges per segment.
std::optional<LevelPlan> finer(const LevelPlan& plan);

}  // namespace gridshell
