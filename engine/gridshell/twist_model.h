// The mechanical model on the `twist` rung: full discrete elastic rods, three degrees of freedom a
// node and one angle an edge, frames carried in time [Bergou 2008, 2010]. For rods whose spin is
// held, whose section has axes, or which are curved or twisted at rest.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/rod/bend_material.h"
#include "engine/rod/energies.h"
#include "engine/rod/material.h"

namespace gridshell {

/// One rod: its nodes and their arc lengths at rest. A closed rod has one arc length more than
/// nodes. Ends that hold a direction (`tangent`, `clamped`) hold it at the end point itself: a
/// ghost edge beyond it, its bend counted over half an edge, so the hold is second order.
struct TwistRod {
  std::vector<int> nodes;
  std::vector<double> position;  ///< mm, ascending
  RodMaterial material;
  RodEnd begin = RodEnd::pinned, end = RodEnd::pinned;
  Eigen::Vector3d director{0, 0, 1};  ///< m1 at the begin, as near as the tangent allows

  bool closed() const { return position.size() == nodes.size() + 1; }
};

/// Edge vectors are unknowns' differences: to - from.
struct TwistEdge {
  int from = 0, to = 0;
  double rest_length = 0;  ///< mm
  double EA = 0;           ///< N; 0 for a ghost
};

/// Bending and twisting at the node between edges e and f.
struct TwistBend {
  int e = 0, f = 0;
  double length = 0;  ///< mean rest length of the two edges, half an edge at a held end
  MaterialBend bend;
  double GJ_l = 0, rest_twist = 0;  ///< mJ, rad
  bool round = true;                ///< the section's spin does not enter the bending
};

/// E = k/2 |x_a - x_b|^2: crossing rods held together by a stiff spring, each with its own node.
struct JointSpring {
  int a = 0, b = 0;
  double stiffness = 0;  ///< N/mm
};

/// E = k/8 sum over the four pairs of edges at a joint of (angle - rest)^2, one pair each: the
/// joint's resistance to shear.
struct JointShear {
  int e = 0, f = 0;      ///< an edge of either rod, both along their rod
  double stiffness = 0;  ///< k/4, N mm/rad
  double rest = M_PI / 2;
};

/// E = k/8 sum over the four pairs of edges at a joint of (phi_e^2 + phi_f^2), one pair each; phi
/// is the angle about an edge's tangent from the joint's normal t_e x t_f to the rod's director m1,
/// less that at rest: the joint passes twist from rod to rod.
struct JointTwist {
  int e = 0, f = 0;      ///< an edge of either rod, e x f along the normal
  double stiffness = 0;  ///< k/4, N mm/rad
};

/// Const once built.
struct TwistModel {
  int nodes = 0;  ///< ghosts are the last
  std::vector<TwistEdge> edges;
  std::vector<TwistBend> bends;
  std::vector<JointSpring> springs;
  std::vector<JointShear> shears;
  std::vector<JointTwist> twists;
  Eigen::Matrix3Xd load;    ///< dead force on every node, N
  std::vector<char> fixed;  ///< per unknown: 3 a node, then 1 an edge
  std::vector<int> index;   ///< per unknown: its row among the free ones, or -1
  std::vector<int> free;    ///< its inverse

  struct Rod {
    std::vector<int> edges;                ///< in order, ghosts too
    int ghost_begin = -1, ghost_end = -1;  ///< their edges
    bool closed = false;
    int held_spin = -1;  ///< edge whose angle is held as nothing resists the spin, or -1
    Eigen::Vector3d director;
  };
  std::vector<Rod> rods;

  int unknowns() const { return 3 * nodes + int(edges.size()); }
  int angle_of(int edge) const { return 3 * nodes + edge; }
  int dof() const { return int(free.size()); }

