// What is run in each cell of the maps.
#include <cmath>
#include <mutex>
#include <optional>

#include "engine/rod/section.h"
#include "engine/solve/buckle.h"
#include "engine/solve/relaxation.h"
#include "engine/study/judge.h"
#include "engine/study/stability_study.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;
using record::StabilityRow;

constexpr double claimed = 1e-4;  // of the length scale: what a method at rest promises

using Study = std::shared_ptr<Case>;
using Run = std::function<Arrival(const Problem&, const Watch&)>;

/// Runs on one mesh of a case and is judged there.
Cell cell(StabilityRow row, const Study& study, int edges, Run run, double promised = claimed) {
  return {std::move(row), [=](const Watch& watch) {
            static const Watch patient;  // references are made whole
            const auto problem = study->problem(edges, patient);
            if (!problem) return RunOutcome::refused;
            return judge(*study, run(**problem, watch), promised, promised, patient);
          }};
}

/// As an experiment runs it, through `stops` certified states: on the meshes of `plan`, and where
/// `tolerance` is above 0 on finer ones until the estimate meets it.
Arrival by_default(Case& study, LevelPlan plan, double tolerance, int stops, const Watch& watch) {
  for (;;) {
    NestedShell shell = study.shell(plan, tolerance > 0 ? tolerance : 1e-3);
    NestedReport report = study.begin(shell, watch);
    const double from = report.t * report.t;
    for (int k = 1; k <= stops && report.end == NestedEnd::reached; ++k)
      report = shell.advance(k == stops ? 1 : std::sqrt(from + (1 - from) * k / stops), watch);
    Arrival arrival;
    arrival.edges = plan.edges_per_segment.back();
    arrival.whole_mesh = !plan.extrapolate;
    arrival.x = shell.state().x;
    arrival.claim = report.end == NestedEnd::reached     ? RunOutcome::right
                    : report.end == NestedEnd::cancelled ? RunOutcome::too_slow
                                                         : RunOutcome::refused;
    if (arrival.claim != RunOutcome::right || tolerance == 0 ||
        shell.state().error_estimate_mm <= tolerance * study.scale_mm())
      return arrival;
    const auto next = finer(plan);
    if (!next) {
      arrival.claim = RunOutcome::refused;  // the tolerance is not met, and the program says so
      return arrival;
    }
    plan = *next;
  }
}

/// The meshes of `accuracy.edges_per_segment`.
LevelPlan plan_of(int edges) {
  LevelPlan plan{{edges}, false};
  for (int k = edges; k % 2 == 0 && k / 2 >= 4; k /= 2)
    plan.edges_per_segment.insert(plan.edges_per_segment.begin(), k / 2);
  return plan;
}

