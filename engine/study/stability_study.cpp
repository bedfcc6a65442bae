// The cells of each map, and how their outcomes are judged.

#include "engine/study/method_studies.h"

#include <cmath>
#include <mutex>

#include "engine/core/parallel.h"
#include "engine/core/team.h"
#include "engine/core/try.h"
#include "engine/study/benchmark_methods.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;

/// A map under construction: its axes, and the run of every method at (x, y).
class Map {
 public:
  using Try = std::function<RunOutcome(double x, double y, const Watch&)>;

  std::function<void(Watch&)> prepare = {};  ///< of all its cells

  Map(const char* name, const char* x_name, Axis x, const char* y_name, Axis y)
      : row_{name, "", x_name, 0, y_name, 0, {}}, x_(std::move(x)), y_(std::move(y)) {}

  void add(std::string_view method, Try run) { methods_.emplace_back(method, std::move(run)); }
  Cells cells() const {
    Cells all;
    for (const double y : y_)
      for (const double x : x_)
        for (const auto& [method, run] : methods_) {
          Cell& cell = all.emplace_back(
              Cell{row_, [=, run = run](const Watch& watch) { return run(x, y, watch); }, prepare});
          cell.row.method = method;
          cell.row.x = x;
          cell.row.y = y;
        }
    return all;
  }

 private:
  record::StabilityRow row_;
  Axis x_, y_;
  std::vector<std::pair<std::string, Try>> methods_;
};

/// Outcome of a method on one mesh, judged on that mesh.
template <class Run>
RunOutcome on_mesh(const SharedProblem& study, double edges, double promised, const Run& run) {
  const auto problem = study->problem(int(edges), unwatched);
  if (!problem) return RunOutcome::refused;
  return verdict_of(*study, run(**problem), promised, promised, unwatched);
}

RunOutcome newton_outcome(const SharedProblem& study, double edges, const MarchOptions& options,
                          double promised, const Watch& watch) {
  return on_mesh(study, edges, promised,
                 [&](const Problem& problem) { return march(problem, options, watch); });
}

/// Outcome of the default solver. With a tolerance it is judged by the error that this promises.
RunOutcome default_outcome(const SharedProblem& study, const FollowOptions& options,
                           const Watch& watch) {
  const MethodResult result = follow_path(*study, options, watch);
  // methods on one mesh are not judged by the error of their mesh, so no smaller error than
  // theirs is required of the default
  const double promised =
      options.refine ? std::max(options.tolerance, claimed_error) : claimed_error;
  return verdict_of(*study, result, result.whole_mesh ? claimed_error : promised, promised,
                    unwatched);
}

constexpr Globalisation globalisations[] = {Globalisation::none, Globalisation::line_search,
                                            Globalisation::shifted};

using MakeProblem = std::function<Result<std::unique_ptr<BenchmarkProblem>>(Watch&)>;

/// What cells share, made by the first of them that is prepared.
template <class T>
struct Shared {
  std::once_flag once;
  T value = {};
};

/// Adds the cells of one x, which has a problem of its own, over load steps: Newton's method with
/// full steps and shifted, and the default solver.
void add_load_steps(const char* map_name, const char* x_name, double x, const Axis& load_steps,
                    int edges, MakeProblem make, Cells& cells) {
  const auto shared = std::make_shared<Shared<SharedProblem>>();
  Map map(map_name, x_name, {x}, "load_steps", load_steps);
  map.prepare = [=](Watch& watch) {
    std::call_once(shared->once, [&] {
      if (auto made = make(watch)) shared->value = std::move(*made);
    });
  };
  // without a reference the outcome is `refused`: the default solver reports why
  for (const Globalisation how : {Globalisation::none, Globalisation::shifted})
    map.add(word_of(how), [=](double, double steps, const Watch& watch) {
      const SharedProblem& study = shared->value;
      if (!study) return RunOutcome::refused;
      return newton_outcome(study, edges, {int(steps), how}, claimed_error, watch);
    });
  map.add(default_solver, [=](double, double steps, const Watch& watch) {
    const SharedProblem& study = shared->value;
    if (!study) return RunOutcome::refused;
    return default_outcome(study, {plan_levels(1e-3), 1e-3, true, int(steps)}, watch);
  });
  std::ranges::move(map.cells(), std::back_inserter(cells));
}

}  // namespace