  /// Holds or frees an unknown; `number()` afterwards.
  void fix_node(int node) { fixed[3 * node] = fixed[3 * node + 1] = fixed[3 * node + 2] = 1; }
  void fix_angle(int edge) { fixed[angle_of(edge)] = 1; }
  void number();
};

/// Puts rods together; nodes that rods share are shared joints. The spin of a rod that nothing
/// resists (round and straight, no end clamped) costs no energy: one of its angles is held. Errors
/// (bad_input): stiffness that is not positive, a torsional stiffness that is missing where an end
/// is clamped, arc lengths that do not ascend, a node that does not exist.
Result<TwistModel> build_twist_model(int nodes, const std::vector<TwistRod>& rods);

/// Adds the resistance to shear `stiffness` (N mm/rad) where rods `a` and `b` of the model cross
/// at a node (or at two nodes a spring joins): the edges before and after it on each rod.
void add_joint_shear(TwistModel& model, int rod_a, int node_a, int rod_b, int node_b,
                     double stiffness, double rest_angle);

/// Adds the resistance to spin `stiffness` (N mm/rad) of both rods where they cross: their first
/// directors stay near the joint's normal, from the direction of `a` to that of `b`.
void add_joint_twist(TwistModel& model, int rod_a, int node_a, int rod_b, int node_b,
                     double stiffness);

/// What changes. Reference directors are unit normals of their edges; reference twists are carried
/// on continuously, so whole turns count.
struct TwistState {
  Eigen::Matrix3Xd x;               ///< 3 x nodes, mm
  Eigen::VectorXd angle;            ///< theta, one an edge
  Eigen::Matrix3Xd director;        ///< of the reference frames, one an edge
  Eigen::VectorXd reference_twist;  ///< m_ref, one a bend
  double load = 1;                  ///< factor of the dead loads that act
};

/// A state with the nodes at `x` (ghosts, if x does not have them, go straight on beyond their
/// ends), angles zero, and along each rod a frame without twist whose first director is the rod's.
TwistState start_twist_state(const TwistModel& model, const Eigen::Matrix3Xd& x);

/// Moves the nodes to x and the angles to `angle`, the reference frames along with them.
void move_to(const TwistModel& model, const Eigen::Matrix3Xd& x, const Eigen::VectorXd& angle,
             TwistState& state);

/// Turns the held end of a rod, end node and ghost together: the ghost edge points along
/// `direction` (from begin to end of the rod).
void set_end_direction(const TwistModel& model, int rod, bool at_end,
                       const Eigen::Vector3d& direction, TwistState& state);

/// m1 of an edge.
Eigen::Vector3d material_director(const TwistModel& model, const TwistState& state, int edge);
/// tau - tau_0 of a bend, the twist beyond that at rest, rad.
double excess_twist(const TwistModel& model, const TwistState& state, int bend);

Energies energies_of(const TwistModel& model, const TwistState& state);

/// Gradient and Hessian of the energy in one pattern that is worked out once. Keep one per model.
class TwistAssembly {
 public:
  explicit TwistAssembly(const TwistModel& model);

  void gradient_at(const TwistState& state) { assemble(state, false); }
  void hessian_at(const TwistState& state) { assemble(state, true); }

  const TwistModel& model() const { return model_; }
  const Energies& energies() const { return energies_; }
  /// by every unknown, fixed ones too: forces (N) and moments (mJ) that hold them
  const Eigen::VectorXd& gradient() const { return gradient_; }
  /// lower triangle over the free unknowns
  const Eigen::SparseMatrix<double>& hessian() const { return hessian_; }
  double smallest_cosine() const { return smallest_cosine_; }  ///< of the turns between edges

 private:
  void assemble(const TwistState& state, bool with_hessian);
  void add_links(const TwistState& state, bool with_hessian);
  void add_bends(const TwistState& state, bool with_hessian);
  void add_shears(const TwistState& state, bool with_hessian);
  void add_joint_twists(const TwistState& state, bool with_hessian);
  template <int N>
  void scatter(const int* unknowns, const Eigen::Matrix<double, N, 1>& gradient,
               const Eigen::Matrix<double, N, N>& hessian, bool with_hessian);
  void scatter_link(int from, int to, const Eigen::Vector3d& gradient,
                    const Eigen::Matrix3d& hessian, bool with_hessian);
  void scatter_pair(int e, int f, const PairEnergy& energy, bool with_hessian);

  const TwistModel& model_;
  Energies energies_;
  Eigen::VectorXd gradient_;
  Eigen::SparseMatrix<double> hessian_;
  std::vector<int> places_;  // where each element's entries go, element by element
  std::size_t next_place_ = 0;
  double smallest_cosine_ = 1;
};

}  // namespace gridshell
