// Duration of quasi-static actuation, in units of F = one CHOLMOD simplicial numeric factorisation
// (its own nested dissection) of the Fig. 1 shell at 4 edges per segment, 2736 degrees of freedom.
// CPU time of this process, medians. `bench_solver sizes` adds complete runs of 24 and 48 rods (and
// of 96 with `sizes 96`) in factorisations of the same shell, `bench_solver growth` the table over
// n, `bench_solver rests` relaxations from rough states.
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "engine/core/algorithms.h"
#include "engine/elastic/model.h"
#include "engine/simulate/run.h"
#include "engine/solve/buckling.h"
#include "engine/solve/nested_shell.h"
#include "engine/study/cholmod_solver.h"
#include "engine/study/multilevel_relaxation.h"
#include "tests/bench/figures.h"

using namespace gridshell;

namespace {

double median(
    int runs, const std::function<void()>& work, const std::function<void()>& prepare = [] {}) {
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) {
    prepare();
    const double begin = cpu_now();
    work();
    times.push_back(cpu_now() - begin);
  }
  return gridshell::median(times);
}

struct Case {
  Footprint footprint;
  BoundaryMotion motion;
  double radius;
};

/// n rods per direction, longest leg 0.8 d, actuated to 0.75 R_o.
Case circle(int rods) {
  preset::Preset preset;
  preset.footprint.rods = rods;
  preset.footprint.placement = rods % 2 ? Placement::on_axis : Placement::half;
  const double radius = 20 * ((rods - 1) / 2.0 + 0.8);
  preset.set_radii(radius, 0.75 * radius);
  Scene scene = scene_of(preset).value();
  return {std::move(scene.footprint), std::move(scene.motion), radius};
}

double parameter(double ratio) { return std::sqrt((1 - ratio) / 0.25); }

PathOptions options_for(double tolerance, double radius) {
  PathOptions options;
  options.tolerance_mm = std::clamp(1e-3 * tolerance * radius, 1e-7, 1e-4);
  return options;
}

NestedShell shell_of(const Case& c, const LevelPlan& plan, double tolerance) {
  return NestedShell::make(c.footprint, circular_section(0.254, 83), RodModel::bend, c.motion, plan,
                           options_for(tolerance, c.radius))
      .value();
}

State begun(NestedShell& shell) {
  return first_buckled(shell.system(), shell.finest(), shell.motion(), parameter(0.98), {}, {},
                       unwatched)
      .value();
}

/// Follows the path up to t.
void follow_to(NestedShell& shell, double t) {
  const Outcome end = shell.advance(t, unwatched).end;
  if (end != Outcome::reached)
    throw std::runtime_error(
        fmt::format("the path ends before t = {:g}: {}", t, words_of(end).name));
}

double largest_joint_error(const NestedShell& shell, const NestedShell& reference) {
  const int joints = shell.finest().joints;
  return max_column_norm(shell.state().x.leftCols(joints) - reference.state().x.leftCols(joints));
}

