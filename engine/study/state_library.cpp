#include "engine/study/state_library.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/simulate/expected_cost.h"
#include "engine/simulate/frames.h"

namespace gridshell::study {

using namespace simulate;

namespace {

// energies of one state differ by round-off and by the tolerance of its joints; relative
constexpr double same_energy = 1e-3;

// fractions of the progress after which these phases are complete
constexpr double perturbed = 0.55, measured = 0.8, followed = 0.9;

/// The end of a trial: its state or its error.
struct Trial {
  Result<State> rest = stopped();
  double energy_mJ = 0, cpu_s = 0;
};

double tolerance_mm(const Scene& scene, const preset::SearchSettings& jitter) {
  return jitter.tolerance * scene.footprint.spacing;
}

Eigen::Matrix3Xd joints_of(const Scene& scene, const Eigen::Matrix3Xd& nodes) {
  return nodes.leftCols(Eigen::Index(scene.footprint.joints.size()));
}

Result<std::vector<Trial>> shake(const std::shared_ptr<const Scene>& scene,
                                 const preset::SearchSettings& jitter, int threads, Watch& watch) {
  TRY(forms, forms_to_shake(scene, jitter, watch));
  std::vector<Trial> trials(std::size_t(jitter.trials + jitter.confined));
  const auto try_one = [&](StateSearcher& hand, int k) {
    Trial& trial = trials[std::size_t(k)];
    const double begin = cpu_seconds_now();
    trial.rest =
        k < jitter.trials ? hand.trial(k, watch) : hand.symmetric_trial(k - jitter.trials, watch);
    trial.cpu_s = cpu_seconds_now() - begin;
    if (trial.rest) trial.energy_mJ = hand.energy_of(*trial.rest);
  };
  return parallel_for(
             int(trials.size()), threads, watch,
             [&] { return StateSearcher::make(scene, jitter, *forms); }, try_one,
             reporting(watch, 0, perturbed))
      .map([&] { return std::move(trials); });
}

/// The distinct states among the ends of trials, in the order of trials, which does not depend on
/// the threads.
std::vector<ShellState> distinct_states(const Scene& scene, const preset::SearchSettings& jitter,
                                        const std::vector<MeshSymmetry>& symmetries,
                                        std::vector<Trial> trials, record::StateSearch& search) {
  StateCatalogue book(symmetries, tolerance_mm(scene, jitter));
  std::vector<ShellState> met;
  for (std::size_t k = 0; k < trials.size(); ++k) {
    Trial& trial = trials[k];
    const bool confined = k >= std::size_t(jitter.trials);
    search.cpu_s += trial.cpu_s;
    if (!trial.rest) {
      ++search.ended_otherwise[trial.rest.error().message];
      continue;
    }
    ++(confined ? search.confined_at_rest : search.at_rest);
    const std::size_t at = book.enter(joints_of(scene, trial.rest->x), trial.energy_mJ);
    if (at == met.size()) met.push_back({{}, {}, std::move(*trial.rest), trial.energy_mJ});
    ++(confined ? met[at].row.count_confined : met[at].row.count);
  }
  search.states_found = int(met.size());
  return met;
}

tl::unexpected<Error> none_found(const record::StateSearch& search) {
  std::string why;
  for (const auto& [reason, count] : search.ended_otherwise)
    why += fmt::format("; {} {}", count, reason);
  const int trials = search.trials + search.confined_trials;
  if (search.states_found == 0)
    return fail(Fault::no_equilibrium, "none of {} trials ended in a stable state{}", trials, why);
  return fail(Fault::no_equilibrium,
              "finer meshes have none of the stable states in which {} of {} trials ended{}",
              search.at_rest + search.confined_at_rest, trials, why);
}

using Measures = std::vector<std::optional<ShellState>>;

/// Adds the states that exist on finer meshes to the library, each once, in the order of energy.
void keep(const Scene& scene, const preset::SearchSettings& jitter,
          const std::vector<MeshSymmetry>& symmetries, Measures& all, StateLibrary& library) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k]) order.push_back(k);
  library.search.states_that_finer_meshes_lose = int(all.size() - order.size());
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return all[k]->row.energy_mJ(); });
  StateCatalogue book(symmetries, tolerance_mm(scene, jitter));
  for (const std::size_t k : order) {
    ShellState& one = *all[k];
    library.effort += one.effort;
    const std::size_t at = book.enter(joints_of(scene, one.frame.nodes), one.row.energy_mJ());
    if (at == library.states.size()) {
      one.row.state = int(at) + 1;
      one.frame.index = int(at);
      one.frame.event = fmt::format("state {}: {}", one.row.name(), one.row.group);
      library.states.push_back(std::move(one));
    } else {
      ++library.search.states_that_finer_meshes_merge;
      library.states[at].row.count += one.row.count;
      library.states[at].row.count_confined += one.row.count_confined;
    }
  }
}

RichnessEstimate completeness_of(const std::vector<ShellState>& states) {
  std::vector<int> counts;
  for (const ShellState& state : states) counts.push_back(state.row.count);
  return chao1(counts);
}

