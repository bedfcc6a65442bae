
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/try.h"
#include "engine/simulate/frame_joints.h"
#include "engine/simulate/steps.h"

namespace gridshell::simulate {
namespace {

/// Checks that the shell is formed: a grid that is stiffened while flat can no longer be formed.
Result<void> check_formed(const Simulation& simulation) {
  const BoundaryMotion& motion = simulation.scene().motion;
  const bool moves = motion.begin.cols() > 0 && !motion.begin.isApprox(motion.end, 0);
  if (moves && simulation.progress() == 0)
    return invalid("got a flat grid, expected a formed shell: form it before stiffening");
  return {};
}

double stiffness_of(const preset::Step& step) {
  return step.stiffness_Nmm > 0 ? step.stiffness_Nmm : std::numeric_limits<double>::infinity();
}

/// Vectors of the current shape that bolts and braces fix, extrapolated from those of each mesh.
/// With the vectors of one mesh that mesh's error would be part of the problem that all meshes
/// solve, and no difference between meshes would show it.
template <typename OfLevel>
Eigen::Matrix3Xd fixed_vectors(const NestedShell& shell, const OfLevel& of_level) {
  std::vector<Eigen::Matrix3Xd> levels;
  for (int level = shell.first_of_last_three(); level < shell.levels(); ++level)
    levels.push_back(of_level(level));
  return certify_vectors(levels, levels.size() > 1, false).value;
}

Bolts now_tightened(const Simulation& simulation, double stiffness) {
  const NestedShell& shell = simulation.shell();
  Bolts bolts;
  std::vector<Eigen::Matrix3Xd> angles;  // of each mesh, in the first row
  const Eigen::Matrix3Xd tangents = fixed_vectors(shell, [&](int level) {
    // the last call, for the finest mesh, sets the result
    bolts = tightened(shell.mesh(level), shell.model(level),
                      shell.state().levels[std::size_t(level)], stiffness);
    std::vector<Eigen::Vector3d> all;
    for (const auto& rods : bolts.rods) all.insert(all.end(), rods.begin(), rods.end());
    Eigen::Matrix3Xd& angle = angles.emplace_back(Eigen::Matrix3Xd::Zero(3, bolts.rods.size()));
    for (int joint = 0; joint < angle.cols(); ++joint)
      if (bolts.rods[std::size_t(joint)].size() == 2) angle(0, joint) = bolts.angle(joint);
    return Eigen::Matrix3Xd(Eigen::Map<const Eigen::Matrix3Xd>(all.data()->data(), 3, all.size()));
  });
  // the error of bolts that these replace is not in the difference of the meshes
  const double before = simulation.rods().bolts ? simulation.rods().bolts->angle_error_rad : 0;
  bolts.angle_error_rad = before + certify_vectors(angles, angles.size() > 1, false).error;
  Eigen::Index column = 0;
  for (auto& rods : bolts.rods)
    for (Eigen::Vector3d& tangent : rods) tangent = tangents.col(column++).normalized();
  return bolts;
}

/// The torque of every joint's bolt that opens the joint, N mm.
std::vector<double> torques_of_bolts(const Simulation& simulation) {
  const NestedShell& shell = simulation.shell();
  const Eigen::Matrix3Xd torques = fixed_vectors(shell, [&](int level) -> Eigen::Matrix3Xd {
    const auto of =
        joint_torques(shell.mesh(level), shell.model(level),
                      shell.state().levels[std::size_t(level)], shell.outside(level).opening, true);
    return Eigen::RowVectorXd::Map(of.data(), Eigen::Index(of.size())).replicate(3, 1);
  });
  return {torques.row(0).begin(), torques.row(0).end()};
}

/// The change of each joint's natural angle, rad, after which its bolt (of `now`) has no torque at
/// the step's angle; NaN for joints that are not driven.
Result<std::vector<double>> openings(const preset::Step& step, const Footprint& footprint,
                                     const Bolts& now) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), rad = M_PI / 180;
  const auto rest = [&](std::size_t joint) {
    return now.angle(int(joint)) + (now.opened.empty() ? 0 : now.opened[joint]);
  };
  std::vector<double> by(now.rods.size(), none);
  for (const auto& row : step.angles) {
    const int joint = joint_at(footprint, int(row[0]), int(row[1]));
    if (joint < 0 || now.rods[std::size_t(joint)].size() != 2)
      return invalid("angles: got [{:g}, {:g}], expected a joint where two rods cross", row[0],
                     row[1]);
    if (!std::isnan(by[std::size_t(joint)]))
      return invalid("angles: got [{:g}, {:g}] twice, expected it once", row[0], row[1]);
    by[std::size_t(joint)] = row[2] * rad - rest(std::size_t(joint));
  }
  if (step.angles.empty()) {
    double sum = 0;
    int count = 0;
    for (std::size_t joint = 0; joint < by.size(); ++joint)
      if (now.rods[joint].size() == 2) sum += rest(joint), ++count;
    if (count == 0) return invalid("the footprint has no joint where two rods cross");
    for (std::size_t joint = 0; joint < by.size(); ++joint)
      if (now.rods[joint].size() == 2) by[joint] = step.angle_deg * rad - sum / count;
  }
  for (std::size_t joint = 0; joint < by.size(); ++joint) {
    const double to = std::isnan(by[joint]) ? 1 : rest(joint) + by[joint];
    if (!(to > rad && to < M_PI - rad))
      return invalid("joint [{}, {}]: got an angle of {:.4g} degrees, expected 1 to 179",
                     footprint.joints[joint].i, footprint.joints[joint].j, to / rad);
  }
  return by;
}

}  // namespace

