// The rods, joints and dead loads of a shell, which do not depend on the mesh of its footprint.
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
  int joint = 0;  ///< node of the joint or end
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// How crossing rods are connected.
struct JointLaw {
  double spring_N_per_mm = 0;  ///< of spring joints; 0: the rods have a common node
  double shear_Nmm = 0;        ///< per rad, against a change of the angle; 0: free; infinite: fixed
  double twist_Nmm = 0;        ///< per rad, against spin from the normal; 0: free; infinite: fixed
};

/// Bolts that resist changes of the angles that crossing rods had when the bolts were tightened. A
/// joint actuation increases these natural angles.
struct Bolts {
  double stiffness_Nmm = 0;  ///< per rad, of each joint; infinite: rigid
  /// Per joint the unit tangents of its rods at tightening; empty: it has no bolt.
  std::vector<std::vector<Eigen::Vector3d>> rods;
  /// Per joint the change of its natural angle since, rad; empty: none.
  std::vector<double> opened{};
  std::vector<double> opening{};  ///< target of a joint actuation in addition, rad; empty: none
  std::set<int> closed{};         ///< joints whose hinged rods had passed one another
  /// Whether the bolts resist only changes of the mean angle, by one torque that is equal at all
  /// joints.
  bool mean = false;
  double angle_error_rad = 0;  ///< largest error of the angles at tightening

  /// The angle between the first two rods of a joint at tightening, rad; negative if they had
  /// passed one another.
  double angle(int joint) const;
  int joints() const;  ///< number of joints with bolts
  /// The law between rods k and m of a joint, with `fraction` of the stiffness, at most `most`.
  JointAngle law(int joint, std::size_t k, std::size_t m, double fraction, double most) const;
};

/// A straight member between two joints.
struct Brace {
  int a = 0, b = 0;
  double rest_length_mm = 0, EA = 0;
  bool cable = false;  ///< no force in compression
};

/// Sections, joints and dead loads of the rods of a footprint.
struct ShellRods {
  std::vector<RodMaterial> materials;   ///< one per rod, or one for all
  JointLaw joints;                      ///< twist model; in the bend model rods have common nodes
  std::map<int, JointLaw> own_joints;   ///< laws of single joints that differ from `joints`
  std::vector<double> weight_N_per_mm;  ///< one per rod, downwards; empty: none
  double joint_weight_N = 0;            ///< weight of each joint, downwards
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
    // this does not compile with another member: decide whether it loads the shell
    const auto& [rods, law, laws, weight, of_joints, loads, touching, tight, diagonals] = *this;
    return !weight.empty() || of_joints != 0 || !loads.empty();
  }
};

/// Lumps a quantity `per_mm` of each rod at the nodes of a mesh: half of each edge at each of its
/// nodes; ghost edges have none.
Eigen::VectorXd lumped(const RodMesh& mesh, const std::vector<double>& per_mm);

/// Dead forces on the nodes of a mesh.
std::vector<NodeAction> dead_loads(const RodMesh& mesh, const ShellRods& rods);

/// Builds the model of a meshed footprint. Edge points are pinned, except free ends and those on
/// springs; so are ghosts, supports of springs and the far ends of tails. Node numbers are those of
/// the mesh; with spring joints the v rod's own nodes of the joints follow, in the order of the
/// joints. First directors point up from the flat (+z); for rods drawn in space they are the mean
/// of the normals at their joints, which all point to one side, the upper one. A rod is naturally
/// straight or has its drawn shape, without natural twist. Where several rods cross, the joint's
/// law is distributed over their pairs. Errors as build_model() above.
Result<Model> build_model(const RodMesh& mesh, const ShellRods& rods,
                          RodModel rod_model = RodModel::bend);

/// Torques of bolts and of joints that resist shear, N mm, one per joint, positive if they open it:
/// sums of k (natural angle - angle) over every two of its rods, at the fraction `opening` of the
/// joint actuation. `bolts_alone`: only the torque of the bolt, for joints of two rods.
std::vector<double> joint_torques(const RodMesh& mesh, const Model& model, const State& state,
                                  double opening = 0, bool bolts_alone = false);

/// Bolts with the drawn angles between rods as natural angles.
Bolts drawn_bolts(const RodMesh& mesh, double stiffness_Nmm);

/// Bolts that are tightened in a state of `model`.
Bolts tightened(const RodMesh& mesh, const Model& model, const State& state, double stiffness_Nmm);

/// The footprint with edges centred on the joints that bolts connect.
Footprint centred(Footprint footprint, const Bolts* bolts);

/// Columns of a model's state from positions of the mesh's nodes: second nodes of joints are at the
/// joints, angles are zero.
Eigen::Matrix3Xd columns_of(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& nodes);
/// Positions of the mesh's nodes from a state: a joint is in the middle between its two rods'
/// nodes.
Eigen::Matrix3Xd nodes_of(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& columns);

}  // namespace gridshell