Cells explicit_map(const SharedProblem& study, const Axis& steps, const Axis& edges) {
  Map map("explicit step", "step over l/c", steps, "edges_per_segment", edges);
  map.add(word_of(Relaxation::explicit_damped), [=](double step, double k, const Watch& watch) {
    return on_mesh(study, k, claimed_error, [&](const Problem& problem) {
      return check_explicit_step(problem, step, watch);
    });
  });
  return map.cells();
}

Cells relaxation_map(const SharedProblem& study, const Axis& steps, const Axis& edges) {
  Map map("relaxation step", "step over its limit", steps, "edges_per_segment", edges);
  map.add(word_of(Relaxation::kinetic), [=](double step, double k, const Watch& watch) {
    return on_mesh(study, k, claimed_error,
                   [&](const Problem& problem) { return relax(problem, {.step = step}, watch); });
  });
  return map.cells();
}

Cells newton_map(const SharedProblem& study, const Axis& load_steps, const Axis& edges) {
  Map map("load steps", "load_steps", load_steps, "edges_per_segment", edges);
  for (const Globalisation how : globalisations)
    map.add(word_of(how), [=](double steps, double k, const Watch& watch) {
      return newton_outcome(study, k, {int(steps), how}, claimed_error, watch);
    });
  map.add(default_solver, [=](double steps, double k, const Watch& watch) {
    return default_outcome(study, {.plan = plan_of_mesh(int(k)), .stops = int(steps)}, watch);
  });
  return map.cells();
}

Cells tolerance_map(const SharedProblem& study, const Axis& tolerances, const Axis& load_steps,
                    int edges) {
  // the requested accuracy is the promised one
  const double scale = study->scale_mm();
  Map map("tolerance", "tolerance_mm", tolerances, "load_steps", load_steps);
  for (const Globalisation how : globalisations)
    map.add(word_of(how), [=](double tolerance, double steps, const Watch& watch) {
      return newton_outcome(study, edges, {int(steps), how, tolerance}, tolerance / scale, watch);
    });
  map.add(default_solver, [=](double tolerance, double steps, const Watch& watch) {
    const double promised = tolerance / scale;
    return default_outcome(study, {plan_levels(promised), promised, true, int(steps)}, watch);
  });
  return map.cells();
}

Cells stiffness_map(const preset::Preset& preset, const Axis& scales, const Axis& load_steps,
                    int edges) {
  Cells cells;
  for (const double scale : scales) {
    const auto make = [=](Watch& watch) {
      return BenchmarkProblem::create(preset, 16, watch, scale);
    };
    add_load_steps("EA", "EA over the rods'", scale, load_steps, edges, make, cells);
  }
  return cells;
}

Cells leg_map(const preset::Preset& preset, const Axis& legs, const Axis& load_steps, int edges) {
  Cells cells;
  if (preset.footprint.kind != preset::FootprintKind::circle) return cells;
  for (const double leg : legs) {
    preset::Preset cut = preset;
    // the shortest leg is that of the outermost rod, from its last joint to the boundary
    const double d = preset.footprint.spacing_mm, outermost = (preset.footprint.rods - 1) / 2.0;
    const double original = preset.original_radius_mm();
    const double reach =
        std::sqrt(std::max(0.0, std::pow(original / d, 2) - outermost * outermost));
    const double first = preset.footprint.rods % 2 ? 0 : 0.5;
    const double last = first + std::max(0.0, std::floor(reach - first));
    const double radius = d * std::hypot(outermost, last + leg);
    cut.set_radii(radius, preset.actuated_radius_mm() * radius / original);
    const auto make = [=](Watch& watch) { return BenchmarkProblem::create(cut, 16, watch); };
    add_load_steps("shortest leg", "leg over d", leg, load_steps, edges, make, cells);
  }
  return cells;
}

Cells seed_map(const SharedProblem& study, const Axis& heights, const Axis& edges) {
  Map map("seed", "seed_mm", heights, "edges_per_segment", edges);
  const auto add = [&](std::string_view method, auto run) {
    map.add(method, [=](double height, double k, const Watch& watch) {
      const auto problem = study->problem(int(k), unwatched);
      if (!problem) return RunOutcome::refused;
      const Problem flat = from_flat(*study, **problem, height);
      const MethodResult result = run(flat, **problem, watch);
      if (result.claim != RunOutcome::right) return result.claim;
      return verdict_at_end(*study, flat, result.x, claimed_error);
    });
  };
  for (const Globalisation how : globalisations)
    add(word_of(how), [how](const Problem& flat, const Problem&, const Watch& watch) {
      return march(flat, {1, how}, watch);
    });
  // the default solver has a seed of its own, so the height has no effect
  add(default_solver, [study](const Problem&, const Problem& problem, const Watch& watch) {
    return buckle(*study, problem, watch);
  });
  return map.cells();
}

