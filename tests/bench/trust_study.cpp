#include "tests/bench/trust_study.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/team.h"
#include "engine/scene/scene.h"

namespace gridshell::bench {
namespace {

using simulate::ExperimentResult;

constexpr int frames = 5, fine_frames = 9, other_frames = 8;

Trial try_scene(preset::Preset preset, int count, bool fine, const TrustOptions& options,
                const Watch& watch) {
  Trial trial;
  TimeLimit limit(options.seconds, watch);
  preset.movie.frames = count;
  auto scene = scene_of(preset);
  if (!scene) {
    trial.exit = 2;
    trial.refused = scene.error().message;
    return trial;
  }
  if (fine) {
    scene->base_edges = 5;
    scene->load_step = 0.5;
    scene->tolerance /= 8;
  }
  record::MemorySink sink;
  auto summary = simulate::run(preset, std::make_shared<const Scene>(std::move(*scene)), false,
                               sink, limit.watch());
  trial.too_slow = limit.ran_out();
  if (!summary) {
    trial.exit = summary.error().fault == Fault::bad_input ? 2 : 1;
    trial.refused = summary.error().message;
    return trial;
  }
  trial.outcome = ExperimentResult{std::move(sink.trajectory()), std::move(*summary)};
  trial.exit = trial.whole() && trial.outcome->summary.stable ? 0 : 1;
  return trial;
}

bool finite(const record::Frame& frame) {
  return frame.nodes.allFinite() && std::isfinite(frame.energies.total());
}

/// Whether a frame cannot be that of a shell and does not report it: numbers are not finite, its
/// rods stretch instead of bending, or the state is not stable and the frame has no event.
bool unphysical(const record::Frame& frame) {
  if (!finite(frame)) return true;
  if (frame.negative_pivots > 0 && frame.event.empty()) return true;
  const double bend = frame.energies[Term::bend], stretch = frame.energies[Term::stretch];
  return stretch > 0.2 * bend + 1e-3;
}

/// Largest distance between equal joints of two frames, over the length scale.
double distance(const ExperimentResult& a, const record::Frame& in_a, const record::Frame& in_b) {
  const Eigen::Index joints = Eigen::Index(a.trajectory.layout.joints.size());
  return (in_a.nodes.leftCols(joints) - in_b.nodes.leftCols(joints)).colwise().norm().maxCoeff() /
         a.trajectory.layout.length_scale_mm;
}

/// Finds the error that is largest relative to its estimate.
class WorstError {
 public:
  WorstError(double& error, double& estimate, double least)
      : error_(error), estimate_(estimate), least_(least) {}

  void take(double error, double estimate) {
    const double many = error / std::max(estimate, least_);
    unknown_ |= std::isnan(many);
    if (!(many > worst_)) return;
    worst_ = many;
    error_ = error;
    estimate_ = estimate;
  }
  /// Whether at least one error was taken, and all errors and estimates were known.
  bool known() const { return worst_ >= 0 && !unknown_; }

