#include "engine/solve/turning_rods.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/elastic/model.h"
#include "engine/solve/newton.h"

namespace gridshell {
namespace {

/// Whether the boundary keeps what fixes a rod, its hinges and prescribed directions, on one line.
bool stays_on_line(const Footprint& footprint, std::size_t r, const std::vector<int>& hinges,
                   const BoundaryMotion& motion) {
  constexpr double on_line = 1e-9;  // deviation over the line's length; sine of a direction's angle
  const FootprintRod& rod = footprint.rods[r];
  std::vector<Eigen::Vector3d> points, directions;
  for (const auto& [kind, end] : {std::pair(rod.begin, 2 * r), {rod.end, 2 * r + 1}}) {
    const auto column = Eigen::Index(end);
    if (kind == RodEnd::sprung) return false;
    if (!is_fixed(kind)) continue;
    points.insert(points.end(), {motion.begin.col(column), motion.end.col(column)});
    if (fixes_direction(kind))
      directions.insert(directions.end(),
                        {motion.begin_tangent.col(column), motion.end_tangent.col(column)});
  }
  for (const int joint : hinges) {
    const auto fixed = std::ranges::find(footprint.fixed_joints, joint);
    if (fixed == footprint.fixed_joints.end() || footprint.is_sprung(joint)) return false;
    const auto column = Eigen::Index(fixed - footprint.fixed_joints.begin());
    points.insert(points.end(), {motion.begin_joints.col(column), motion.end_joints.col(column)});
  }
  if (rod.has_tails() || points.empty()) return false;
  const auto distance = [&](const Eigen::Vector3d& at) { return (at - points.front()).norm(); };
  const Eigen::Vector3d far = *std::ranges::max_element(points, {}, distance);
  const double length = distance(far);
  Eigen::Vector3d line = directions.empty() ? Eigen::Vector3d(0, 0, 0) : directions.front();
  if (length > 0) line = (far - points.front()) / length;
  const auto off = [&](const Eigen::Vector3d& direction) { return line.cross(direction).norm(); };
  return std::ranges::all_of(
             points,
             [&](const auto& at) { return off(at - points.front()) <= on_line * length; }) &&
         std::ranges::all_of(directions,
                             [&](const auto& direction) { return off(direction) <= on_line; });
}

}  // namespace

std::vector<TurningRod> turning_rods(const Footprint& footprint, const ShellRods& rods,
                                     const BoundaryMotion& motion, RodModel rod_model) {
  std::vector<int> connections(footprint.joints.size());
  for (const FootprintRod& rod : footprint.rods)
    for (const int joint : rod.joints) ++connections[std::size_t(joint)];
  for (const int joint : footprint.fixed_joints) ++connections[std::size_t(joint)];
  std::vector<TurningRod> turning;
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    if (rod.closed()) continue;
    std::vector<int> hinges;
    std::ranges::copy_if(rod.joints, std::back_inserter(hinges),
                         [&](int joint) { return connections[std::size_t(joint)] > 1; });
    // a joint with a law between its rods transmits moments
    if (rod_model == RodModel::twist && std::ranges::any_of(hinges, [&](int joint) {
          return footprint.joints[std::size_t(joint)].centred;
        }))
      continue;
    // a rod that spins freely turns about any two hinges, its section with it
    const bool spins = !fixes_direction(rod.begin) && !fixes_direction(rod.end);
    const auto points = std::ssize(hinges) + is_fixed(rod.begin) + is_fixed(rod.end);
    if ((spins && points <= 2) || ((spins || rods.material(r).round_and_straight()) &&
                                   stays_on_line(footprint, r, hinges, motion)))
      turning.push_back({r, std::move(hinges)});
  }
  return turning;
}

std::vector<TurningNodes> turning_nodes(const std::vector<TurningRod>& turning,
                                        const Footprint& footprint, const RodMesh& mesh) {
  std::vector<TurningNodes> found;
  for (const TurningRod& one : turning) {
    const FootprintRod& rod = footprint.rods[one.rod];
    const std::vector<int>& nodes = mesh.rods[one.rod];
    const bool spins = !fixes_direction(rod.begin) && !fixes_direction(rod.end);
    std::vector<int> axis;
    if (is_fixed(rod.begin)) axis.push_back(nodes.front());
    axis.insert(axis.end(), one.hinges.begin(), one.hinges.end());
    if (is_fixed(rod.end)) axis.push_back(nodes.back());
    if (axis.size() > 1 && axis.front() != axis.back())
      found.push_back({axis.front(), axis.back(), nodes, spins ? int(one.rod) : -1});
  }
  return found;
}

double turn_towards(const Eigen::Matrix3Xd& to, const std::vector<TurningNodes>& rods,
                    const Model& model, State& state) {
  const State before = state;
  Eigen::Matrix3Xd x = state.x;
  std::vector<Eigen::AngleAxisd> turns;
  for (const TurningNodes& rod : rods) {
    const Eigen::Vector3d from = x.col(rod.from), axis = (x.col(rod.to) - from).normalized();
    double along = 0, across = 0;
    for (const int node : rod.nodes) {
      const Eigen::Vector3d here = axis.cross(x.col(node) - from);
      const Eigen::Vector3d there = axis.cross(to.col(node) - to.col(rod.from));
      along += here.dot(there);
      across += axis.dot(here.cross(there));
    }
    turns.emplace_back(std::atan2(across, along), axis);
    for (const int node : rod.nodes) x.col(node) = from + turns.back() * (x.col(node) - from);
  }
  move_to(model, x, state);
  // move_to() has carried the frames in parallel: the sections must turn with their rods
  for (std::size_t k = 0; model.has_spins() && k < rods.size(); ++k) {
    if (rods[k].section < 0) continue;
    const Model::Rod& rod = model.rods[std::size_t(rods[k].section)];
    for (const int edge : rod.edges)
      state.director.col(edge) = turns[k] * before.director.col(edge);
    const auto bends = Eigen::seqN(rod.first_bend, std::ssize(rod.edges) - 1);
    state.reference_twist(bends) = before.reference_twist(bends);
  }
  return max_column_norm(x - before.x);
}

}  // namespace gridshell