/// Measures the states that trials found and adds them to the library.
Result<void> measure(const std::shared_ptr<const Scene>& scene,
                     const preset::SearchSettings& jitter, const SearchOptions& options,
                     const std::vector<ShellState>& met, StateLibrary& library, Watch& watch) {
  const auto make = [&] { return StateMeasures::make(scene, tolerance_mm(*scene, jitter)); };
  TRY(first, make());
  Measures all(met.size());
  TRY_DO(parallel_for(
      int(met.size()), options.threads, watch, make,
      [&](StateMeasures& measures, int k) {
        all[std::size_t(k)] = measures.of(met[std::size_t(k)], options.lives, watch);
      },
      reporting(watch, perturbed, measured)));
  keep(*scene, jitter, first->symmetries(), all, library);
  const NestedShell& shell = first->session().shell();
  TRY(layout, layout_of(first->session()));
  library.layout = std::move(*layout);
  library.edges_per_segment = shell.plan().edges_per_segment.back();
  library.dof = shell.model(shell.levels() - 1).dof();
  library.search.completeness = completeness_of(library.states);
  return {};
}

}  // namespace

StateCatalogue::StateCatalogue(std::vector<MeshSymmetry> symmetries, double tolerance_mm)
    : symmetries_(std::move(symmetries)), tolerance_mm_(tolerance_mm) {}

std::optional<std::size_t> StateCatalogue::find(const Eigen::Matrix3Xd& joints,
                                                double energy_mJ) const {
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Entry& entry = entries_[k];
    if (std::abs(entry.energy_mJ - energy_mJ) > same_energy * std::abs(entry.energy_mJ)) continue;
    for (const MeshSymmetry& symmetry : symmetries_)
      if (distance_under(symmetry, entry.joints, joints) < tolerance_mm_) return k;
  }
  return std::nullopt;
}

std::size_t StateCatalogue::enter(const Eigen::Matrix3Xd& joints, double energy_mJ) {
  if (const auto known = find(joints, energy_mJ)) return *known;
  entries_.push_back({joints, energy_mJ});
  return entries_.size() - 1;
}

Result<StateLibrary> find_states(const std::shared_ptr<const Scene>& scene,
                                 const preset::SearchSettings& jitter, const SearchOptions& options,
                                 Watch& watch) {
  if (scene->rod_model == RodModel::net)
    return invalid("the net model has no states: nothing is solved on it");
  TRY_DO(fits_memory(*scene, measuring_plan(*scene)));
  StateLibrary library;
  record::StateSearch& search = library.search;
  search.mode = word_of(jitter.mode);
  search.seed = jitter.seed;
  search.trials = jitter.trials;
  search.confined_trials = jitter.confined;
  search.judged_edges_per_segment = judged_edges;
  TRY(trials, shake(scene, jitter, options.threads, watch));
  const RodMesh mesh = mesh_rods(scene->footprint, judged_edges);
  const auto symmetries = symmetries_of_shell(
      *scene, mesh, symmetries_of(mesh, pinned_motion(mesh, scene->motion).at(1)));
  const std::vector<ShellState> met =
      distinct_states(*scene, jitter, symmetries, std::move(*trials), search);
  if (met.empty()) return none_found(search);
  TRY_DO(measure(scene, jitter, options, met, library, watch));
  if (library.states.empty()) return none_found(search);
  return library;
}

record::Summary summary_of(const preset::Preset& preset, const Scene& scene,
                           const StateLibrary& library) {
  record::Summary s = summary_before(preset, scene);
  s.edges_per_segment = library.edges_per_segment;
  s.dof = library.dof;
  s.newton_iterations = library.effort.newton_iterations;
  s.factorizations = library.effort.factorizations;
  s.take_state(library.states.front().frame);
  return s;
}

Result<StateSearchRun> run_states(const preset::Preset& preset, int threads, record::Sink& sink,
                                  Watch& watch) {
  const double begin = seconds_now();
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  const double setup = seconds_now() - begin;
  TRY(library, find_states(scene, preset.jitter, {.threads = threads}, watch));
  TRY(found,
      transitions_between(*library, scene, preset.jitter, threads, measured, followed, watch));
  std::vector<record::Barrier> barriers;
  if (preset.jitter.barriers) {
    TRY(found, barriers_between(*library, scene, preset.jitter, threads, followed, 1, watch));
    barriers = std::move(*found);
  }
  TRY_DO(sink.begin(library->layout));
  StateSearchRun run;
  run.summary = summary_of(preset, *scene, *library);
  for (ShellState& state : library->states) {
    run.tables.rows.push_back(state.row);
    TRY_DO(sink.take(std::move(state.frame)));
  }
  run.tables.search = library->search;
  run.tables.transitions = std::move(*found);
  run.tables.barriers = std::move(barriers);
  run.summary.seconds_setup = setup;
  run.summary.seconds_simulation = seconds_now() - begin - setup;
  return run;
}

}  // namespace gridshell::study
