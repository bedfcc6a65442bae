// Frame: one recorded state of a run. Units: mm, N, mJ, rad; z points up.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>

#include "engine/core/energies.h"

namespace gridshell::record {

/// Value of a quantity that does not apply or is not known.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Quantities of a state that the summary of a run reports for its last frame. A quantity that does
/// not apply or is not known is NaN (`unknown`).
struct StateFigures {
  double force_N = unknown;       ///< of a push, positive when the shell resists
  double push_error_N = unknown;  ///< error of force_N
  /// derivative of force_N by Frame::depth_mm, and its error
  double stiffness_N_per_mm = unknown, stiffness_error_N_per_mm = unknown;
  double largest_force_N = unknown;  ///< largest column norm of Frame::reactions_N
  double force_error_N = unknown;    ///< largest error of Frame::reactions_N and force_N
  Energies energies;                 ///< energy of each term, mJ
  double energy_error_mJ = unknown;  ///< largest error of an energy term or of their sum
  double height_mm = 0;              ///< z of the highest joint above the plane of the boundary
  double lowest_mm = unknown;        ///< z of the lowest point of a rod above that plane
  /// Number of interpenetrations of rods, joints and table (contacts.h); -1: not computed. Least
  /// gaps between rods away from their joints and between joints, mm, if below one diameter.
  int contacts = -1;
  double rod_gap_mm = unknown, joint_gap_mm = unknown;
  double total_K = 0;       ///< sum of Frame::cell_K, rad
  double residual_N = 0;    ///< largest unbalanced force, N
  int negative_pivots = 0;  ///< negative pivots of the Hessian; 0: stable, -1: not known
  /// Largest error of a node's position, by the difference of two meshes, mm.
  double error_estimate_mm = unknown;
  /// Largest strain of a fibre by bending, (curvature - natural curvature) times the distance of
  /// the fibre from the axis; on the finest mesh.
  double largest_bending_strain = unknown;
  std::string bending_strain_at;  ///< "u3, 45.00 mm from its start, at joint [0, 1]"
  /// Largest stress of a fibre by axial force and bending; largest ratio of stress to strength
  /// (utilisation) if the strength is known; and where the ratio, or else the stress, is largest.
  double largest_stress_MPa = unknown, utilisation = unknown;
  std::string stress_at;
};

/// One recorded state, filled by simulate::frame_of() and its callers. Nodes, rods, cells and
/// supports are those of Layout.
struct Frame : StateFigures {
  /// Position in the run, from 0.
  int index = 0;
  double progress = 0;  ///< 0 at the original boundary, 1 at the end of the experiment
  /// Current radius of a circular boundary, and depth of a push, mm.
  double boundary_radius_mm = unknown;
  double depth_mm = unknown;
  /// During a push, the fraction of the joints that moved more than 0.1 and more than 0.5 of the
  /// depth, and the lowest latitude, degrees, among the former.
  double reach_above_tenth = unknown, reach_above_half = unknown, lowest_latitude_deg = unknown;
  /// Newton iterations for this state.
  int newton_iterations = 0;
  double time_s = unknown;  ///< since the start of a dynamic snap
  /// Angles between the rods of joints with laws or springs, degrees: their mean and its error, the
  /// smallest and the largest; their largest torque and its error; the error of the energy of all
  /// springs of joints.
  double joint_angle_deg = unknown, joint_angle_error_deg = unknown;
  double smallest_joint_angle_deg = unknown, largest_joint_angle_deg = unknown;
  double one_angle_error_deg = unknown;  ///< largest error of the angle of a single joint
  double joint_torque_Nmm = unknown, joint_torque_error_Nmm = unknown;
  double springs_error_mJ = unknown;
  std::string event;            ///< a snap, a limit, a recovery; empty if nothing happened
  std::string kind = "solved";  ///< or "interpolated" between solved states, without a residual
  Eigen::Matrix3Xd nodes;       ///< 3 x nodes, mm; joints first
  Eigen::VectorXd cell_K;       ///< integrated Gauss curvature K_square of each cell, rad
  /// The next arrays are of the finest mesh, except for reactions_N, which is extrapolated where
  /// the energies are. Reactions and loads balance to `residual_N`. They are empty if not known (in
  /// motion, on a net, in files of an older version).
  Eigen::VectorXd axial_force_N;     ///< N, of each edge, rod after rod; below 0 in compression
  Eigen::VectorXd curvature_per_mm;  ///< 1/mm, at each point of each rod, rod after rod
  Eigen::VectorXd bending_mJ_per_m;  ///< bending energy per length, mJ/m, at the same points
  Eigen::VectorXd stress_MPa;        ///< MPa, E (|N|/EA + bending strain), at the same points
  Eigen::Matrix3Xd reactions_N;      ///< 3 x Layout::supports, N; 0 without a constraint
  /// Loads, distributed to Layout::supports, 3 x supports, N. Their sum is the sum of all loads.
  /// Empty if no load acts.
  Eigen::Matrix3Xd loads_N;
  /// Axial forces of braces on the finest mesh, N: for each cell the diagonal from joint (i, j),
  /// then the one from (i + 1, j); NaN where there is no brace. Empty without bracing.
  Eigen::VectorXd brace_force_N;
  /// Angle between the rods of each joint with laws or springs, degrees, NaN where not two rods
  /// cross, and torque of its springs, N mm, above 0 where it would open the joint; extrapolated as
  /// the energies. Empty without such joints.
  Eigen::VectorXd angle_deg, torque_Nmm;
  /// Statistics of cell_K by the cell centroid's x/L, L being the half-span of the actuated
  /// boundary: one row per bin of equal width from -1 to 1; columns mean (rad), standard deviation
  /// (rad), number of cells.
  Eigen::MatrixX3d K_bins;

  /// Progress of the actuation (not of an indentation), 0 to 1. Boundary points move on straight
  /// lines, linearly in it.
  double actuation = 0;
};

/// Calls visit("energy_bend_mJ", energy) for every term, energy in mJ.
template <class EnergiesType, class Visit>
void visit_energies(EnergiesType& energies, const Visit& visit) {
  for (const TermName& term : energy_terms)
    visit((std::string("energy_") + term.name + "_mJ").c_str(), energies[term.term]);
}

/// Calls visit(matrix) for every array member.
template <class FrameType, class Visit>
void visit_matrices(FrameType& frame, const Visit& visit) {
  visit(frame.nodes);
  visit(frame.cell_K);
  visit(frame.K_bins);
  visit(frame.axial_force_N);
  visit(frame.curvature_per_mm);
  visit(frame.reactions_N);
  visit(frame.bending_mJ_per_m);
  visit(frame.stress_MPa);
  visit(frame.loads_N);
  visit(frame.brace_force_N);
  visit(frame.angle_deg);
  visit(frame.torque_Nmm);
}

/// A copy of the frame without its arrays of nodes, cells and rods, except for K_bins: small enough
/// that all frames of a run fit in memory.
Frame without_nodes(const Frame& frame);

}  // namespace gridshell::record
