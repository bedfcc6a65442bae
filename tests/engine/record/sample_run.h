// A small trajectory and a summary whose fields have distinct values.
#pragma once

#include <cmath>
#include <cstring>

#include "engine/record/summary.h"
#include "engine/record/trajectory.h"

namespace gridshell::record {

inline Trajectory sample_trajectory() {
  Trajectory run;
  Layout& layout = run.layout;
  layout.spacing_mm = 20;
  layout.rod_diameter_mm = 0.254;
  layout.joint_diameter_mm = 1.0 / 3, layout.joint_height_mm = 5, layout.table_mm = -0.1;
  layout.diameters_mm = {0.254, 0.3, 0.2, 1.0 / 3};
  layout.strength_MPa = {500, 500, 1.0 / 3, 500};
  layout.length_scale_mm = 126;
  // four crossings of two rods per direction, edge points 4 ... 11
  layout.rods = {{4, 0, 1, 5}, {6, 3, 2, 7}, {8, 0, 3, 9}, {10, 1, 2, 11}};
  layout.families = {"u", "u", "v", "v"};
  layout.supports = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  layout.sprung = {5};
  layout.spring_N_per_mm = Eigen::Vector3d(0.05, 0.1, 0);
  layout.joints = {
      {-1, -1, -10, -10, 0}, {0, -1, 10, -10, 1}, {0, 0, 10, 10, 2}, {-1, 0, -10, 10, 3}};
  layout.cells = {{-1, -1, 0, 0, {0, 1, 2, 3}}};
  layout.edge_points = {4, 5, 6, 7, 8, 9, 10, 11};
  layout.parts = {
      {"left", {{0, 1, 2}}, Eigen::Matrix3Xd::Random(3, 3), Eigen::Matrix3Xd::Random(3, 3)},
      {"right", {{0, 1}, {1, 0}}, Eigen::Matrix3Xd::Random(3, 2), Eigen::Matrix3Xd::Random(3, 2)}};
  layout.loaded_joints = {{1, {0.6, 0, -0.8}}, {2, {0, 0, 1}, true}};
  layout.seam_rods = {{"left.east - right.west", 'u', -10, 1.0 / 3, 7},
                      {"left.east - right.west", 'v', 10, 1.0 / 3, 0.1}};
  layout.original_boundary = Eigen::Matrix3Xd::Random(3, 5);
  layout.actuated_boundary = Eigen::Matrix3Xd::Random(3, 5);
  for (int k = 0; k < 3; ++k) {
    Frame frame;
    frame.index = k;
    frame.progress = k / 3.0;
    frame.boundary_radius_mm = 126 - 0.1 * k;
    frame.energies[Term::bend] = 1e-300 * k;
    frame.energies[Term::stretch] = 0.1 + 0.2 * k;
    frame.energies[Term::twist] = -0.0;
    frame.height_mm = 1.0 / 7 * k;
    frame.lowest_mm = -0.5 * k;
    frame.contacts = k;
    frame.rod_gap_mm = k == 1 ? unknown : -0.1;
    frame.joint_gap_mm = 1.0 / 3;
    frame.total_K = M_PI * k;
    frame.residual_N = 5e-324;
    frame.negative_pivots = k;
    frame.error_estimate_mm = k == 1 ? unknown : 1e-3;
    frame.force_error_N = k == 1 ? unknown : 1e-5 * k;
    frame.bending_strain_at = k == 2 ? "u0, 45.00 mm from its start, at joint [0, 1]" : "";
    frame.utilisation = k == 1 ? unknown : 0.7 * k;
    frame.stress_at = frame.bending_strain_at;
    frame.newton_iterations = 7 * k;
    frame.event = k == 2 ? "snap, \"fast\" \xC3\xA9" : "";
    frame.actuation = k / 7.0;
    frame.nodes = Eigen::Matrix3Xd::Random(3, 12) * 100;
    frame.cell_K = Eigen::VectorXd::Constant(1, 0.01 * k);
    frame.K_bins = Eigen::MatrixX3d::Constant(5, 3, 0.5 * k);
    run.frames.push_back(frame);
  }
  // in the frame between them these are unknown
  for (Frame* frame : {&run.frames.edit()[0], &run.frames.edit()[2]}) {
    frame->axial_force_N = Eigen::VectorXd::Random(12);
    frame->curvature_per_mm = Eigen::VectorXd::Random(16);
    frame->bending_mJ_per_m = Eigen::VectorXd::Random(16);
    frame->stress_MPa = Eigen::VectorXd::Random(16);
    frame->reactions_N = Eigen::Matrix3Xd::Random(3, 12);
  }
  run.origin = {"Sample \xC3\xA9", "s1_actuation", "gridshell 0.0"};
  // a NaN that carries bits of its own
  run.frames.edit()[1].nodes(0, 0) = std::nan("42");
  return run;
}

inline Summary sample_summary() {
  Summary summary;
  summary.preset = "s1_actuation";
  summary.model = "bend";
  summary.model_reason = "isotropic rods";
  summary.edges_per_segment = 4;
  summary.rods = 24, summary.joints = 120, summary.cells = 97, summary.dof = 2736;
  summary.stable = true;
  summary.limit = Limit::snap;
  summary.limit_reason = "a branch was lost at R_a = 97.1 mm";
  summary.doubt = "leading meshes of 4 and 8 edges do not agree";
  summary.residual_N = 1.0 / 3e9;
  summary.energies[Term::bend] = 39.979;
  summary.height_mm = 0.1, summary.lowest_mm = -1.0 / 3;
  summary.contacts = 2, summary.joint_gap_mm = -0.1;
  summary.contact = "joints (0, 0) and (0, 1) touch at progress 0.5";
  summary.total_K = 6.01157;
  summary.force_error_N = 2e-5;
  summary.bending_strain_at = "u0, 45.00 mm from its start, at joint [0, 1]";
  summary.max_deviation = 0.031029;
  summary.newton_iterations = 12, summary.factorizations = 13;
  summary.seconds_setup = 0.25;
  return summary;
}

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

template <class Matrix>
bool same_bits(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         (a.size() == 0 || std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
}

}  // namespace gridshell::record
