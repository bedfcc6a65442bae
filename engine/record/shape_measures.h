// What is measured on a shape: integrated Gauss curvature of the cells from the rods' crossing
// angles [Baek 2018, eq. 2], and how far it lies from the net it was designed on.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "engine/footprint/mesh.h"
#include "engine/footprint/symmetry.h"

namespace gridshell {

/// Unit tangents of the two rods at every joint: along +u of its u-rod, along +v of its v-rod (3 x
/// joints); where rods are of no grid of the first two that cross there, u x v upwards in the flat,
/// and zero where there are not two. t is proportional to t1 l2 + t2 l1, with t1, t2 the unit
/// tangents of the edges before and after the joint and l1, l2 their lengths: the derivative of a
/// quadratic through three nodes, second order in edge length.
struct JointTangents {
  Eigen::Matrix3Xd u, v;

  /// t_u x t_v, a unit vector.
  Eigen::Vector3d normal(Eigen::Index joint) const;
};

JointTangents joint_tangents(const Footprint& footprint, const RodMesh& mesh,
                             const Eigen::Matrix3Xd& x);

/// K of every complete cell = 2 pi - sum of its four interior angles, each between the tangents of
/// the rods at the joint (rad). [Hazzidakis 1880; Baek 2018, eq. 2]
Eigen::VectorXd cell_curvature(const Footprint& footprint, const JointTangents& tangents);

// Curvature of the cells along an axis, in bins [Baek 2018, Fig. 4D].

/// Bins of equal width over [-1, 1] of x/L, and what falls into each.
struct CurvatureBins {
  Eigen::VectorXd low, high;  ///< ends of each bin in x/L
  Eigen::VectorXi cells;      ///< how many cells
  Eigen::VectorXd mean;       ///< of K over the bin's cells, rad; NaN where there is none
  Eigen::VectorXd deviation;  ///< sqrt(mean of (K - mean)^2), rad: how unlike the cells are
};

/// The paper's five bins are 0.4 wide. A cell belongs to the bin of its centroid's x/L; one outside
/// the range to the bin at that end. `x_over_L` and `K`: one per cell.
CurvatureBins curvature_bins(const Eigen::VectorXd& x_over_L, const Eigen::VectorXd& K,
                             int bins = 5);

/// Delta/rho of the joints [Baek 2018, Fig. 3]: distance between each joint and its position on the
/// net, over the length scale rho.
class NetDeviation {
 public:
  /// `joints`, `net`: 3 x n in the same order and frame; rho in the same unit.
  NetDeviation(const Eigen::Matrix3Xd& joints, const Eigen::Matrix3Xd& net, double rho);

  const Eigen::VectorXd& of_joints() const { return of_joints_; }
  double largest() const;
  double mean() const;
  /// The value that a fraction q in [0, 1] of the joints does not exceed, linear between order
  /// statistics: quantile(0) is the least, quantile(0.5) the median, quantile(1) the largest.
  double quantile(double q) const;

 private:
  Eigen::VectorXd of_joints_, sorted_;
};

// How far a push at one joint is felt.

/// The reach of a displacement field |u|/depth over the joints [Baek 2018, Fig. 4C].
struct PushReach {
  double above_tenth = 0;  ///< fraction of the joints with |u|/depth > 0.1
  double above_half = 0;   ///< fraction of the joints with |u|/depth > 0.5
  /// lowest latitude of a joint with reach above 0.1, by its position before the push as seen from
  /// the origin: asin(z/|x|), degrees
  double lowest_latitude_deg = 0;
};

/// `before`, `now`: 3 x joints, mm; `depth`: of the push, mm. All NaN at depth 0.
PushReach push_reach(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double depth);

// By which mode rods buckled.

/// Inflections of every rod of a mesh whose nodes lie at `x` (3 x nodes, mm): how often its
/// curvature vector comes back on the other side, that is, with a negative product with the one
/// before. Curvatures below a twentieth of the rod's largest are not looked at. 0: buckled by the
/// first mode.
std::vector<int> inflections(const RodMesh& mesh, const Eigen::Matrix3Xd& x);

// Groups of symmetries of the square, up and down among them, by name.

/// Indices of square_symmetries(), ascending.
using SymmetryGroup = std::vector<int>;

/// Schoenflies name of a group of them, with the position of its mirrors where there are two: "C1",
/// "Cs_axis", "Cs_diagonal" (one vertical mirror), "C2", "C2v_axes", "C2v_diagonals", "C4", "C4v"
/// (full symmetry); with maps that invert z "Ci", "C2_level_axis", "C2_level_diagonal", "C2h_axis",
/// "C2h_diagonal", "S4", "D2_axes", "D2_diagonals", "D2d_axes", "D2d_diagonals" (its mirrors),
/// "D4", and "flat" for all that contain the reflection at the horizontal plane.
std::string name_of_group(const SymmetryGroup& group);

/// All groups among `symmetries`, each once: the trivial one and those of flat shapes left out, of
/// groups with the same name the first. In the order of their size, the largest first.
std::vector<SymmetryGroup> subgroups(const std::vector<MeshSymmetry>& symmetries);

/// Those of `symmetries` that leave a shape as it is: no joint (3 x n, mm) moves by more than
/// `tolerance_mm`.
SymmetryGroup group_of(const std::vector<MeshSymmetry>& symmetries, const Eigen::Matrix3Xd& joints,
                       double tolerance_mm);

// How far a shape is from the symmetry that another one has: the amplitude of a bifurcation
// diagram.

/// Those of the eight symmetries of the square (rotations and mirrors about the z-axis) that map a
/// flat footprint onto itself and leave a shape of it unchanged.
class SharedSymmetry {
 public:
  /// `flat` and `shape`: the joints, 2 x n and 3 x n, mm, both about their own middle. A symmetry
  /// of the shape moves no joint further than `within_mm`.
  SharedSymmetry(const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& shape, double within_mm);

  /// How many there are, the identity among them: 1 to 8.
  int order() const { return int(elements_.size()); }

  /// The part of a shape that breaks the symmetry, x - mean of g x over the group: 3 x n, mm.
  Eigen::Matrix3Xd broken(const Eigen::Matrix3Xd& joints) const;

 private:
  struct Element {
    Eigen::Matrix2d turn;
    std::vector<int> image;  // joint k goes to where joint image[k] is
  };
  static Eigen::Matrix3Xd moved(const Element& element, const Eigen::Matrix3Xd& joints);

  std::vector<Element> elements_;
};

/// Root of the mean square over the columns.
double root_mean_square(const Eigen::Matrix3Xd& columns);

}  // namespace gridshell
