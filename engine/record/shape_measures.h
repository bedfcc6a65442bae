// Measures of a shape: integrated Gauss curvature of the cells from the rods' crossing angles [Baek
// 2018, eq. 2], deviation from the Chebyshev net, reach of a push, inflections, symmetries.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "engine/footprint/mesh.h"
#include "engine/footprint/symmetry.h"

namespace gridshell {

/// Unit tangents of the two rods at every joint, 3 x joints: along +u of its u-rod, along +v of its
/// v-rod. In a network that is no square grid u and v are the first two rods at the joint, oriented
/// so that u x v points upwards in the flat; zero if there are not two. A tangent is proportional
/// to t1 l2 + t2 l1, with t1, t2 the unit tangents of the edges before and after the joint and l1,
/// l2 their lengths: the derivative of a quadratic through three nodes, second order in edge
/// length.
struct JointTangents {
  Eigen::Matrix3Xd u, v;

  /// t_u x t_v, a unit vector.
  Eigen::Vector3d normal(Eigen::Index joint) const;
};

/// The tangents of a shape `x`, 3 x nodes, mm.
JointTangents joint_tangents(const Footprint& footprint, const RodMesh& mesh,
                             const Eigen::Matrix3Xd& x);

/// Integrated Gauss curvature of every complete cell, rad: K = 2 pi - the sum of its four interior
/// angles, each between the tangents of the rods at the joint [Hazzidakis 1880; Baek 2018, eq. 2].
Eigen::VectorXd cell_curvature(const Footprint& footprint, const JointTangents& tangents);

// Curvature of the cells along an axis, in bins [Baek 2018, Fig. 4D].

/// Bins of equal width over [-1, 1] of x/L, and the statistics of the cells in each.
struct CurvatureBins {
  Eigen::VectorXd low, high;  ///< ends of each bin in x/L
  Eigen::VectorXi cells;      ///< number of cells
  Eigen::VectorXd mean;       ///< mean of K over the bin's cells, rad; NaN if there is none
  Eigen::VectorXd deviation;  ///< standard deviation sqrt(mean of (K - mean)^2), rad
};

/// Sorts the cells into bins; the paper has five, which are 0.4 wide. A cell belongs to the bin of
/// its centroid's x/L, a cell outside the range to the first or last bin. `x_over_L` and `K`: one
/// per cell.
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

/// The reach of a displacement field |u|/depth over the joints [Baek 2018, Fig. 4C].
struct PushReach {
  double above_tenth = 0;  ///< fraction of the joints with |u|/depth > 0.1
  double above_half = 0;   ///< fraction of the joints with |u|/depth > 0.5
  /// lowest latitude of a joint with reach above 0.1, by its position before the push as seen from
  /// the origin: asin(z/|x|), degrees
  double lowest_latitude_deg = 0;
};

/// The reach of a push of depth `depth`, mm, from the positions `before` and `now`, 3 x joints, mm.
/// All NaN at depth 0.
PushReach push_reach(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double depth);

/// Number of inflections of every rod of a mesh whose nodes have the positions `x`, 3 x nodes, mm:
/// how often the scalar product of consecutive curvature vectors is negative. Curvatures below a
/// twentieth of the rod's largest are ignored. 0: the rod buckled in its first mode.
std::vector<int> inflections(const RodMesh& mesh, const Eigen::Matrix3Xd& x);

// Groups of symmetries of the square, with those that invert z.

/// A group as indices into square_symmetries(), ascending.
using SymmetryGroup = std::vector<int>;

/// Schoenflies name of a group, with the position of its axes or mirrors where two are possible.
/// Without maps that invert z: "C1", "Cs_axis", "Cs_diagonal" (one vertical mirror), "C2",
/// "C2v_axes", "C2v_diagonals", "C4", "C4v" (full symmetry). With such maps: "Ci", "C2_level_axis",
/// "C2_level_diagonal", "C2h_axis", "C2h_diagonal", "S4", "D2_axes", "D2_diagonals", "D2d_axes",
/// "D2d_diagonals" (position of the mirrors), "D4", and "flat" for all groups with the reflection
/// at the horizontal plane.
std::string name_of_group(const SymmetryGroup& group);

/// The groups of elements of `symmetries`, the largest first, without the trivial group and those
/// of flat shapes. Of groups with the same name only the first is listed.
std::vector<SymmetryGroup> subgroups(const std::vector<MeshSymmetry>& symmetries);

/// The group of those `symmetries` that leave a shape unchanged: they move no joint (3 x n, mm) by
/// more than `tolerance_mm`.
SymmetryGroup group_of(const std::vector<MeshSymmetry>& symmetries, const Eigen::Matrix3Xd& joints,
                       double tolerance_mm);

/// The symmetries of a shape, and the part of other shapes that breaks them: the amplitude in a
/// bifurcation diagram. Considered are the eight symmetries of the square (rotations about the
/// z-axis, vertical mirrors) that map the flat footprint onto itself.
class SharedSymmetry {
 public:
  /// `flat` and `shape` are the positions of the joints, 2 x n and 3 x n, mm; both are centred on
  /// their own middle. A symmetry of the shape moves no joint further than `within_mm`.
  SharedSymmetry(const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& shape, double within_mm);

  /// Number of symmetries of the shape with the identity: 1 to 8.
  int order() const { return int(group_.size()); }

  /// The part of a shape that breaks the symmetry, x - mean of g x over the group: 3 x n, mm.
  Eigen::Matrix3Xd broken(const Eigen::Matrix3Xd& joints) const;

 private:
  std::vector<MeshSymmetry> group_;
};

/// Root mean square of the norms of the columns.
double root_mean_square(const Eigen::Matrix3Xd& columns);

}  // namespace gridshell
