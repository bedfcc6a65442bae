#include "engine/simulate/stiffening.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/core/try.h"

namespace gridshell::simulate {
namespace {

/// What is made stiff flat can no longer be formed.
Result<void> check_formed(const Simulation& simulation) {
  const BoundaryMotion& motion = simulation.scene().motion;
  const bool moves = motion.begin.cols() > 0 && !motion.begin.isApprox(motion.end, 0);
  if (moves && simulation.progress() == 0)
    return fail(Fault::bad_input, "the shell is flat yet: it must be formed before it is stiff");
  return {};
}

}  // namespace

Result<Report> tighten(Simulation& simulation, const preset::Step& step, const Watch& watch) {
  TRY_DO(check_formed(simulation));
  constexpr double rigid = std::numeric_limits<double>::infinity();
  const double stiffness = step.stiffness_Nmm > 0 ? step.stiffness_Nmm : rigid;
  const NestedShell& shell = simulation.shell();
  ShellRods rods = simulation.rods();
  rods.bolts = std::make_shared<const Bolts>(tightened(
      shell.finest(), shell.model(shell.levels() - 1), shell.state().levels.back().x, stiffness));
  return simulation.set_rods(rods, watch);
}

Result<Report> brace(Simulation& simulation, const preset::Step& step, const Watch& watch) {
  TRY_DO(check_formed(simulation));
  ShellRods rods = simulation.rods();
  // the finest mesh's own shape, which is free of stress then
  const Eigen::Matrix3Xd& at = simulation.shell().state().levels.back().x;
  for (const FootprintCell& cell : simulation.scene().footprint.cells) {
    const bool chosen = std::ranges::any_of(
        step.cells, [&](const auto& row) { return row[0] == cell.i && row[1] == cell.j; });
    if (!step.cells.empty() && !chosen) continue;
    for (const int k : {0, 1}) {
      if (step.diagonals == (k == 0 ? preset::Diagonals::second : preset::Diagonals::first))
        continue;
      const int a = cell.joints[std::size_t(k)], b = cell.joints[std::size_t(k + 2)];
      rods.braces.push_back({a, b, (at.col(b) - at.col(a)).norm(), step.EA_N,
                             step.brace == preset::BraceKind::cable});
    }
  }
  if (rods.braces.size() == simulation.rods().braces.size())
    return fail(Fault::bad_input, "the footprint has no such cells");
  return simulation.set_rods(rods, watch);
}

Result<Report> take_out(Simulation& simulation, preset::Released what, const Watch& watch) {
  ShellRods rods = simulation.rods();
  const bool bolts = what == preset::Released::bolts;
  if (bolts ? !rods.bolts : rods.braces.empty())
    return fail(Fault::bad_input, "there are no {} to take out", word_of(what));
  if (bolts)
    rods.bolts.reset();
  else
    rods.braces.clear();
  return simulation.set_rods(rods, watch);
}

Result<Report> bring_case(Simulation& simulation, const std::string& name, double factor,
                          const Watch& watch) {
  const Scene& scene = simulation.scene();
  const auto known = std::ranges::find(scene.load_cases, name, &LoadCase::name);
  if (known == scene.load_cases.end())
    return fail(Fault::bad_input, "there is no load case \"{}\"", name);
  auto& cases = simulation.cases;
  auto on = std::ranges::find(cases, name, &CaseOnShell::name);
  if (on == cases.end())
    on = cases.insert(cases.end(), {name, forces_of(*known, scene.footprint, simulation.nodes()),
                                    known->dead, 0});
  const double more = factor - on->factor, before = on->factor;
  const auto place = on - cases.begin();
  std::vector<NodeAction> field = simulation.field();
  for (NodeAction action : on->forces) {
    action *= more;
    const auto there = std::ranges::find_if(field, [&](const NodeAction& one) {
      return one.node == action.node && one.term == action.term && one.stiffness.isZero(0) &&
             one.beside == action.beside;
    });
    if (there == field.end())
      field.push_back(action);
    else
      there->force += action.force, there->pressure += action.pressure;
  }
  const Report done = simulation.set_field(std::move(field), watch, more * on->dead);
  CaseOnShell& now = cases[std::size_t(place)];
  now.factor = done.end == Outcome::reached ? factor : before + done.t * more;
  if (now.factor == 0) cases.erase(cases.begin() + place);
  return done;
}

}  // namespace gridshell::simulate