void paper_shell(int runs, Figures& figures) {
  const Case c = circle(12);
  const LevelPlan fine{{4, 8, 16, 32, 64}, true};
  NestedShell reference = shell_of(c, fine, 1e-9);
  const State first = begun(reference);
  reference.start_path(parameter(0.98), first);
  follow_to(reference, 1);

  // F, on the Hessian of a state of the path
  Linearisation system(reference.model());
  system.at(first, false);
  const auto cholmod =
      make_cholmod(reference.model(), {.supernodal = false, .own_ordering = false});
  const auto block = make_block_cholesky(reference.model());
  const auto& hessian = system.assembly().hessian;
  cholmod->factor(hessian, 0);
  const double F = median(20 * runs, [&] { cholmod->factor(hessian, 0); });
  const double block_factor = median(20 * runs, [&] { block->factor(hessian, 0); });
  figures.print("F = {:.3f} ms (dof {})   block factorisation {:.2f} F\n", 1e3 * F,
                reference.model().dof(), block_factor / F);
  figures.add("block factorisation, F", block_factor / F);

  const auto path = [&](const char* name, const LevelPlan& plan, double tolerance, int frames,
                        double goal) {
    std::unique_ptr<NestedShell> shell;
    const double setup =
        median(runs, [&] { shell = std::make_unique<NestedShell>(shell_of(c, plan, tolerance)); });
    bool reached = true;
    const double begin = parameter(0.98);
    const double time = median(
        runs,
        [&] {
          for (int k = 1; k <= frames; ++k) {
            const double ratio = 0.98 - 0.23 * k / frames;
            reached &= shell->advance(k == frames ? 1 : parameter(ratio), unwatched).end ==
                       Outcome::reached;
          }
        },
        [&] { shell->start_path(begin, first); });
    figures.print(
        "{:34} {:6.2f} F (goal {:g}), a frame {:.2f} F, set-up {:.2f} F, error {:.2e} R_o, "
        "estimate {:.2e} R_o{}\n",
        name, time / F, goal, time / F / frames, setup / F,
        largest_joint_error(*shell, reference) / c.radius,
        shell->state().error_estimate_mm / c.radius, reached ? "" : "  NOT REACHED");
    figures.add(fmt::format("{}, F", name), time / F);
    figures.add(fmt::format("{}, set-up, F", name), setup / F);
  };
  path("0.98 -> 0.75 to 5e-5", plan_levels(5e-5), 5e-5, 1, 8);
  path("0.98 -> 0.75 to 1e-6", plan_levels(1e-6), 1e-6, 1, 12);
  path("0.98 -> 0.75 to 1e-3, 40 frames", plan_levels(1e-3), 1e-3, 40, 40);

  NestedShell coarse = shell_of(c, plan_levels(1e-3), 1e-3);
  const double flat = median(runs, [&] { begun(coarse); });
  figures.report("first buckled equilibrium, 4 edges, F", flat / F, "goal 20");
  const double all = median(runs, [&] {
    const State state = begun(coarse);
    coarse.start_path(parameter(0.98), state);
    follow_to(coarse, 1);
  });
  figures.report("flat -> 0.75 in all, 1e-3, F", all / F, "goal 40");
}

/// `gridshell run s1_actuation` at other sizes and tolerances, 240 frames, one thread, in units of
/// f, one factorisation of that shell at 4 edges per segment.
void sizes(Figures& figures, bool largest) {
  std::setvbuf(figures.lines(), nullptr, _IOLBF, 0);
  figures.print("\n{:>4} {:>10} {:>9} {:>9} {:>9} {:>6}  (240 frames; f: a factorisation)\n", "n",
                "tolerance", "f, ms", "run, s", "run, f", "edges");
  for (int n : largest ? std::vector{24, 48, 96} : std::vector{24, 48}) {
    NestedShell shell = shell_of(circle(n), {{4}, false}, 1e-3);
    const State state = begun(shell);
    shell.system().at(state, false);
    const auto factorisation = [&] { return median(9, [&] { shell.system().shifted(0); }); };
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
      preset::Preset preset;
      preset.footprint.rods = n;
      preset.set_radii(circle(n).radius, 0.75 * circle(n).radius);
      preset.imperfection.size = 0;
      preset.accuracy.tolerance = tolerance;
      preset.movie.frames = 240;
      Watch watch;
      const double f = factorisation(), begin = cpu_now();
      const auto run = simulate::run(preset, false, watch);
      // the machine may have slowed down meanwhile
      const double seconds = cpu_now() - begin, unit = 0.5 * (f + factorisation());
      figures.print("{:4} {:10g} {:9.3f} {:9.2f} {:9.0f} {:6}{}\n", n, tolerance, 1e3 * unit,
                    seconds, seconds / unit, run ? run->summary.edges_per_segment : 0,
                    run ? "" : "  " + run.error().message);
      figures.add(fmt::format("{} rods at {:g}, f", n, tolerance), seconds / unit);
    }
  }
}

