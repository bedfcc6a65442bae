#include "engine/simulate/steps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "engine/core/algorithms.h"
#include "engine/core/try.h"
#include "engine/simulate/expected_cost.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/indentation.h"

namespace gridshell::simulate {
namespace {

Eigen::Vector3d vector_of(const std::vector<double>& xyz) { return {xyz[0], xyz[1], xyz[2]}; }

/// Displacements of the edge points in addition to the scene's motion, mm, that a move requests.
Result<Eigen::Matrix3Xd> dragged_of(const preset::Step& step, const Scene& scene) {
  Eigen::Matrix3Xd dragged = Eigen::Matrix3Xd::Zero(3, scene.motion.begin.cols());
  for (const auto& row : step.edge_points) {
    const auto k = Eigen::Index(row[0]);
    if (k >= dragged.cols())
      return invalid("got edge point {}, expected 0 to {}", k, dragged.cols() - 1);
    dragged.col(k) << row[1], row[2], row[3];
  }
  const BoundaryMotion& motion = scene.motion;
  if (!step.edge_points.empty() && (motion.end_tangent.cols() > 0 || motion.end_far.cols() > 0))
    return invalid("ends whose direction is prescribed cannot be moved one by one");
  return dragged;
}

Result<Report> move(Simulation& simulation, const preset::Step& step, const Watch& watch,
                    PathSegment* path) {
  const Scene& scene = simulation.scene();
  TRY(dragged, dragged_of(step, scene));
  const double progress = progress_of(step, scene);
  if (dragged->isZero(0) && simulation.dragged().isZero(0))
    return simulation.move_to(progress, watch, path);
  return simulation.move_edge_points(progress, *dragged, watch);
}

/// The position to which a step moves a joint: `target`. If the joint is `free` perpendicular to
/// `along`, only the component along it is prescribed.
struct Goal {
  int joint = 0;
  Eigen::Vector3d target, along;
  bool free = false;
};

Result<Goal> goal_of(const Simulation& simulation, const preset::Step& step) {
  TRY(joint, joint_named(simulation.scene().footprint, step.joint));
  TRY_DO(not_on_boundary(simulation.scene().footprint, *joint));
  const Eigen::Vector3d at = simulation.nodes().col(*joint);
  const bool constrains = step.kind == preset::StepKind::hold;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  if (!constrains && !step.to_mm.empty()) displacement = vector_of(step.to_mm) - at;
  if (!constrains && step.to_mm.empty()) {
    const Eigen::Vector3d normal =
        joint_normal(simulation.scene().footprint, simulation.shell(), *joint);
    if (normal.isZero(0))
      return invalid(
          "the shell has no normal at the joint, where no two rods cross, expected a target in "
          "to_mm");
    displacement = -step.depth_mm * normal;
  }
  Goal goal{*joint, at + displacement, Eigen::Vector3d::UnitZ(), false};
  goal.free = constrains ? !step.along.empty() : step.lateral == preset::Lateral::free;
  if (!step.along.empty())
    goal.along = vector_of(step.along).normalized();
  else if (displacement.norm() >= nearest_mm)
    goal.along = displacement.normalized();
  if (!step.along.empty()) goal.target = at + goal.along * goal.along.dot(displacement);
  return goal;
}

Result<Report> push(Simulation& simulation, const Goal& goal, const Watch& watch,
                    PathSegment* path) {
  Eigen::Vector3d displacement = goal.target - simulation.nodes().col(goal.joint);
  if (goal.free) displacement = goal.along * goal.along.dot(displacement);
  // a push without displacement constrains the joint along the push direction
  if (displacement.norm() < nearest_mm) displacement = nearest_mm * goal.along;
  return simulation.push(goal.joint, displacement, goal.free ? Across::free : Across::fixed, watch,
                         path);
}

Result<Report> release(Simulation& simulation, const preset::Step& step, const Watch& watch) {
  std::vector<int> joints;
  if (step.joint.empty()) {
    for (const Constraint& constraint : simulation.constraints()) joints.push_back(constraint.node);
  } else {
    TRY(joint, joint_named(simulation.scene().footprint, step.joint));
    if (std::ranges::any_of(simulation.constraints(), [&](const Constraint& constraint) {
          return constraint.node == *joint;
        }))
      joints = {*joint};
  }
  if (joints.empty()) return invalid("got no prescribed joint, expected one before a release");
  Report all;
  for (const int joint : joints) {
    std::vector<Event> before = std::move(all.events);
    all = simulation.release(joint, watch);
    all.events.insert(all.events.begin(), before.begin(), before.end());
    if (all.end != Outcome::reached) break;
  }
  return all;
}

/// One random force on every joint.
std::vector<NodeAction> random_field(const Scene& scene, int seed, double force_N) {
  std::mt19937 random{std::uint32_t(seed)};
  std::vector<NodeAction> field;
  for (int joint = 0; joint < int(scene.footprint.joints.size()); ++joint) {
    const double x = symmetric_uniform(random), y = symmetric_uniform(random),
                 z = symmetric_uniform(random);
    field.push_back({joint, force_N * Eigen::Vector3d(x, y, z)});
  }
  return field;
}

Result<Report> jitter(Simulation& simulation, const preset::Step& step, const Watch& watch) {
  const Checkpoint before = simulation.save();
  const std::vector<NodeAction> steady = simulation.field();
  auto field = random_field(simulation.scene(), step.seed, step.force_N);
  field.insert(field.end(), steady.begin(), steady.end());
  const Report thrown = simulation.set_field(field, watch);
  // a load that the shell cannot carry completely has moved it as well
  if (watch.cancelled()) return simulation.restore(before), thrown;
  Report back = simulation.set_field(steady, watch);
  back.events.insert(back.events.begin(), thrown.events.begin(), thrown.events.end());
  if (back.end != Outcome::reached) simulation.restore(before);
  return back;
}

Result<Report> take_step(Simulation& simulation, const preset::Step& step, const Watch& watch,
                         PathSegment* path) {
  switch (step.kind) {
    case preset::StepKind::move:
      return move(simulation, step, watch, path);
    case preset::StepKind::push:
    case preset::StepKind::hold: {
      TRY(goal, goal_of(simulation, step));
      simulation.constraint_origins.emplace(goal->joint, simulation.nodes().col(goal->joint));
      return push(simulation, *goal, watch, path);
    }
    case preset::StepKind::release:
      if (step.what != preset::Released::joints) return take_out(simulation, step.what, watch);
      return release(simulation, step, watch);
    case preset::StepKind::load:
      if (!step.load_case.empty())
        return bring_case(simulation, step.load_case, step.factor, watch);
      return simulation.load(step.factor, watch);
    case preset::StepKind::rest:
      return simulation.rest(watch, step.side);
    case preset::StepKind::jitter:
      return jitter(simulation, step, watch);
    case preset::StepKind::tighten:
      return tighten(simulation, step, watch);
    case preset::StepKind::open:
      return open(simulation, step, watch, path);
    case preset::StepKind::brace:
      return brace(simulation, step, watch);
  }
  return Report{};
}

}  // namespace

std::string text_of(const preset::Step& step) {
  std::string text(word_of(step.kind));
  if (!step.load_case.empty()) text += " " + step.load_case;
  if (step.what != preset::Released::joints) text += fmt::format(" {}", word_of(step.what));
  if (!step.joint.empty()) text += fmt::format(" [{}]", fmt::join(step.joint, ", "));
  return text;
}

Result<std::vector<FootprintCell>> cells_of(const preset::Step& step, const Footprint& footprint) {
  std::vector<FootprintCell> cells = footprint.cells;
  const auto is = [](const auto& name, const FootprintCell& cell) {
    return name[0] == cell.i && name[1] == cell.j;
  };
  for (const auto& name : step.cells)
    if (std::ranges::none_of(cells, [&](const auto& cell) { return is(name, cell); }))
      return invalid("cells: got [{:g}, {:g}], expected a cell of the footprint", name[0], name[1]);
  if (!step.cells.empty())
    std::erase_if(cells, [&](const auto& cell) {
      return std::ranges::none_of(step.cells, [&](const auto& name) { return is(name, cell); });
    });
  return cells;
}

double progress_of(const preset::Step& step, const Scene& scene) {
  return step.radius_mm == 0 ? step.progress : scene.progress_of_radius(step.radius_mm);
}

Result<Report> apply_step(Simulation& simulation, const preset::Step& step, const Watch& watch,
                          PathSegment* path) {
  auto report = take_step(simulation, step, watch, path);
  std::erase_if(simulation.constraint_origins, [&](const auto& origin) {
    return std::ranges::none_of(simulation.constraints(), [&](const Constraint& constraint) {
      return constraint.node == origin.first;
    });
  });
  return report;
}

}  // namespace gridshell::simulate
