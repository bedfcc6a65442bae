// Which cells each map has, and how they are judged.

#include "engine/study/stability_study.h"

#include <cmath>
#include <mutex>
#include <optional>

#include "engine/core/parallel.h"
#include "engine/core/try.h"
#include "engine/study/benchmark_methods.h"
#include "engine/study/stopwatch.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;
using record::StabilityRow;

using Study = std::shared_ptr<BenchmarkProblem>;
using Run = std::function<MethodResult(const Problem&, const Watch&)>;

/// Runs on one mesh of a case and is judged there.
Cell cell(StabilityRow row, const Study& study, int edges, const Run& run,
          double promised = claimed_error) {
  return {std::move(row), [=](const Watch& watch) {
            static const Watch patient;  // references are made whole
            const auto problem = study->problem(edges, patient);
            if (!problem) return RunOutcome::refused;
            return verdict_of(*study, run(**problem, watch), promised, promised, patient);
          }};
}

/// The default solver in a cell: with a tolerance it is judged by what that promises.
Cell default_cell(StabilityRow row, const Study& study, const LevelPlan& plan, double tolerance,
                  double stops) {
  row.method = default_solver;
  return {std::move(row), [=](const Watch& watch) {
            static const Watch patient;
            const MethodResult arrival = default_run(*study, plan, tolerance, int(stops), watch);
            // at least what methods on one mesh promise; the mesh's own error is not theirs either
            const double promised = std::max(tolerance, claimed_error);
            return verdict_of(*study, arrival, arrival.whole_mesh ? claimed_error : promised,
                              promised, patient);
          }};
}

Run marching(MarchOptions options) {
  return [options](const Problem& problem, const Watch& watch) {
    Stopwatch unused;
    return march(problem, options, unused, watch);
  };
}

constexpr Globalisation globalisations[] = {Globalisation::none, Globalisation::line_search,
                                            Globalisation::shifted};

/// A case that is made when a cell first needs it; empty where it has no reference.
class Lazy {
 public:
  explicit Lazy(std::function<Result<std::unique_ptr<BenchmarkProblem>>()> make)
      : make_(std::move(make)) {}
  Study get() {
    const std::lock_guard lock(mutex_);
    if (!made_) {
      auto made = make_();
      made_ = made ? Study(std::move(*made)) : nullptr;
    }
    return *made_;
  }

 private:
  std::mutex mutex_;
  std::function<Result<std::unique_ptr<BenchmarkProblem>>()> make_;
  std::optional<Study> made_;
};

/// A baseline over its step, on meshes of so many edges.
Cells step_cells(StabilityRow row, const Study& study, const std::vector<double>& steps,
                 const std::vector<int>& edges,
                 const std::function<MethodResult(const Problem&, double, const Watch&)>& run) {
  Cells cells;
  row.y_name = "edges_per_segment";
  for (int k : edges)
    for (double step : steps) {
      row.x = step;
      row.y = k;
      cells.push_back(cell(row, study, k, [run, step](const Problem& problem, const Watch& watch) {
        return run(problem, step, watch);
      }));
    }
  return cells;
}

/// Load steps on a case of their own, made where the first is run: full steps, shifted, and by
/// default.
void add_load_steps(const StabilityRow& at,
                    std::function<Result<std::unique_ptr<BenchmarkProblem>>()> make,
                    const std::vector<double>& load_steps, int edges, Cells& cells) {
  const auto lazy = std::make_shared<Lazy>(std::move(make));
  const auto add = [&](const char* method, double steps,
                       const std::function<Cell(const Study&)>& cell_of) {
    StabilityRow row = at;
    row.method = method;
    row.y_name = "load_steps";
    row.y = steps;
    cells.push_back({row, [=](const Watch& watch) {
                       const Study study = lazy->get();
                       // the engine says why there is no reference to compare with
                       return study ? cell_of(study).run(watch) : RunOutcome::refused;
                     }});
  };
  for (double steps : load_steps) {
    for (Globalisation how : {Globalisation::none, Globalisation::shifted})
      add(name_of(how), steps, [=](const Study& study) {
        return cell({}, study, edges, marching({.load_steps = int(steps), .globalisation = how}));
      });
    add(default_solver, steps, [=](const Study& study) {
      return default_cell({}, study, plan_levels(1e-3), 1e-3, steps);
    });
  }
}

}  // namespace

Cells explicit_map(const Study& study, const std::vector<double>& steps,
                   const std::vector<int>& edges) {
  return step_cells({"explicit step", "explicit", "step over l/c", 0, "", 0, {}}, study, steps,
                    edges, hold);
}