/// The default solver in a cell: with a tolerance it is judged by what that promises.
Cell default_cell(StabilityRow row, const Study& study, const LevelPlan& plan, double tolerance,
                  double stops) {
  row.method = default_solver;
  return {std::move(row), [=](const Watch& watch) {
            static const Watch patient;
            const Arrival arrival = by_default(*study, plan, tolerance, int(stops), watch);
            // at least what methods on one mesh promise; the mesh's own error is not theirs either
            const double promised = std::max(tolerance, claimed);
            return judge(*study, arrival, arrival.whole_mesh ? claimed : promised, promised,
                         patient);
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

/// Off the equilibrium by 0.01 mm, then a fixed number of explicit steps.
Arrival hold(const Problem& problem, double over_l_c, const Watch& watch) {
  Arrival arrival;
  arrival.edges = problem.edges;
  arrival.whole_mesh = true;
  const Eigen::VectorXd mass = lumped_masses(problem.model, 6450, 0.254).value();
  double shortest = INFINITY, along = 0;
  for (const ModelEdge& edge : problem.model.edges) shortest = std::min(shortest, edge.rest_length);
  for (const ModelEdge& edge : problem.model.edges) along += edge.rest_length;
  const double c = std::sqrt(problem.model.edges[0].EA * along / mass.sum());
  BaselineOptions options;
  options.step = over_l_c * shortest / c / courant_step(problem.model, mass);
  options.damping_per_s = 100;
  options.tolerance_N = 0;
  options.most_steps = 20000;
  Motion motion{problem.end.x, Eigen::Matrix3Xd::Zero(3, problem.model.nodes), 0};
  for (int node : problem.model.free_nodes)
    for (int axis = 0; axis < 3; ++axis)
      motion.x(axis, node) += 0.01 * std::sin(1 + 2.3 * node + 1.7 * axis);
  const BaselineReport report = explicit_to_rest(problem.model, mass, motion, options, watch);
  arrival.claim = report.end == BaselineEnd::blow_up     ? RunOutcome::blow_up
                  : report.end == BaselineEnd::cancelled ? RunOutcome::too_slow
                                                         : RunOutcome::right;
  arrival.x = std::move(motion.x);
  return arrival;
}

/// A case that is made when a cell first needs it; empty where it has no reference.
class Lazy {
 public:
  explicit Lazy(std::function<Result<std::unique_ptr<Case>>()> make) : make_(std::move(make)) {}
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
  std::function<Result<std::unique_ptr<Case>>()> make_;
  std::optional<Study> made_;
};

/// Load steps on a case of their own: full steps, shifted, and by default.
Cells load_step_cells(const StabilityRow& at, const std::shared_ptr<Lazy>& lazy,
                      const std::vector<double>& load_steps, int edges) {
  Cells cells;
  const auto add = [&](const char* method, double steps, std::function<Run(const Study&)> run) {
    StabilityRow row = at;
    row.method = method;
    row.y_name = "load_steps";
    row.y = steps;
    cells.push_back({row, [=](const Watch& watch) {
                       const Study study = lazy->get();
                       // the engine says why there is no reference to compare with
                       if (!study) return RunOutcome::refused;
                       return cell({}, study, edges, run(study)).run(watch);
                     }});
  };
  for (double steps : load_steps) {
    for (Globalisation how : {Globalisation::none, Globalisation::shifted})
      add(name_of(how), steps,
          [=](const Study&) { return marching({.load_steps = int(steps), .globalisation = how}); });
    StabilityRow row = at;
    row.method = default_solver;
    row.y_name = "load_steps";
    row.y = steps;
    cells.push_back({row, [=](const Watch& watch) {
                       const Study study = lazy->get();
                       if (!study) return RunOutcome::refused;
                       return default_cell({}, study, plan_levels(1e-3), 1e-3, steps).run(watch);
                     }});
  }
  return cells;
}

}  // namespace

Cells explicit_map(const Study& study, const std::vector<double>& steps,
                   const std::vector<int>& edges) {
  Cells cells;
  for (int k : edges)
    for (double step : steps)
      cells.push_back(cell({"explicit step",
                            "explicit",
                            "step over l/c",
                            step,
                            "edges_per_segment",
                            double(k),
                            {}},
                           study, k, [step](const Problem& problem, const Watch& watch) {
                             return hold(problem, step, watch);
                           }));
  return cells;
}

Cells relaxation_map(const Study& study, const std::vector<double>& steps,
                     const std::vector<int>& edges) {
  Cells cells;
  for (int k : edges)
    for (double step : steps)
      cells.push_back(cell({"relaxation step",
                            "dynamic relaxation",
                            "step over its limit",
                            step,
                            "edges_per_segment",
                            double(k),
                            {}},
                           study, k, [step](const Problem& problem, const Watch& watch) {
                             Stopwatch unused;
                             const RelaxMarch how{.step = step};
                             return march_relaxed(problem, how, unused, watch);
                           }));
  return cells;
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
      cells.push_back(default_cell(row(default_solver), study, plan_of(k), 0, steps));
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
  for (double scale : scales) {
    const auto lazy = std::make_shared<Lazy>([=] {
      Watch patient;
      return Case::create(preset, 16, patient, scale);
    });
    for (Cell& one : load_step_cells({"EA", "", "EA over the rods'", scale, "", 0, {}}, lazy,
                                     load_steps, edges))
      cells.push_back(std::move(one));
  }
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
    const double reach = std::sqrt(
        std::max(0.0, std::pow(preset.footprint.radius_mm / d, 2) - outermost * outermost));
    const double first = preset.footprint.rods % 2 ? 0 : 0.5;
    const double last = first + std::max(0.0, std::floor(reach - first));
    cut.footprint.radius_mm = d * std::hypot(outermost, last + leg);
    cut.actuation.radius_mm *= cut.footprint.radius_mm / preset.footprint.radius_mm;
    const auto lazy = std::make_shared<Lazy>([=] {
      Watch patient;
      return Case::create(cut, 16, patient);
    });
    for (Cell& one : load_step_cells({"shortest leg", "", "leg over d", leg, "", 0, {}}, lazy,
                                     load_steps, edges))
      cells.push_back(std::move(one));
  }
  return cells;
}

namespace {

/// The path from the flat with a dome on it to the study's start, as a problem of its own.
Problem from_flat(const Case& study, const Problem& problem, double height) {
  Problem flat = problem;
  const Eigen::Matrix3Xd end = problem.motion.at(problem.t);
  flat.motion = {study.scene().flat.all(problem.mesh.flat), {}, Pace::even};
  flat.motion.change = end - flat.motion.begin;
  flat.t = 0;
  flat.end = problem.start;
  flat.start.x = flat.motion.begin;
  flat.start.force.setZero();
  const double reach2 = problem.mesh.flat.colwise().squaredNorm().maxCoeff();
  const BuckleSeed& seed = study.scene().seed;
  for (int node : problem.model.free_nodes) {
    const Eigen::Vector2d p = problem.mesh.flat.col(node);
    const double tilted = 1 - 0.8 * seed.up * seed.diagonal * p.x() * p.y() / reach2;
    flat.start.x(2, node) += seed.up * height * (1 - p.squaredNorm() / reach2) * tilted;
  }
  return flat;
}

Arrival buckle(const Case& study, const Problem& problem, const Watch& watch) {
  Linearisation system(problem.model);
  Arrival arrival;
  arrival.edges = problem.edges;
  arrival.whole_mesh = true;
  arrival.claim = RunOutcome::refused;
  const auto first = first_buckled(system, problem.mesh, problem.motion, problem.t,
                                   study.scene().seed, study.scene().flat, watch);
  if (watch.cancelled()) arrival.claim = RunOutcome::too_slow;
  if (!first) return arrival;
  arrival.claim = RunOutcome::right;
  arrival.x = first->x;
  return arrival;
}

/// As judge(), for a problem that ends elsewhere.
RunOutcome judge_at(const Problem& problem, const Case& study, const Arrival& arrival) {
  if (arrival.claim != RunOutcome::right) return arrival.claim;
  return judge_end(study, problem, arrival.x, claimed);
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
    Arrival arrival;
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
               std::call_once(truth->once, [&] {
                 truth->arrival = march_twist(*study, **problem,
                                              {.load_steps = 60, .stiffness_N_per_mm = stiffness},
                                              unused, patient);
               });
               const TwistMarch how{
                   .load_steps = int(steps), .stiffness_N_per_mm = stiffness, .saddles = !shifted};
               const Arrival found = march_twist(*study, **problem, how, unused, watch);
               if (found.claim != RunOutcome::right) return found.claim;
               if (truth->arrival.claim != RunOutcome::right) return RunOutcome::refused;
               const double off = largest_column(found.x.leftCols(study->joints()) -
                                                 truth->arrival.x.leftCols(study->joints()));
               if (off <= 10 * claimed * study->scale_mm()) return RunOutcome::right;
               return found.negative_pivots > 0 ? RunOutcome::silent_wrong
                                                : RunOutcome::other_state;
             }});
      }
  }
  return cells;
}

}  // namespace gridshell::study
