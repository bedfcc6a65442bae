// How long quasi-static actuation takes, in units of F = one CHOLMOD simplicial numeric
// factorisation (its own nested dissection) of the Fig. 1 shell at 4 edges a segment, 2736 degrees
// of freedom. CPU time of this process, medians. `bench_solver sizes` adds the table over n,
// `bench_solver rests` rests from rough states.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/core/algorithms.h"
#include "engine/solve/buckling.h"
#include "engine/solve/multilevel_relaxation.h"
#include "engine/solve/nested_shell.h"
#include "tests/bench/figures.h"

using namespace gridshell;

namespace {

double cpu_now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double median(
    int runs, const std::function<void()>& work, const std::function<void()>& prepare = [] {}) {
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) {
    prepare();
    const double begin = cpu_now();
    work();
    times.push_back(cpu_now() - begin);
  }
  std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
  return times[std::size_t(runs / 2)];
}

struct Case {
  Footprint footprint;
  BoundaryMotion motion;
  double radius;
};

/// n rods a direction, longest leg 0.8 d, actuated to 0.75 R_o.
Case circle(int rods) {
  const double radius = 20 * ((rods - 1) / 2.0 + 0.8);
  Case c{
      circular_footprint(radius, rods, 20, rods % 2 ? Placement::on_axis : Placement::half).value(),
      {},
      radius};
  c.motion.begin = Eigen::Matrix3Xd::Zero(3, 2 * Eigen::Index(c.footprint.rods.size()));
  for (std::size_t r = 0; r < c.footprint.rods.size(); ++r) {
    const FootprintRod& rod = c.footprint.rods[r];
    const double ends[] = {rod.span.begin, rod.span.end};
    for (int e = 0; e < 2; ++e)
      c.motion.begin.col(Eigen::Index(2 * r) + e) = rod.family == Family::u
                                                        ? Eigen::Vector3d(ends[e], rod.line(), 0)
                                                        : Eigen::Vector3d(rod.line(), ends[e], 0);
  }
  c.motion.end = 0.75 * c.motion.begin;
  return c;
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

double largest_joint_error(const NestedShell& shell, const NestedShell& reference) {
  const int joints = shell.mesh(0).joints;
  return max_column_norm(shell.state().x.leftCols(joints) - reference.state().x.leftCols(joints));
}

void paper_shell(int runs, Figures& figures) {
  const Watch watch;
  const Case c = circle(12);
  const LevelPlan fine{{4, 8, 16, 32, 64}, true};
  NestedShell reference = shell_of(c, fine, 1e-9);
  const State first = first_buckled(reference.system(0), reference.mesh(0), reference.motion(0),
                                    parameter(0.98), {}, {}, watch)
                          .value();
  reference.place(parameter(0.98), first);
  reference.advance(1, watch);

  // F, on the Hessian of a state of the path
  Linearisation system(reference.model(0));
  system.at(first, false);
  const auto cholmod =
      make_cholmod(reference.model(0), {.supernodal = false, .own_ordering = false});
  const auto block = make_block_cholesky(reference.model(0));
  const auto& hessian = system.assembly().hessian;
  cholmod->factor(hessian, 0);
  const double F = median(20 * runs, [&] { cholmod->factor(hessian, 0); });
  const double block_factor = median(20 * runs, [&] { block->factor(hessian, 0); });
  fmt::print(figures.lines(), "F = {:.3f} ms (dof {})   block factorisation {:.2f} F\n", 1e3 * F,
             reference.model(0).dof(), block_factor / F);
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
            reached &=
                shell->advance(k == frames ? 1 : parameter(ratio), watch).end == Outcome::reached;
          }
        },
        [&] { shell->place(begin, first); });
    fmt::print(figures.lines(),
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
  const double flat = median(runs, [&] {
    first_buckled(coarse.system(0), coarse.mesh(0), coarse.motion(0), parameter(0.98), {}, {},
                  watch)
        .value();
  });
  fmt::print(figures.lines(), "first buckled equilibrium, 4 edges {:6.2f} F (goal 20)\n", flat / F);
  figures.add("first buckled equilibrium, 4 edges, F", flat / F);
  const double all = median(runs, [&] {
    const State state = first_buckled(coarse.system(0), coarse.mesh(0), coarse.motion(0),
                                      parameter(0.98), {}, {}, watch)
                            .value();
    coarse.place(parameter(0.98), state);
    coarse.advance(1, watch);
  });
  fmt::print(figures.lines(), "flat -> 0.75 in all, 1e-3          {:6.2f} F (goal 40)\n", all / F);
  figures.add("flat -> 0.75 in all, 1e-3, F", all / F);
}