Cells relaxation_map(const Study& study, const std::vector<double>& steps,
                     const std::vector<int>& edges) {
  return step_cells({"relaxation step", "dynamic relaxation", "step over its limit", 0, "", 0, {}},
                    study, steps, edges,
                    [](const Problem& problem, double step, const Watch& watch) {
                      Stopwatch unused;
                      return relax(problem, {.step = step}, unused, watch);
                    });
}

Cells newton_map(const Study& study, const std::vector<double>& load_steps,
                 const std::vector<int>& edges) {
  Cells cells;
  for (int k : edges)
    for (double steps : load_steps) {
      const auto row = [&](const char* method) {
        return StabilityRow{"load steps", method, "load_steps", steps, "edges_per_segment",
                            double(k),    {}};
      };
      for (Globalisation how : globalisations)
        cells.push_back(cell(row(name_of(how)), study, k,
                             marching({.load_steps = int(steps), .globalisation = how})));
      cells.push_back(default_cell(row(default_solver), study, plan_of_mesh(k), 0, steps));
    }
  return cells;
}

Cells tolerance_map(const Study& study, const std::vector<double>& tolerances,
                    const std::vector<double>& load_steps, int edges) {
  Cells cells;
  for (double steps : load_steps)
    for (double tolerance : tolerances) {
      const auto row = [&](const char* method) {
        return StabilityRow{"tolerance", method, "tolerance_mm", tolerance, "load_steps",
                            steps,       {}};
      };
      // what is asked for is what is promised
      const double promised = tolerance / study->scale_mm();
      for (Globalisation how : globalisations)
        cells.push_back(cell(
            row(name_of(how)), study, edges,
            marching({.load_steps = int(steps), .globalisation = how, .tolerance_mm = tolerance}),
            promised));
      cells.push_back(
          default_cell(row(default_solver), study, plan_levels(promised), promised, steps));
    }
  return cells;
}

Cells stiffness_map(const preset::Preset& preset, const std::vector<double>& scales,
                    const std::vector<double>& load_steps, int edges) {
  Cells cells;
  for (double scale : scales)
    add_load_steps(
        {"EA", "", "EA over the rods'", scale, "", 0, {}},
        [=] {
          Watch patient;
          return BenchmarkProblem::create(preset, 16, patient, scale);
        },
        load_steps, edges, cells);
  return cells;
}

Cells leg_map(const preset::Preset& preset, const std::vector<double>& legs,
              const std::vector<double>& load_steps, int edges) {
  Cells cells;
  if (preset.footprint.kind != preset::FootprintKind::circle) return cells;
  for (double leg : legs) {
    preset::Preset cut = preset;
    // the outermost rod's last joint stands that far inside the boundary
    const double d = preset.footprint.spacing_mm, outermost = (preset.footprint.rods - 1) / 2.0;
    const double original = preset.original_radius_mm();
    const double reach =
        std::sqrt(std::max(0.0, std::pow(original / d, 2) - outermost * outermost));
    const double first = preset.footprint.rods % 2 ? 0 : 0.5;
    const double last = first + std::max(0.0, std::floor(reach - first));
    const double radius = d * std::hypot(outermost, last + leg);
    cut.set_radii(radius, preset.actuated_radius_mm() * radius / original);
    add_load_steps(
        {"shortest leg", "", "leg over d", leg, "", 0, {}},
        [=] {
          Watch patient;
          return BenchmarkProblem::create(cut, 16, patient);
        },
        load_steps, edges, cells);
  }
  return cells;
}

namespace {

/// As verdict_of(), for a problem that ends elsewhere.
RunOutcome judge_at(const Problem& problem, const BenchmarkProblem& study,
                    const MethodResult& arrival) {
  if (arrival.claim != RunOutcome::right) return arrival.claim;
  return verdict_at_end(study, problem, arrival.x, claimed_error);
}

}  // namespace

Cells seed_map(const Study& study, const std::vector<double>& heights,
               const std::vector<int>& edges) {
  Cells cells;
  const auto add = [&](const char* method, double height, int k, auto run) {
    const StabilityRow row{"seed", method, "seed_mm", height, "edges_per_segment", double(k), {}};
    cells.push_back({row, [=](const Watch& watch) {
                       static const Watch patient;
                       const auto problem = study->problem(k, patient);
                       if (!problem) return RunOutcome::refused;
                       const Problem flat = from_flat(*study, **problem, height);
                       return judge_at(flat, *study, run(flat, **problem, watch));
                     }});
  };
  for (int k : edges)
    for (double height : heights) {
      for (Globalisation how : globalisations)
        add(name_of(how), height, k,
            [how](const Problem& flat, const Problem&, const Watch& watch) {
              Stopwatch unused;
              return march(flat, {.load_steps = 1, .globalisation = how}, unused, watch);
            });
      // the default brings a seed of its own, whatever the height
      add(default_solver, height, k,
          [study](const Problem&, const Problem& problem, const Watch& watch) {
            return buckle(*study, problem, watch);
          });
    }
  return cells;
}