 private:
  double &error_, &estimate_;
  bool unknown_ = false;
  double least_, worst_ = -1;
};

double off_forces(const record::Frame& a, const record::Frame& b) {
  if (a.reactions_N.cols() != b.reactions_N.cols() || a.reactions_N.cols() == 0) return NAN;
  return (a.reactions_N - b.reactions_N).colwise().norm().maxCoeff();
}

double off_energies(const record::Frame& a, const record::Frame& b) {
  double largest = std::abs(a.energies.total() - b.energies.total());
  for (const TermName& term : energy_terms)
    largest = std::max(largest, std::abs(a.energies[term.term] - b.energies[term.term]));
  return largest;
}

constexpr double least_error = 1e-5;  // of forces and energies: smaller ones are residuals

/// Stores in the row the errors that are largest relative to their estimates, over all frames that
/// both runs have; returns whether there are such frames, and the errors of all joints are known.
bool compare(const ExperimentResult& requested, const ExperimentResult& fine, TrustRow& row) {
  WorstError joints(row.error, row.estimate, 1e-9);
  WorstError forces(row.force_error, row.force_estimate, least_error);
  WorstError energies(row.energy_error, row.energy_estimate, least_error);
  const double scale_mm = requested.trajectory.layout.length_scale_mm;
  // forces and energies are relative to the largest of the run, because those of flat rods are 0
  double force = 0, energy = 0;
  bool known = true;
  for (const record::Frame& other : fine.trajectory.frames) {
    known &= finite(other);
    if (other.largest_force_N > force) force = other.largest_force_N;
    energy = std::max(energy, std::abs(other.energies[Term::bend]));
  }
  for (const record::Frame& frame : requested.trajectory.frames)
    for (const record::Frame& other : fine.trajectory.frames) {
      if (std::abs(frame.progress - other.progress) > 1e-9) continue;
      // where the path ended early the frames are of other states
      if (frame.event == "locking" || other.event == "locking") continue;
      // the finer run is not exact either, so half of its estimate is added
      joints.take(distance(requested, frame, other),
                  (frame.error_estimate_mm + 0.5 * other.error_estimate_mm) / scale_mm);
      forces.take(off_forces(frame, other) / force,
                  (frame.force_error_N + 0.5 * other.force_error_N) / force);
      energies.take(off_energies(frame, other) / energy,
                    (frame.energy_error_mJ + 0.5 * other.energy_error_mJ) / energy);
    }
  return known && joints.known();
}

}  // namespace

TrustClass judge(const Trial& requested, const Trial& fine, const Trial& other, TrustRow& row) {
  constexpr double branch =
      0.02;  // fraction of the length scale: states further apart are different
  if (requested.too_slow) return TrustClass::too_slow;
  if (requested.exit == 2) return TrustClass::refused;
  if (!requested.outcome || !requested.whole())
    return !fine.outcome || !fine.whole() ? TrustClass::limited : TrustClass::limited_only_default;
  for (const record::Frame& frame : requested.outcome->trajectory.frames)
    if (unphysical(frame)) return TrustClass::inner_unphysical;
  const bool same_end =
      other.too_slow || (other.outcome && other.exit == requested.exit &&
                         distance(*requested.outcome, requested.outcome->trajectory.frames.back(),
                                  other.outcome->trajectory.frames.back()) < 1e-9);
  if (!same_end) return TrustClass::frame_dependent;
  const bool compared = fine.outcome && compare(*requested.outcome, *fine.outcome, row);
  if (!(row.error > 2 * row.estimate + 1e-7)) {
    const bool reported = !(row.force_error > 2 * row.force_estimate + least_error) &&
                          !(row.energy_error > 2 * row.energy_estimate + least_error);
    if (!reported) return TrustClass::estimate_small;
    return compared ? TrustClass::right : TrustClass::not_compared;
  }
  if (row.error < branch && row.error < 20 * row.estimate) return TrustClass::estimate_small;
  if (requested.snapped()) return TrustClass::after_snap;
  return requested.doubted() ? TrustClass::doubted : TrustClass::other_branch;
}

namespace {

TrustScene judged(int index, const TrustOptions& options, const Watch& watch) {
  const auto kind = options.kind.value_or(SceneKind(index % int(SceneKind::network)));
  // one generator per scene, so that any scene can be made alone
  std::mt19937 random{std::uint32_t(options.seed) * 100003u + std::uint32_t(index)};
  TrustScene scene;
  scene.preset = random_preset(kind, random);
  scene.preset.name = fmt::format("scene_{:04d}", index);
  scene.preset.title = fmt::format("Scene {} of the study of trust: {}", index, word_of(kind));
  scene.row.scene = index;
  scene.row.kind = word_of(kind);
  const Trial requested = try_scene(scene.preset, frames, false, options, watch);
  const Trial fine = try_scene(scene.preset, fine_frames, true, options, watch);
  const Trial other = try_scene(scene.preset, other_frames, false, options, watch);
  scene.row.exit_default = requested.exit;
  scene.row.exit_fine = fine.exit;
  scene.row.snap_default = requested.snapped();
  scene.row.snap_fine = fine.snapped();
  scene.row.doubt = requested.doubted();
  scene.row.found = judge(requested, fine, other, scene.row);
  scene.preset.movie.frames = frames;
  // the description is the reason why the run ended
  scene.preset.description =
      requested.outcome ? requested.outcome->summary.limit_reason : requested.refused;
  return scene;
}

}  // namespace

bool silently_wrong(TrustClass found) {
  return found == TrustClass::estimate_small || found == TrustClass::other_branch ||
         found == TrustClass::inner_unphysical || found == TrustClass::frame_dependent;
}

Result<std::vector<TrustScene>> trust_study(const TrustOptions& options, Watch& watch) {
  keep_blas_on_one_thread();
  std::vector<TrustScene> scenes(std::size_t(options.scenes));
  return parallel_for(
             options.scenes, options.threads, watch,
             [&](int k) { scenes[std::size_t(k)] = judged(k, options, watch); }, reporting(watch))
      .map([&] { return std::move(scenes); });
}

}  // namespace gridshell::bench
