#include "engine/simulate/frame_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "engine/elastic/model.h"
#include "engine/record/frame_values.h"
#include "engine/simulate/frames.h"

namespace gridshell::simulate {

int end_node(const RodMesh& mesh, int k) {
  const std::vector<int>& rod = mesh.rods[std::size_t(k / 2)];
  if (mesh.end_of(k) != RodEnd::joined) return mesh.joints + k;
  return k % 2 == 0 ? rod.front() : rod.back();
}

std::vector<int> supports_of(const RodMesh& mesh) {
  std::vector<int> nodes(std::size_t(mesh.joints));
  std::iota(nodes.begin(), nodes.end(), 0);
  for (int k = 0; k < mesh.edge_points; ++k)
    if (mesh.end_of(k) != RodEnd::joined) nodes.push_back(mesh.joints + k);
  for (int node : mesh.far_ends)
    if (node >= 0) nodes.push_back(node);
  return nodes;
}

Eigen::Matrix3Xd reactions_of(const RodMesh& mesh, const Model& model, const Assembly& at,
                              const std::vector<Constraint>& constraints) {
  const std::vector<int> supports = supports_of(mesh);
  std::vector<Eigen::Vector3d> on(std::size_t(mesh.rod_nodes()), Eigen::Vector3d::Zero());
  for (const int node : supports)
    if (model.pinned(node)) on[std::size_t(node)] = at.gradient.col(node);
  // a ghost is constrained with its end
  for (const Model::Rod& rod : model.rods) {
    for (const int edge : {rod.ghost_begin, rod.ghost_end}) {
      if (edge < 0) continue;
      const ModelEdge& ghost = model.edges[std::size_t(edge)];
      const bool begins = edge == rod.ghost_begin;
      const int end = begins ? ghost.to : ghost.from, outer = begins ? ghost.from : ghost.to;
      if (end < mesh.rod_nodes()) on[std::size_t(end)] += at.gradient.col(outer);
    }
  }
  for (const Constraint& constraint : constraints)
    on[std::size_t(constraint.node)] = constraint.part(at.gradient.col(constraint.node));
  for (const MeshSpring& spring : mesh.springs)
    on[std::size_t(spring.node)] += at.gradient.col(spring.support);
  Eigen::Matrix3Xd reactions(3, long(supports.size()));
  for (std::size_t k = 0; k < supports.size(); ++k)
    reactions.col(long(k)) = on[std::size_t(supports[k])];
  return reactions;
}

namespace {

/// External forces on all nodes of the model, N.
Eigen::Matrix3Xd acting_on(const Model& model, const Eigen::Matrix3Xd& x,
                           const ExternalLoads& outside) {
  Eigen::Matrix3Xd acting = Eigen::Matrix3Xd::Zero(3, model.nodes);
  const auto add = [&](const std::vector<NodeAction>& actions, double factor) {
    for (NodeAction one : actions) {
      one.stiffness.setZero();
      one.add_gradient(-factor, x, acting);
    }
  };
  add(model.loads, outside.load);
  if (outside.steady) add(*outside.steady, 1);
  if (outside.field) add(*outside.field, outside.field_factor);
  return acting;
}

}  // namespace

Eigen::Matrix3Xd loads_on(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& x,
                          const ExternalLoads& outside) {
  Eigen::Matrix3Xd acting = acting_on(model, x, outside);
  if (acting.isZero(0)) return {};
  // the second node of a joint with a spring
  for (int k = mesh.nodes(); k < model.nodes; ++k) acting.col(k - mesh.nodes()) += acting.col(k);
  const std::vector<int> supports = supports_of(mesh);
  std::vector<int> column(std::size_t(mesh.nodes()), -1);
  for (std::size_t k = 0; k < supports.size(); ++k) column[std::size_t(supports[k])] = int(k);
  Eigen::Matrix3Xd loads = acting(Eigen::all, supports);
  // distributes the forces between two supports as a beam does
  const auto hand_on = [&](std::size_t r, std::size_t from, std::size_t to) {
    const auto& s = mesh.position[r];
    for (std::size_t k = from + 1; k < to; ++k) {
      const double fraction = (s[k] - s[from]) / (s[to] - s[from]);
      const Eigen::Vector3d force = acting.col(mesh.rods[r][k]);
      loads.col(column[std::size_t(mesh.rods[r][from])]) += (1 - fraction) * force;
      loads.col(column[std::size_t(mesh.rods[r][to])]) += fraction * force;
    }
  };
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    std::optional<std::size_t> before;
    for (std::size_t k = 0; k < mesh.rods[r].size(); ++k) {
      if (column[std::size_t(mesh.rods[r][k])] < 0) continue;
      if (before) hand_on(r, *before, k);
      before = k;
    }
  }
  return loads;
}

