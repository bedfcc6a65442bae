// The rods of a shell, how they cross and what they carry, the same on every mesh of its footprint.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "engine/core/choices.h"
#include "engine/core/result.h"
#include "engine/elastic/contact.h"
#include "engine/elastic/element_energies.h"
#include "engine/elastic/rod_material.h"
#include "engine/footprint/mesh.h"

namespace gridshell {

struct Model;
struct State;

/// A dead force on a joint or an end, N.
struct PointLoad {
  int joint = 0;  ///< its node
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// How crossing rods are connected.
struct JointLaw {
  double spring_N_per_mm = 0;  ///< of spring joints; 0: the rods share a node
  double shear_Nmm = 0;        ///< per rad; 0: they shear freely; infinite: they keep their angle
  double twist_Nmm = 0;  ///< per rad; 0: they pass no twist; infinite: they keep to the normal
};

/// Bolts that keep the angles that crossing rods had when they were tightened. Joints that are
/// opened strive for angles as much larger.
struct Bolts {
  double stiffness_Nmm = 0;                        ///< per rad, of each joint; infinite: rigid
  std::vector<std::vector<Eigen::Vector3d>> rods;  ///< of every joint, unit tangents; or none
  std::vector<double> opened{};   ///< of every joint, rad; empty: as they were tightened
  std::vector<double> opening{};  ///< angle to be added to that, rad; empty: nothing
  std::set<int> closed{};         ///< joints whose hinged rods had passed one another
  bool mean =
      false;  ///< they keep the mean of these angles alone, by a torque that is equal at all

  /// The angle between the first two rods of a joint as it was tightened, rad; of one that had
  /// closed below zero.
  double angle(int joint) const;
  int joints() const;  ///< that have bolts
  /// The law between two of its rods, which count by `fraction`; at most as stiff as `most`.
  JointAngle law(int joint, std::size_t k, std::size_t m, double fraction, double most) const;
};

/// A straight member between two joints.
struct Brace {
  int a = 0, b = 0;
  double rest_length_mm = 0, EA = 0;
  bool cable = false;  ///< bears no compression
};

/// Sections, joints and dead loads of the rods of a footprint.
struct ShellRods {
  std::vector<RodMaterial> materials;   ///< one per rod, or one for all
  JointLaw joints;                      ///< of the twist model; in the bend model rods share nodes
  std::map<int, JointLaw> own_joints;   ///< of joints that turn by other laws
  std::vector<double> weight_N_per_mm;  ///< one per rod, downwards; empty: none
  double joint_weight_N = 0;            ///< of every joint, downwards
  std::vector<PointLoad> points;
  ContactLaw contact;
  std::shared_ptr<const Bolts> bolts;  ///< null: none
  std::vector<Brace> braces;

  ShellRods() = default;
  ShellRods(const RodMaterial& material);  // NOLINT: one material for all rods
  ShellRods(const RodSection& section);    // NOLINT

  const RodMaterial& material(std::size_t rod) const {
    return materials.size() == 1 ? materials.front() : materials[rod];
  }
  const JointLaw& law(int joint) const {
    const auto own = own_joints.find(joint);
    return own == own_joints.end() ? joints : own->second;
  }
  bool loaded() const {
    // a member more does not compile here: whoever adds one says whether it loads the shell
    const auto& [rods, law, laws, weight, of_joints, loads, touching, tight, diagonals] = *this;
    return !weight.empty() || of_joints != 0 || !loads.empty();
  }
};

/// What `per_mm` of each rod puts on every node of a mesh: half of each edge that meets there, none
/// from the edges to ghosts.
Eigen::VectorXd lumped(const RodMesh& mesh, const std::vector<double>& per_mm);

/// Dead forces on the nodes of a mesh.
std::vector<NodeAction> dead_loads(const RodMesh& mesh, const ShellRods& rods);

/// The model of a meshed footprint; edge points are pinned but for free ends and those on springs,
/// ghosts, supports of springs and the far ends of tails too. Node
/// numbers are the mesh's; with spring joints the v rod's own node of a joint comes after them, in
/// the order of the joints. First directors point up from the flat (+z), or, of rods drawn in
/// space, along the mean of the normals at their joints: these are all to one side, the upper one.
/// A rod is naturally straight, or as it is drawn; without twist as drawn. Where several rods
/// cross, each pair has such a fraction that all together are the joint's law. Errors as
/// build_model().
Result<Model> build_model(const RodMesh& mesh, const ShellRods& rods,
                          RodModel rod_model = RodModel::bend);

/// Torques of bolts and of joints that resist shear, on each joint's rods, that would open it: sums
/// of k (rest - angle) over every two of its rods, N mm, at the opening that has come. Of bolts
/// alone, where two rods cross and have one.
std::vector<double> joint_torques(const RodMesh& mesh, const Model& model, const State& state,
                                  double opening = 0, bool bolts_alone = false);

/// Bolts that keep the angles between rods as drawn.
Bolts drawn_bolts(const RodMesh& mesh, double stiffness_Nmm);

/// Bolts tightened in a state of that model.
Bolts tightened(const RodMesh& mesh, const Model& model, const State& state, double stiffness_Nmm);

/// The footprint with edges centred on the joints that bolts connect.
Footprint centred(Footprint footprint, const Bolts* bolts);

/// Columns of a model's state from positions of the mesh's nodes: twins of joints where these are,
/// angles zero.
Eigen::Matrix3Xd columns_of(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& nodes);
/// Positions of the mesh's nodes from a state: a joint is in the middle between its two rods'
/// nodes.
Eigen::Matrix3Xd nodes_of(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& columns);

}  // namespace gridshell
