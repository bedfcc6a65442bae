// The list of a frame's scalar quantities: the columns of frames.csv and the datasets of /frames in
// trajectory.h5, in this order. Text comes last, so that readers that only know numbers find all of
// them.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "engine/record/trajectory.h"

namespace gridshell::record {

/// A quantity by name, unit ("1" without one, "" for text) and its member of Frame.
struct FrameColumn {
  std::string name;
  const char* unit;
  /// A member, an energy term, or a function that computes a quantity which Frame does not store:
  /// that is written, and dropped when read back.
  std::variant<int Frame::*, double Frame::*, std::string Frame::*, Term, double (*)(const Frame&)>
      field;
};

/// Calls `visit(value)` with the member of a frame that belongs to a column, by reference.
template <class FrameType, class Visit>
decltype(auto) visit_column(const FrameColumn& column, FrameType& frame, Visit visit) {
  return std::visit(
      [&](auto field) -> decltype(auto) {
        if constexpr (std::is_same_v<decltype(field), Term>) {
          return visit(frame.energies[field]);
        } else if constexpr (std::is_same_v<decltype(field), double (*)(const Frame&)>) {
          double value = field(frame);
          return visit(value);
        } else {
          return visit(frame.*field);
        }
      },
      column.field);
}

inline const std::vector<FrameColumn> frame_columns = [] {
  std::vector<FrameColumn> columns{
      {"frame", "1", &Frame::index},
      {"progress", "1", &Frame::progress},
      {"boundary_radius_mm", "mm", &Frame::boundary_radius_mm},
      {"depth_mm", "mm", &Frame::depth_mm},
      {"force_N", "N", &Frame::force_N},
  };
  for (const TermName& term : energy_terms)
    columns.push_back({std::string("energy_") + term.name + "_mJ", "mJ", term.term});
  const std::vector<FrameColumn> others{
      {"height_mm", "mm", &Frame::height_mm},
      {"total_K", "rad", &Frame::total_K},
      {"residual_N", "N", &Frame::residual_N},
      {"negative_pivots", "1", &Frame::negative_pivots},
      {"error_estimate_mm", "mm", &Frame::error_estimate_mm},
      {"newton_iterations", "1", &Frame::newton_iterations},
      {"reach_above_tenth", "1", &Frame::reach_above_tenth},
      {"reach_above_half", "1", &Frame::reach_above_half},
      {"lowest_latitude_deg", "deg", &Frame::lowest_latitude_deg},
      {"time_s", "s", &Frame::time_s},
      {"stiffness_N_per_mm", "N/mm", &Frame::stiffness_N_per_mm},
      {"stiffness_error_N_per_mm", "N/mm", &Frame::stiffness_error_N_per_mm},
      {"push_error_N", "N", &Frame::push_error_N},
      {"largest_force_N", "N", &Frame::largest_force_N},
      {"force_error_N", "N", &Frame::force_error_N},
      {"energies_error_mJ", "mJ", &Frame::energy_error_mJ},
      {"largest_bending_strain", "1", &Frame::largest_bending_strain},
      {"largest_stress_MPa", "MPa", &Frame::largest_stress_MPa},
      {"utilisation", "1", &Frame::utilisation},
      {"lowest_mm", "mm", &Frame::lowest_mm},
      {"contacts", "1", &Frame::contacts},
      {"rod_gap_mm", "mm", &Frame::rod_gap_mm},
      {"joint_gap_mm", "mm", &Frame::joint_gap_mm},
      {"energy_mJ", "mJ", [](const Frame& frame) { return frame.energies.total(); }},
      {"joint_angle_deg", "deg", &Frame::joint_angle_deg},
      {"joint_angle_error_deg", "deg", &Frame::joint_angle_error_deg},
      {"smallest_joint_angle_deg", "deg", &Frame::smallest_joint_angle_deg},
      {"largest_joint_angle_deg", "deg", &Frame::largest_joint_angle_deg},
      {"one_joint_angle_error_deg", "deg", &Frame::one_angle_error_deg},
      {"joint_torque_Nmm", "N mm", &Frame::joint_torque_Nmm},
      {"joint_torque_error_Nmm", "N mm", &Frame::joint_torque_error_Nmm},
      {"springs_error_mJ", "mJ", &Frame::springs_error_mJ},
      {"kind", "", &Frame::kind},
      {"bending_strain_at", "", &Frame::bending_strain_at},
      {"stress_at", "", &Frame::stress_at},
      {"event", "", &Frame::event},
  };
  columns.insert(columns.end(), others.begin(), others.end());
  return columns;
}();

/// Stored in trajectory.h5 in addition to the columns above, to draw the boundary of a frame.
inline const FrameColumn actuation_column{"actuation", "1", &Frame::actuation};

using SizeOf = Eigen::Index (*)(const Layout&);

/// Calls visit(name, unit, size_of, meaning, field) for every array that a frame may lack;
/// size_of(layout) is its length.
template <class Visit>
void each_rod_field(const Visit& visit) {
  visit("/axial_force_N", "N", edges_of_rods,
        "of each edge, rod after rod; of the finest mesh itself", &Frame::axial_force_N);
  visit("/curvature_per_mm", "1/mm", points_of_rods,
        "at each point, rod after rod; of the finest mesh itself", &Frame::curvature_per_mm);
  visit("/bending_mJ_per_m", "mJ/m", points_of_rods,
        "energy over length, at each point; of the finest mesh itself", &Frame::bending_mJ_per_m);
  visit("/stress_MPa", "MPa", points_of_rods,
        "of a fibre, the largest at each point; of the finest mesh itself", &Frame::stress_MPa);
  const SizeOf supports = [](const Layout& layout) { return Eigen::Index(layout.supports.size()); };
  visit("/reactions_N", "N", supports,
        "on each of /layout/supports; with the loads they balance to residual_N; off by "
        "/frames/force_error_N at most",
        &Frame::reactions_N);
  visit("/loads_N", "N", supports, "handed on to each of /layout/supports", &Frame::loads_N);
  const SizeOf diagonals = [](const Layout& layout) {
    return 2 * Eigen::Index(layout.cells.size());
  };
  visit("/brace_force_N", "N", diagonals,
        "along both diagonals of each cell, from joint (i, j) and from (i + 1, j)",
        &Frame::brace_force_N);
  const SizeOf joints = [](const Layout& layout) { return Eigen::Index(layout.joints.size()); };
  visit("/joint_angle_deg", "deg", joints, "between the two rods of each joint", &Frame::angle_deg);
  visit("/joint_torque_Nmm", "N mm", joints,
        "of the springs of each joint, above 0 where it would open", &Frame::torque_Nmm);
}

}  // namespace gridshell::record