void growth(Figures& figures) {
  std::setvbuf(figures.lines(), nullptr, _IOLBF, 0);
  figures.print("\n{:>4} {:>8} {:>10} {:>10} {:>10} {:>10} {:>10}  (seconds, 4 edges)\n", "n",
                "dof", "set-up", "assembly", "factor", "first", "path");
  for (int n : {6, 12, 24, 48, 96, 192}) {
    const bool follow = n < 192;  // the largest is followed to its first equilibrium alone
    const Case c = circle(n);
    const double begin = cpu_now();
    NestedShell shell = shell_of(c, {{4}, false}, 1e-3);
    const double setup = cpu_now() - begin;
    Assembly assembly;
    Eigen::Matrix3Xd flat = Eigen::Matrix3Xd::Zero(3, shell.model().nodes);
    flat.topRows(2) = shell.model().flat;
    State state = start_state(shell.model(), flat);
    const double assemble =
        median(5, [&] { assemble_hessian(shell.model(), state, {}, {}, assembly); });
    shell.system().at(state, false);
    const double factor = median(3, [&] { shell.system().shifted(0); });
    double start = cpu_now();
    const auto first = first_buckled(shell.system(), shell.finest(), shell.motion(),
                                     parameter(0.98), {}, {}, unwatched);
    const double buckle = cpu_now() - start;
    start = cpu_now();
    bool reached = first.has_value();
    if (first && follow) {
      shell.start_path(parameter(0.98), *first);
      reached = shell.advance(1, unwatched).end == Outcome::reached;
    }
    const double path = cpu_now() - start;
    figures.print("{:4} {:8} {:10.4f} {:10.4f} {:10.4f} {:10.4f} {:10.4f}{}\n", n,
                  shell.model().dof(), setup, assemble, factor, buckle, path,
                  reached ? "" : "  not reached");
    figures.add(fmt::format("{} rods, factorisation, s", n), factor);
    figures.add(fmt::format("{} rods, first equilibrium, s", n), buckle);
    if (follow) figures.add(fmt::format("{} rods, path, s", n), path);
  }
}

/// An interactive drag of the boundary from 0.95 to 0.76 R_o in steps of one per cent, each state
/// on meshes of 4, 8, 16 edges.
void drag(Figures& figures) {
  for (int n : {12, 24}) {
    const Case c = circle(n);
    NestedShell shell = shell_of(c, {{4, 8, 16}, false}, 1e-3);
    const State first = begun(shell);
    constexpr int moves = 19;
    bool reached = true;
    const double seconds = median(
        7,
        [&] {
          for (int k = 1; k <= moves; ++k)
            reached &= shell.advance(parameter(0.95 - 0.01 * k), unwatched).end == Outcome::reached;
        },
        [&] {
          shell.start_path(parameter(0.98), first);
          follow_to(shell, parameter(0.95));
        });
    figures.report(fmt::format("radius less by 1 %, {} rods, ms", n), 1e3 * seconds / moves,
                   reached ? "meshes 4, 8, 16" : "NOT REACHED");
  }
}

/// Relaxation from random displacements of every joint by up to one spacing, over meshes of 1, 2, 4
/// edges.
void rests(Figures& figures) {
  std::setvbuf(figures.lines(), nullptr, _IOLBF, 0);
  figures.print("\n{:>4} {:>12} {:>8}  (random displacements of one spacing)\n", "n", "s per 1000",
                "at rest");
  for (const auto& [n, starts] : {std::pair{8, 400}, {12, 200}, {20, 60}}) {
    const Case c = circle(n);
    MultilevelRelaxation cascade =
        MultilevelRelaxation::make(c.footprint, {circular_section(0.254, 83)}, RodModel::bend,
                                   c.motion, {}, 4)
            .value();
    std::mt19937 random{1};
    int reached = 0;
    const double begin = cpu_now();
    for (int k = 0; k < starts; ++k) {
      Eigen::Matrix3Xd nodes = cascade.stretched_flat(1);
      for (double& x : nodes.reshaped()) x += c.footprint.spacing * symmetric_uniform(random);
      reached += cascade.rest(1, nodes, unwatched).has_value();
    }
    const double seconds = 1000 * (cpu_now() - begin) / starts, fraction = double(reached) / starts;
    figures.print("{:4} {:12.1f} {:7.1f} %\n", n, seconds, 100 * fraction);
    figures.add(fmt::format("{} rods, 1000 rests, s", n), seconds);
    figures.add(fmt::format("{} rods, at rest", n), fraction);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Figures figures(argc, argv);
  paper_shell(7, figures);
  drag(figures);
  const auto requested = [&](const char* word) {
    return std::ranges::count(figures.words(), word) > 0;
  };
  if (requested("sizes")) sizes(figures, requested("96"));
  if (requested("growth")) growth(figures);
  if (requested("rests")) rests(figures);
}