Eigen::VectorXd brace_forces(const Footprint& footprint, const Model& model,
                             const Eigen::Matrix3Xd& x) {
  if (model.bars.empty()) return {};
  std::map<std::pair<int, int>, double> along;
  for (const ModelBar& bar : model.bars) {
    const int a = bar.law.a, b = bar.law.b;
    along[{a, b}] += bar.law.force(bar.law.strain((x.col(b) - x.col(a)).norm()));
  }
  Eigen::VectorXd forces(2 * Eigen::Index(footprint.cells.size()));
  for (Eigen::Index k = 0; k < forces.size(); ++k) {
    const auto& joints = footprint.cells[std::size_t(k / 2)].joints;
    const auto there = along.find({joints[std::size_t(k % 2)], joints[std::size_t(k % 2 + 2)]});
    forces[k] = there == along.end() ? record::unknown : there->second;
  }
  return forces;
}

// ---- forces and stress along rods ----

namespace {

/// Text on the position of a point on a rod: "u+3, 45.00 mm from its start, at joint [0, 1]".
std::string location_on_rod(const Footprint& footprint, const RodMesh& mesh, std::size_t r,
                            std::size_t point) {
  const std::vector<int>& nodes = mesh.rods[r];
  const std::vector<double>& position = mesh.position[r];
  const std::size_t first = mesh.is_ghost(nodes.front()) ? 1 : 0, k = first + point;
  const auto joint_from = [&](std::size_t from, int step) {
    for (std::size_t n = from; n < nodes.size(); n += std::size_t(step))
      if (const int at = mesh.joint_of(nodes[n]); at >= 0) {
        const FootprintJoint& joint = footprint.joints[std::size_t(at)];
        return fmt::format("[{}, {}]", joint.i, joint.j);
      }
    return std::string("its end");
  };
  std::string text = fmt::format("{}, {:.2f} mm from its start, ", name_of(footprint.rods[r]),
                                 position[k] - position[first]);
  if (mesh.joint_of(nodes[k]) >= 0) return text + "at joint " + joint_from(k, 1);
  return text + fmt::format("between {} and {}", joint_from(k, -1), joint_from(k, 1));
}

/// Curvature (1/mm), strain by bending and bending energy over length (mJ/m), point after point.
class Bending {
 public:
  Bending(const Model& model, const State& state, const Assembly& at)
      : model_(model), at_(at), energy_(bending_of(model, state)) {
    if (!strains_by_curvature(model)) strain_of_bend_ = bending_strain_of(model, state);
  }

  void put(const Model::Rod& rod, int bend) {
    const auto& [e, f, stiffness, slot] = model_.bends[std::size_t(bend)];
    const double length = length_between(model_, e, f);
    curvature_.push_back(
        record::curvature_between(at_.tangents.col(e), at_.tangents.col(f), length));
    over_length_.push_back(1000 * energy_[bend] / length);
    strain_.push_back(strain_of_bend_.size() > 0 ? strain_of_bend_[bend]
                                                 : rod.fibres.strain(curvature_.back()));
  }
  void put_straight() {
    curvature_.push_back(0);
    over_length_.push_back(0);
    strain_.push_back(0);
  }
  /// Strain at all points, rod after rod.
  const std::vector<double>& strain() const { return strain_; }
  void fill(record::Frame& frame) const {
    const auto vector_of = [](const std::vector<double>& values) {
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size())));
    };
    frame.curvature_per_mm = vector_of(curvature_);
    frame.bending_mJ_per_m = vector_of(over_length_);
  }

 private:
  const Model& model_;
  const Assembly& at_;
  Eigen::VectorXd energy_, strain_of_bend_;
  std::vector<double> curvature_, over_length_, strain_;
};

/// Number of nodes of a rod without its ghosts.
std::size_t points_of(const RodMesh& mesh, std::size_t rod) {
  return std::size_t(
      std::ranges::count_if(mesh.rods[rod], [&](int node) { return !mesh.is_ghost(node); }));
}

