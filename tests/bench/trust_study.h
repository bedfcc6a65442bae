// How reliable the reports of a run are: random scenes of every kind are solved by default, again
// with another number of frames, and finer: on meshes of another family (5, 10, 20 edges per
// segment instead of 4, 8, 16), with load steps of half the size and an eighth of the tolerance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/record/study_tables.h"
#include "engine/simulate/run.h"
#include "tests/bench/random_scenes.h"

namespace gridshell::bench {

/// Outcome of the comparison of the default run with the finer one.
enum class TrustClass {
  right,                 ///< the same states, within twice the estimate
  estimate_small,        ///< the same states, their distance more than twice the estimate
  other_branch,          ///< another state without a reported event: silently wrong
  after_snap,            ///< another state after a reported snap
  doubted,               ///< another state, with a report that its coarsest meshes disagree
  limited,               ///< both paths ended early, with a message
  limited_only_default,  ///< only the path of the default run ended early
  inner_unphysical,      ///< a frame cannot be that of a shell, and does not report it
  frame_dependent,       ///< with another number of frames the last state is another
  refused,               ///< the scene was refused with a reason
  not_compared,          ///< nothing wrong found, but a frame of both or all have no known error
  too_slow,              ///< stopped at the time limit
};

/// A run, and the exit code that the program would have.
struct Trial {
  std::optional<simulate::ExperimentResult> outcome;
  std::string refused;  ///< why there is no outcome
  int exit = 0;
  bool too_slow = false;

  bool whole() const {
    const auto limit = outcome->summary.limit;
    return limit == record::Limit::none || limit == record::Limit::snap;
  }
  bool snapped() const { return outcome && outcome->summary.limit == record::Limit::snap; }
  bool doubted() const { return outcome && !outcome->summary.doubt.empty(); }
};

/// Whether a user would have received a wrong result without a message.
bool silently_wrong(TrustClass found);

/// One scene.
struct TrustRow {
  int scene = 0;
  std::string kind;  ///< "circle", "push", ...
  TrustClass found = TrustClass::right;
  double error =
      record::unknown;  ///< largest distance of a joint in a frame of both, over the length scale
  double estimate = record::unknown;  ///< error estimate of that frame
  /// error and estimate of reactions, over the largest of the run, and of energies, over the
  /// largest bending energy of the run
  double force_error = record::unknown, force_estimate = record::unknown;
  double energy_error = record::unknown, energy_estimate = record::unknown;
  int exit_default = 0, exit_fine = 0;
  bool snap_default = false, snap_fine = false;  ///< whether a snap was reported
  bool doubt = false;  ///< whether the default reported that its coarsest meshes disagree

  /// Whether only one family of meshes reports a snap.
  bool snap_alone() const {
    return exit_default == 0 && exit_fine == 0 && snap_default != snap_fine;
  }
};
template <RecordOf<TrustRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  GRIDSHELL_VISIT(visit, row.scene, row.kind);
  visit("class", row.found);
  GRIDSHELL_VISIT(visit, row.error, row.estimate, row.force_error, row.force_estimate,
                  row.energy_error, row.energy_estimate, row.exit_default, row.exit_fine,
                  row.snap_default, row.snap_fine, row.doubt);
}

/// The class of a run by default, from a finer run and one with another number of frames; stores
/// the errors in the row.
TrustClass judge(const Trial& requested, const Trial& fine, const Trial& other, TrustRow& row);

struct TrustOptions {
  int scenes = 600;                 ///< of all kinds in turn, except networks
  std::optional<SceneKind> kind{};  ///< if given, the only kind of scenes
  int seed = 1;
  double seconds = 20;  ///< a longer run is too slow
  int threads = 2;
};

/// The outcome of a scene, and the preset that runs it again.
struct TrustScene {
  TrustRow row;
  preset::Preset preset;
};

/// Makes, runs and judges the scenes, in parallel. Errors: cancelled.
Result<std::vector<TrustScene>> trust_study(const TrustOptions& options, Watch& watch);

}  // namespace gridshell::bench