Cells joint_map(const SharedProblem& study, const Axis& stiffnesses, const Axis& load_steps,
                int edges) {
  Cells cells;
  for (const double stiffness : stiffnesses) {
    const auto truth = std::make_shared<Shared<MethodResult>>();
    const ModelVariant springs{RodModel::twist, stiffness};
    Map map("joint stiffness", "stiffness_N_per_mm", {stiffness}, "load_steps", load_steps);
    map.prepare = [=](Watch& watch) {
      std::call_once(truth->once, [&] {
        if (const auto problem = study->problem(edges, watch))
          truth->value = march(study->on_model(**problem, springs), {60}, watch);
      });
    };
    for (const Globalisation how : {Globalisation::none, Globalisation::shifted})
      map.add(word_of(how), [=](double, double steps, const Watch& watch) {
        const auto problem = study->problem(edges, unwatched);
        if (!problem) return RunOutcome::refused;
        const Problem joined = study->on_model(**problem, springs);
        const MethodResult found = march(joined, {int(steps), how}, watch);
        if (found.claim != RunOutcome::right) return found.claim;
        if (truth->value.claim != RunOutcome::right) return RunOutcome::refused;
        const double off = max_column_norm(found.x.leftCols(study->joints()) -
                                           truth->value.x.leftCols(study->joints()));
        if (off <= 10 * claimed_error * study->scale_mm()) return RunOutcome::right;
        return found.negative_pivots > 0 ? RunOutcome::silent_wrong : RunOutcome::other_state;
      });
    std::ranges::move(map.cells(), std::back_inserter(cells));
  }
  return cells;
}

Result<void> run_cells(Cells& cells, const StabilityOptions& options, Watch& watch) {
  constexpr double shared_by = 30;  // times the seconds of a run, for what cells share
  const auto run = [&](int k) {
    Cell& cell = cells[std::size_t(k)];
    if (cell.prepare) {
      TimeLimit limit(shared_by * options.seconds, watch);
      cell.prepare(limit.watch());
    }
    const TimeLimit limit(options.seconds, watch);
    cell.row.outcome = cell.run(limit.watch());
  };
  return parallel_for(int(cells.size()), options.threads, watch, run, reporting(watch));
}

Result<std::vector<record::StabilityRow>> stability_study(const preset::Preset& preset,
                                                          const StabilityOptions& options,
                                                          Watch& watch) {
  keep_blas_on_one_thread();
  TRY(made, BenchmarkProblem::create(preset, 64, watch));
  const SharedProblem study = std::move(*made);
  if (study->task() != Task::actuation)
    return invalid(
        "maps of stability need an actuation from the flat, without a "
        "push (actuation.start = \"flat\")");
  for (const int edges : {1, 2, 4, 8}) (void)study->problem(edges, watch);
  const Axis steps{0.5, 0.8, 0.95, 1.05, 1.2, 1.4, 1.8};
  Cells cells;
  for (const Cells& map : std::initializer_list<Cells>{
           explicit_map(study, steps, {1, 2, 4, 8}), relaxation_map(study, steps, {1, 2}),
           newton_map(study, {1, 3, 10, 30, 100}, {1, 2, 4}),
           tolerance_map(study, {1e-6, 1e-4, 1e-2, 1e-1, 1}, {10, 40}, 2),
           stiffness_map(preset, {1e-2, 1, 1e2, 1e4}, {3, 10, 30}, 2),
           leg_map(preset, {1e-4, 1e-3, 1e-2, 0.1, 0.2}, {3, 10}, 4),
           seed_map(study, {1e-12, 1e-6, 1e-3, 1, 10}, {2, 4}),
           joint_map(study, {0.01, 1, 1e2, 1e4, 1e6}, {3, 10, 30}, 1)})
    cells.insert(cells.end(), map.begin(), map.end());
  TRY_DO(run_cells(cells, options, watch));
  std::vector<record::StabilityRow> rows;
  for (Cell& cell : cells) rows.push_back(std::move(cell.row));
  return rows;
}

}  // namespace gridshell::study