/// Text on the position of a point, counted over the points of all rods in order.
std::string location_of(const Footprint& footprint, const RodMesh& mesh, std::size_t point) {
  std::size_t r = 0;
  while (point >= points_of(mesh, r)) point -= points_of(mesh, r++);
  return location_on_rod(footprint, mesh, r, point);
}

/// Writes the largest stress of a fibre at every point, E (|N|/EA + bending strain), and the
/// largest of all. N is the larger axial force of the two edges at the point.
void put_stress(const Scene& scene, const RodMesh& mesh, const Model& model,
                const std::vector<double>& strain, record::Frame& frame) {
  frame.stress_MPa.resize(Eigen::Index(strain.size()));
  std::vector<double> counts;  // the summands of the largest value at the reported position
  Eigen::Index edge = 0, point = 0;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const Model::Rod& rod = model.rods[r];
    const double area = area_of(rod.fibres),
                 young = model.edges[std::size_t(rod.edges[rod.edges.size() / 2])].EA / area;
    const Eigen::Index points = Eigen::Index(points_of(mesh, r));
    for (Eigen::Index k = 0; k < points; ++k, ++point) {
      const double before = k > 0 ? std::abs(frame.axial_force_N[edge + k - 1]) : 0,
                   after = k + 1 < points ? std::abs(frame.axial_force_N[edge + k]) : 0;
      const double stress = std::max(before, after) / area + young * strain[std::size_t(point)];
      frame.stress_MPa[point] = stress;
      counts.push_back(scene.strength_MPa.empty() ? stress : stress / scene.strength_MPa[r]);
    }
    edge += points - 1;
  }
  const auto largest = std::ranges::max_element(counts);
  if (largest == counts.end()) return;
  frame.largest_stress_MPa = frame.stress_MPa.maxCoeff();
  if (!scene.strength_MPa.empty()) frame.utilisation = *largest;
  frame.stress_at = location_of(scene.footprint, mesh, std::size_t(largest - counts.begin()));
}

}  // namespace

double area_of(const FibreReach& fibres) {
  if (fibres.area_mm2 > 0) return fibres.area_mm2;
  return fibres.round ? M_PI * fibres.about_1 * fibres.about_1
                      : 4 * fibres.about_1 * fibres.about_2;
}

bool strains_by_curvature(const Model& model) {
  return std::get<std::vector<Pair<SectionBending>>>(model.pairs).empty() &&
         std::get<std::vector<Pair<EndBending>>>(model.pairs).empty();
}

void put_strains(const Scene& scene, const RodMesh& mesh, const Model& model,
                 const std::vector<double>& strain, record::Frame& frame) {
  const auto largest = std::ranges::max_element(strain);
  if (largest == strain.end()) return;
  frame.largest_bending_strain = *largest;
  frame.bending_strain_at =
      location_of(scene.footprint, mesh, std::size_t(largest - strain.begin()));
  put_stress(scene, mesh, model, strain, frame);
}

void put_rods(const Scene& scene, const RodMesh& mesh, const Model& model, const State& state,
              const Assembly& at, record::Frame& frame) {
  std::vector<double> force;
  Bending bending(model, state, at);
  // bends that close rings are the last ones
  int closing = int(model.bends.size());
  for (const Model::Rod& rod : model.rods) closing -= rod.closed;
  for (const Model::Rod& rod : model.rods) {
    const auto ghost = [&](std::size_t k) {
      return model.edges[std::size_t(rod.edges[k])].EA == 0;
    };
    const auto put_end = [&] {
      // where a ring closes its two ends are one node
      if (rod.closed)
        bending.put(rod, closing);
      else
        bending.put_straight();
    };
    for (std::size_t k = 0; k < rod.edges.size(); ++k) {
      if (k > 0)
        bending.put(rod, rod.first_bend + int(k) - 1);
      else if (!ghost(k))
        put_end();
      if (!ghost(k)) force.push_back(at.force[rod.edges[k]]);
    }
    if (!ghost(rod.edges.size() - 1)) put_end();
    closing += rod.closed;
  }
  frame.axial_force_N = Eigen::Map<Eigen::VectorXd>(force.data(), long(force.size()));
  bending.fill(frame);
  put_strains(scene, mesh, model, bending.strain(), frame);
}

}  // namespace gridshell::simulate
