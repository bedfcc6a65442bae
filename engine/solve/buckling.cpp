#include "engine/solve/buckling.h"

#include <cmath>
#include <set>

#include "engine/elastic/model.h"
#include "engine/footprint/symmetry.h"
#include "engine/solve/equilibrium.h"

namespace gridshell {
namespace {

constexpr double tilt =
    0.8;  // tilt of the dome towards a diagonal; a small one is lost to round-off

/// Distance between two nodes of a rod in the flat, mm; where the rod is straight its length
/// between them, which has no round-off.
double flat_chord(const RodMesh& mesh, std::size_t r, std::size_t from, std::size_t to) {
  const double along = mesh.position[r][to] - mesh.position[r][from];
  const double chord = (mesh.flat.col(mesh.rods[r][to]) - mesh.flat.col(mesh.rods[r][from])).norm();
  return chord < (1 - 1e-9) * along ? chord : along;
}

/// Sum of the distances of the constrained points from their centroid, mm.
double spread(const RodMesh& mesh, const Eigen::Matrix3Xd& x) {
  const std::vector<int> fixed = fixed_nodes(mesh);
  const Eigen::Matrix3Xd points = x(Eigen::all, fixed);
  return (points.colwise() - Eigen::Vector3d(points.rowwise().mean())).colwise().norm().sum();
}

}  // namespace

double mean_shortening(const RodMesh& mesh, const PinnedMotion& motion, double t) {
  double chords = 0, lengths = 0;
  const Eigen::Matrix3Xd x = motion.at(t);
  const std::set<int> fixed(mesh.fixed_joints.begin(), mesh.fixed_joints.end());
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    // from one constrained node to the next
    const std::vector<int>& node = mesh.rods[r];
    const std::size_t none = node.size();
    std::size_t before = none;
    for (std::size_t k = 0; k < node.size(); ++k) {
      const bool end = k == 0 || k + 1 == node.size();
      if (!(end && mesh.joint_of(node[k]) < 0) && !fixed.contains(node[k])) continue;
      if (before != none) {
        chords += (x.col(node[k]) - x.col(node[before])).norm();
        lengths += flat_chord(mesh, r, before, k);
      }
      before = k;
    }
  }
  // if no rod is constrained at two points: the contraction of all constrained points
  if (lengths > 0) return 1 - chords / lengths;
  const double before = spread(mesh, motion.at(0));
  return before > 0 ? 1 - spread(mesh, x) / before : 0;
}

Result<double> parameter_of_shortening(const RodMesh& mesh, const PinnedMotion& motion,
                                       double shortening) {
  double low = 0, high = 1;
  while (mean_shortening(mesh, motion, high) < shortening) {
    high *= 2;
    if (high > 1000)
      return fail(Fault::bad_input,
                  "the actuated boundary does not shorten the rods: nothing would buckle");
  }
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (mean_shortening(mesh, motion, middle) < shortening ? low : high) = middle;
  }
  return high;
}

State flat_state(const Model& model, const RodMesh& mesh, const PinnedMotion& motion,
                 const FlatFrame& flat) {
  Eigen::Matrix3Xd nodes = drawn_nodes(mesh, flat);
  nodes.rightCols(mesh.nodes_off_rods()) =
      motion.begin.middleCols(mesh.rod_nodes(), mesh.nodes_off_rods());
  return start_state(model, columns_of(mesh, model, nodes));
}

Result<State> first_buckled(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                            double t, const BuckleSeed& seed, const FlatFrame& flat,
                            const Watch& watch) {
  const Model& model = system.model();
  const double reach2 = mesh.flat.colwise().squaredNorm().maxCoeff();
  const double shortening = mean_shortening(mesh, motion, t);
  const double height = std::sqrt(std::max(shortening, 0.0) * reach2);
  Eigen::Matrix3Xd dome(3, mesh.nodes());
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Eigen::Vector2d p = mesh.flat.col(node);
    const double tilted = 1 - seed.up * seed.diagonal * tilt * p.x() * p.y() / reach2;
    dome.col(node) = flat.at((1 - shortening) * p);
    dome(2, node) += seed.up * height * (1 - p.squaredNorm() / reach2) * tilted;
  }
  State state = flat_state(model, mesh, motion, flat);
  move_to(model, columns_of(mesh, model, dome), state);
  motion.impose(system, t, state);
  const auto rise = [&](const State& at) { return seed.up * at.x.row(2).head(model.nodes).sum(); };
  const State seeded = state;
  // first with reduced EA: the result is near the equilibrium of the actual rods, without stretch
  if (minimise(system, state, {.tolerance_mm = 1e-2 * system.scale.length, .EA_scale = 0.01}, watch)
          .outcome == Outcome::not_finite)
    return fail(Fault::no_equilibrium, "no equilibrium: a position was not finite");
  // thick rods do not buckle with the reduced EA; from the flat, the side would be chosen by chance
  if (!(rise(state) > 0.1 * rise(seeded))) state = seeded;
  return minimise_from(system, std::move(state), watch);
}

}  // namespace gridshell
