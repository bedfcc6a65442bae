// One sampled state of a run. Millimetres, newtons, millijoules, z up.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>

#include "engine/core/energies.h"

namespace gridshell::record {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// One sampled state. A quantity that does not apply or is not known is NaN (`unknown`).
struct Frame {
  int index = 0;
  double progress = 0;  ///< 0 at the original boundary, 1 at the end of the experiment
  double boundary_radius_mm = unknown;
  double depth_mm = unknown;
  double force_N = unknown;  ///< positive when the shell resists
  /// of a push: share of the joints that moved more than 0.1 and 0.5 of the depth, and the lowest
  /// latitude among the first
  double reach_above_tenth = unknown, reach_above_half = unknown, lowest_latitude_deg = unknown;
  Energies energies;           ///< by term, mJ
  double height_mm = 0;        ///< highest joint above the boundary's plane
  double lowest_mm = unknown;  ///< lowest point of a rod above that plane
  /// Places where rods, joints or the table overlap (contacts.h), -1: not looked for; and the least
  /// gaps between rods away from their joints and between joints, where they are below a diameter.
  int contacts = -1;
  double rod_gap_mm = unknown, joint_gap_mm = unknown;
  double total_K = 0;  ///< rad
  double residual_N = 0;
  int negative_pivots = 0;  ///< -1: not known
  double error_estimate_mm = unknown;
  int newton_iterations = 0;
  double time_s = unknown;  ///< of a snap in time, since its begin
  /// what force_N grows by with the depth, N/mm, and its error
  double stiffness_N_per_mm = unknown, stiffness_error_N_per_mm = unknown;
  double push_error_N = unknown;     ///< of force_N
  double largest_force_N = unknown;  ///< of reactions_N
  double force_error_N = unknown;    ///< of reactions_N and force_N, the largest
  double energy_error_mJ = unknown;  ///< of the terms and of their sum, the largest
  /// by which bending lengthens or shortens a fibre: the curvature added to that at rest times how
  /// far the section reaches from its axis; of the finest mesh
  double largest_bending_strain = unknown;
  std::string bending_strain_at;  ///< "u3, 45.00 mm from its begin, at joint [0, 1]"
  /// The largest stress of a fibre, of axial force and bending together, that over the rods'
  /// strength where it is known, and where the latter, or else the stress, is largest.
  double largest_stress_MPa = unknown, utilisation = unknown;
  std::string stress_at;
  std::string event;            ///< a snap, a limit, a recovery; empty when nothing happened
  std::string kind = "solved";  ///< or "interpolated": between solved states, its residual unknown
  Eigen::Matrix3Xd nodes;       ///< positions, mm
  Eigen::VectorXd cell_K;       ///< integrated Gauss curvature of each cell, rad
  /// Of the finest mesh itself, but for the reactions, which are extrapolated as energies are; with
  /// the loads these balance to `residual_N`. Empty where they are not known (in motion, a net, an
  /// older version).
  Eigen::VectorXd axial_force_N;     ///< of each edge, rod after rod; below 0: compressed
  Eigen::VectorXd curvature_per_mm;  ///< at each point of each rod, rod after rod
  Eigen::VectorXd bending_mJ_per_m;  ///< bending energy over length, at the same points
  Eigen::VectorXd stress_MPa;        ///< E (|N|/EA + strain by bending), at the same points
  Eigen::Matrix3Xd reactions_N;      ///< on each of Layout::supports; 0 where nothing holds it
  /// What acts from outside, handed on to Layout::supports: the sum is that of all loads. Empty:
  /// nothing acts.
  Eigen::Matrix3Xd loads_N;
  /// Axial forces of braces, of the finest mesh: along each cell's two diagonals, from joint (i, j)
  /// and from (i + 1, j); NaN: there is none. Empty: nothing is braced.
  Eigen::VectorXd brace_force_N;
  /// K of the cells by their centroid's x/L, L the half-span of the actuated boundary, in bins of
  /// equal width from -1 to 1, one a row: mean (rad), standard deviation (rad), number of cells
  Eigen::MatrixX3d K_bins;

  /// The boundary at this frame: every point moves straight and evenly, so it is linear in how far
  /// the actuation (not an indentation) has come.
  double actuation = 0;  ///< in [0, 1]
};

/// visit("energy_bend_mJ", energy) for every term.
template <class EnergiesType, class Visit>
void visit_energies(EnergiesType& energies, const Visit& visit) {
  for (const TermName& term : energy_terms)
    visit((std::string("energy_") + term.name + "_mJ").c_str(), energies[term.term]);
}

/// visit(matrix) for all that hangs on nodes, cells, bins and rods.
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
}

/// The frame's numbers, words and bins alone: what may stay in memory of any number of frames.
Frame without_nodes(const Frame& frame);

}  // namespace gridshell::record