bool opens_as_drawn(const std::vector<preset::Step>& steps, const Scene& scene) {
  const BoundaryMotion& motion = scene.motion;
  return !steps.empty() && steps.front().kind == preset::StepKind::open &&
         scene.footprint.rods.front().number >= 0 && motion.begin == motion.end &&
         motion.begin_joints == motion.end_joints;
}

Result<Bolts> bolts_as_drawn(const preset::Step& step, const Footprint& footprint) {
  Bolts bolts = drawn_bolts(mesh_rods(footprint, 2), stiffness_of(step));
  bolts.mean = step.drive == preset::JointDrive::mean;
  TRY(by, openings(step, footprint, bolts));
  for (std::size_t joint = 0; joint < by->size(); ++joint)
    if (std::isnan((*by)[joint])) bolts.rods[joint].clear();
  return bolts;
}

Result<Report> tighten(Simulation& simulation, const preset::Step& step, const Watch& watch) {
  TRY_DO(check_formed(simulation));
  ShellRods rods = simulation.rods();
  rods.bolts = std::make_shared<const Bolts>(now_tightened(simulation, stiffness_of(step)));
  return simulation.set_rods(rods, watch);
}

Result<Report> open(Simulation& simulation, const preset::Step& step, const Watch& watch,
                    PathSegment* path) {
  TRY_DO(check_formed(simulation));
  const double stiffness = stiffness_of(step);
  const auto known = simulation.rods().bolts;
  Bolts bolts = now_tightened(simulation, stiffness);
  bolts.mean = step.drive == preset::JointDrive::mean;
  bolts.opened.assign(bolts.rods.size(), 0);
  // existing bolts retain their natural angle; bolts that replace others take over their torque
  const bool same = known && known->stiffness_Nmm == stiffness && known->mean == bolts.mean;
  const std::vector<double> torques =
      known && !same ? torques_of_bolts(simulation) : std::vector<double>();
  for (std::size_t joint = 0; known && joint < bolts.rods.size(); ++joint) {
    if (known->rods[joint].empty()) continue;
    if (!same && bolts.rods[joint].size() == 2) {
      bolts.opened[joint] = torques[joint] / stiffness;
      continue;
    }
    bolts.rods[joint] = known->rods[joint];
    if (!known->opened.empty()) bolts.opened[joint] = known->opened[joint];
  }
  TRY(by, openings(step, simulation.scene().footprint, bolts));
  bolts.opening = *by;
  for (std::size_t joint = 0; joint < by->size(); ++joint) {
    if (!std::isnan((*by)[joint])) continue;
    bolts.opening[joint] = 0;
    if (!known || known->rods[joint].empty()) bolts.rods[joint].clear();
  }
  ShellRods rods = simulation.rods();
  rods.bolts = std::make_shared<const Bolts>(bolts);
  auto report = simulation.set_rods(rods, watch);
  if (!report || report->end != Outcome::reached) return report;
  report = simulation.open_joints(watch, path);
  if (path) path->path_end = simulation.save();
  // from now on this is the joints' natural angle
  for (std::size_t joint = 0; joint < by->size(); ++joint)
    bolts.opened[joint] += report->t * std::exchange(bolts.opening[joint], 0);
  rods.bolts = std::make_shared<const Bolts>(std::move(bolts));
  const auto kept = simulation.set_rods(rods, watch);
  if (!kept) return kept;
  if (report->end == Outcome::reached) report->end = kept->end;
  report->certificate = kept->certificate;
  return report;
}