Cells joint_map(const Study& study, const std::vector<double>& stiffnesses,
                const std::vector<double>& load_steps, int edges) {
  struct Truth {
    std::once_flag once;
    MethodResult arrival;
  };
  Cells cells;
  for (double stiffness : stiffnesses) {
    const auto truth = std::make_shared<Truth>();
    for (double steps : load_steps)
      for (bool shifted : {false, true}) {
        const StabilityRow row{"joint stiffness",
                               name_of(shifted ? Globalisation::shifted : Globalisation::none),
                               "stiffness_N_per_mm",
                               stiffness,
                               "load_steps",
                               steps,
                               {}};
        cells.push_back(
            {row, [=](const Watch& watch) {
               static const Watch patient;
               const auto problem = study->problem(edges, patient);
               if (!problem) return RunOutcome::refused;
               Stopwatch unused;
               const Problem joined = study->on_model(**problem, {RodModel::twist, stiffness});
               std::call_once(truth->once, [&] {
                 truth->arrival = march(joined, {.load_steps = 60}, unused, patient);
               });
               const auto how = shifted ? Globalisation::shifted : Globalisation::none;
               const MethodResult found =
                   march(joined, {.load_steps = int(steps), .globalisation = how}, unused, watch);
               if (found.claim != RunOutcome::right) return found.claim;
               if (truth->arrival.claim != RunOutcome::right) return RunOutcome::refused;
               const double off = max_column_norm(found.x.leftCols(study->joints()) -
                                                  truth->arrival.x.leftCols(study->joints()));
               if (off <= 10 * claimed_error * study->scale_mm()) return RunOutcome::right;
               return found.negative_pivots > 0 ? RunOutcome::silent_wrong
                                                : RunOutcome::other_state;
             }});
      }
  }
  return cells;
}

Result<void> run_cells(Cells& cells, const StabilityOptions& options, Watch& watch) {
  const auto run = [&](int k) {
    Cell& cell = cells[std::size_t(k)];
    const TimeLimit limit(options.seconds, watch);
    cell.row.outcome = cell.run(limit.watch());
  };
  return parallel_for(int(cells.size()), options.threads, watch, run,
                      [&](double share) { watch.report(share); });
}

Result<std::vector<record::StabilityRow>> stability_study(const preset::Preset& preset,
                                                          const StabilityOptions& options,
                                                          Watch& watch) {
  keep_blas_on_one_thread();
  TRY(made, BenchmarkProblem::create(preset, 64, watch));
  const std::shared_ptr<BenchmarkProblem> study = std::move(*made);
  if (study->task() != Task::actuation)
    return fail(Fault::bad_input,
                "maps of stability need an actuation from the flat, without a "
                "push (actuation.start = \"flat\")");
  for (int edges : {1, 2, 4, 8}) (void)study->problem(edges, watch);
  Cells cells;
  const auto add = [&](Cells more) {
    for (Cell& cell : more) cells.push_back(std::move(cell));
  };
  add(explicit_map(study, {0.5, 0.8, 0.95, 1.05, 1.2, 1.4, 1.8}, {1, 2, 4, 8}));
  add(relaxation_map(study, {0.5, 0.8, 0.95, 1.05, 1.2, 1.4, 1.8}, {1, 2}));
  add(newton_map(study, {1, 3, 10, 30, 100}, {1, 2, 4}));
  add(tolerance_map(study, {1e-6, 1e-4, 1e-2, 1e-1, 1}, {10, 40}, 2));
  add(stiffness_map(preset, {1e-2, 1, 1e2, 1e4}, {3, 10, 30}, 2));
  add(leg_map(preset, {1e-4, 1e-3, 1e-2, 0.1, 0.2}, {3, 10}, 4));
  add(seed_map(study, {1e-12, 1e-6, 1e-3, 1, 10}, {2, 4}));
  add(joint_map(study, {0.01, 1, 1e2, 1e4, 1e6}, {3, 10, 30}, 1));
  TRY_DO(run_cells(cells, options, watch));
  std::vector<record::StabilityRow> rows;
  for (Cell& cell : cells) rows.push_back(std::move(cell.row));
  return rows;
}

}  // namespace gridshell::study