void sizes(Figures& figures) {
  const Watch watch;
  std::setvbuf(figures.lines(), nullptr, _IOLBF, 0);
  fmt::print(figures.lines(),
             "\n{:>4} {:>8} {:>10} {:>10} {:>10} {:>10} {:>10}  (seconds, 4 edges)\n", "n", "dof",
             "set-up", "assembly", "factor", "first", "path");
  std::vector<std::array<double, 6>> rows;
  for (int n : {6, 12, 24, 48, 96, 192}) {
    const bool follow = n < 192;  // the largest comes to its first equilibrium alone
    const Case c = circle(n);
    const double begin = cpu_now();
    NestedShell shell = shell_of(c, {{4}, false}, 1e-3);
    const double setup = cpu_now() - begin;
    Assembly assembly;
    Eigen::Matrix3Xd flat = Eigen::Matrix3Xd::Zero(3, shell.model(0).nodes);
    flat.topRows(2) = shell.model(0).flat;
    State state = start_state(shell.model(0), flat);
    const double assemble =
        median(5, [&] { assemble_hessian(shell.model(0), state, {}, {}, assembly); });
    shell.system(0).at(state, false);
    const double factor = median(3, [&] { shell.system(0).shifted(0); });
    double start = cpu_now();
    const auto first = first_buckled(shell.system(0), shell.mesh(0), shell.motion(0),
                                     parameter(0.98), {}, {}, watch);
    const double buckle = cpu_now() - start;
    start = cpu_now();
    bool reached = first.has_value();
    if (first && follow) {
      shell.place(parameter(0.98), *first);
      reached = shell.advance(1, watch).end == Outcome::reached;
    }
    const double path = cpu_now() - start;
    fmt::print(figures.lines(), "{:4} {:8} {:10.4f} {:10.4f} {:10.4f} {:10.4f} {:10.4f}{}\n", n,
               shell.model(0).dof(), setup, assemble, factor, buckle, path,
               reached ? "" : "  not reached");
    figures.add(fmt::format("{} rods, factorisation, s", n), factor);
    figures.add(fmt::format("{} rods, first equilibrium, s", n), buckle);
    if (!follow) continue;
    figures.add(fmt::format("{} rods, path, s", n), path);
    rows.push_back({double(n), setup, assemble, factor, buckle, path});
  }
  fmt::print(figures.lines(), "{:>13}", "exponent");
  for (int column = 1; column < 6; ++column)
    fmt::print(
        figures.lines(), " {:10.2f}",
        std::log(rows.back()[column] / rows[1][column]) / std::log(rows.back()[0] / rows[1][0]));
  fmt::print(figures.lines(), "\n");
}

/// A hand that draws the boundary in from 0.95 to 0.76 R_o by one per cent a time, each state on
/// meshes of 4, 8, 16 edges.
void drag(Figures& figures) {
  const Watch watch;
  for (int n : {12, 24}) {
    const Case c = circle(n);
    NestedShell shell = shell_of(c, {{4, 8, 16}, false}, 1e-3);
    const State first = first_buckled(shell.system(0), shell.mesh(0), shell.motion(0),
                                      parameter(0.98), {}, {}, watch)
                            .value();
    constexpr int moves = 19;
    bool reached = true;
    const double seconds = median(
        7,
        [&] {
          for (int k = 1; k <= moves; ++k)
            reached &= shell.advance(parameter(0.95 - 0.01 * k), watch).end == Outcome::reached;
        },
        [&] {
          shell.place(parameter(0.98), first);
          shell.advance(parameter(0.95), watch);
        });
    fmt::print(figures.lines(), "radius less by 1 %, {} rods, meshes 4, 8, 16: {:.2f} ms{}\n", n,
               1e3 * seconds / moves, reached ? "" : "  NOT REACHED");
    figures.add(fmt::format("radius less by 1 %, {} rods, ms", n), 1e3 * seconds / moves);
  }
}

/// Rests from random throws of every joint by up to one spacing, over meshes of 1, 2, 4 edges.
void rests(Figures& figures) {
  const Watch watch;
  std::setvbuf(figures.lines(), nullptr, _IOLBF, 0);
  fmt::print(figures.lines(), "\n{:>4} {:>12} {:>8}  (random throws of one spacing)\n", "n",
             "s per 1000", "at rest");
  for (const auto& [n, throws] : {std::pair{8, 400}, {12, 200}, {20, 60}}) {
    const Case c = circle(n);
    MultilevelRelaxation cascade =
        MultilevelRelaxation::make(c.footprint, {circular_section(0.254, 83)}, RodModel::bend,
                                   c.motion, {}, 4)
            .value();
    std::mt19937 random{1};
    int reached = 0;
    const double begin = cpu_now();
    for (int k = 0; k < throws; ++k) {
      Eigen::Matrix3Xd nodes = cascade.stretched_flat(1);
      for (double& x : nodes.reshaped()) x += c.footprint.spacing * symmetric_uniform(random);
      reached += cascade.rest(1, nodes, watch).has_value();
    }
    const double seconds = 1000 * (cpu_now() - begin) / throws, share = double(reached) / throws;
    fmt::print(figures.lines(), "{:4} {:12.1f} {:7.1f} %\n", n, seconds, 100 * share);
    figures.add(fmt::format("{} rods, 1000 rests, s", n), seconds);
    figures.add(fmt::format("{} rods, at rest", n), share);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Figures figures(argc, argv);
  paper_shell(7, figures);
  drag(figures);
  if (std::count(figures.words().begin(), figures.words().end(), "sizes") > 0) sizes(figures);
  if (std::count(figures.words().begin(), figures.words().end(), "rests") > 0) rests(figures);
}