std::string text_of_opened(const Simulation& simulation) {
  record::Frame frame;
  put_joints(simulation, frame);
  return text_of_joints(frame);
}

Result<Report> brace(Simulation& simulation, const preset::Step& step, const Watch& watch) {
  TRY_DO(check_formed(simulation));
  TRY(cells, cells_of(step, simulation.scene().footprint));
  if (cells->empty()) return invalid("the footprint has no cells to brace");
  ShellRods rods = simulation.rods();
  const NestedShell& shell = simulation.shell();
  const Eigen::Matrix3Xd at = fixed_vectors(shell, [&](int level) -> Eigen::Matrix3Xd {
    return shell.state().levels[std::size_t(level)].x.leftCols(shell.finest().joints);
  });
  for (const FootprintCell& cell : *cells) {
    for (const int k : {0, 1}) {
      if (step.diagonals == (k == 0 ? preset::Diagonals::second : preset::Diagonals::first))
        continue;
      const int a = cell.joints[std::size_t(k)], b = cell.joints[std::size_t(k + 2)];
      rods.braces.push_back({a, b, (at.col(b) - at.col(a)).norm(), step.EA_N,
                             step.brace == preset::BraceKind::cable});
    }
  }
  return simulation.set_rods(rods, watch);
}

Result<Report> take_out(Simulation& simulation, preset::Released what, const Watch& watch) {
  ShellRods rods = simulation.rods();
  const bool bolts = what == preset::Released::bolts;
  if (bolts ? !rods.bolts : rods.braces.empty())
    return invalid("got no {}, expected some to take out", word_of(what));
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
    return invalid("got load case \"{}\", expected the name of a [[loads.case]]", name);
  auto& cases = simulation.cases;
  auto on = std::ranges::find(cases, name, &CaseOnShell::name);
  if (on == cases.end())
    on = cases.insert(cases.end(), {name, forces_of(*known, scene.footprint, simulation.nodes()),
                                    known->dead, 0});
  const double more = factor - on->factor, before = on->factor;
  const auto index = on - cases.begin();
  std::vector<NodeAction> field = simulation.field();
  for (NodeAction action : on->forces) {
    action *= more;
    const auto there = std::ranges::find_if(field, [&](const NodeAction& one) {
      return one.node == action.node && one.term == action.term && one.stiffness.isZero(0) &&
             one.corners == action.corners;
    });
    if (there == field.end())
      field.push_back(action);
    else
      there->force += action.force, there->pressure += action.pressure;
  }
  const Report done = simulation.set_field(std::move(field), watch, more * on->dead);
  CaseOnShell& now = cases[std::size_t(index)];
  now.factor = done.end == Outcome::reached ? factor : before + done.t * more;
  if (now.factor == 0) cases.erase(cases.begin() + index);
  return done;
}

}  // namespace gridshell::simulate
