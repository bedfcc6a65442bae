// Whether two runs are the same bit for bit.
#pragma once

#include <catch2/catch.hpp>

#include "engine/record/frame_columns.h"
#include "tests/engine/record/sample_run.h"

namespace gridshell::record {

inline void check_same_layout(const Layout& a, const Layout& b) {
  CHECK(same_bits(a.spacing_mm, b.spacing_mm));
  CHECK(same_bits(a.rod_diameter_mm, b.rod_diameter_mm));
  CHECK(same_bits(a.length_scale_mm, b.length_scale_mm));
  CHECK(same_bits(a.joint_diameter_mm, b.joint_diameter_mm));
  CHECK(same_bits(a.joint_height_mm, b.joint_height_mm));
  CHECK(same_bits(a.table_mm, b.table_mm));
  CHECK(a.diameters_mm == b.diameters_mm);
  CHECK(a.rods == b.rods);
  CHECK(a.families == b.families);
  CHECK(a.supports == b.supports);
  CHECK(a.edge_points == b.edge_points);
  CHECK(same_bits(a.original_boundary, b.original_boundary));
  CHECK(same_bits(a.actuated_boundary, b.actuated_boundary));
  REQUIRE(a.joints.size() == b.joints.size());
  for (std::size_t k = 0; k < a.joints.size(); ++k) {
    const Joint &x = a.joints[k], &y = b.joints[k];
    CHECK((x.i == y.i && x.j == y.j && x.node == y.node));
    CHECK((same_bits(x.u_mm, y.u_mm) && same_bits(x.v_mm, y.v_mm)));
  }
  REQUIRE(a.cells.size() == b.cells.size());
  for (std::size_t k = 0; k < a.cells.size(); ++k) {
    const Cell &x = a.cells[k], &y = b.cells[k];
    CHECK((x.i == y.i && x.j == y.j && x.joints == y.joints));
    CHECK((same_bits(x.u_mm, y.u_mm) && same_bits(x.v_mm, y.v_mm)));
  }
  REQUIRE(a.parts.size() == b.parts.size());
  for (std::size_t k = 0; k < a.parts.size(); ++k) {
    CHECK((a.parts[k].name == b.parts[k].name && a.parts[k].rods == b.parts[k].rods));
    CHECK(same_bits(a.parts[k].net, b.parts[k].net));
    CHECK(same_bits(a.parts[k].flat, b.parts[k].flat));
  }
  REQUIRE(a.loaded_joints.size() == b.loaded_joints.size());
  for (std::size_t k = 0; k < a.loaded_joints.size(); ++k) {
    CHECK(a.loaded_joints[k].joint == b.loaded_joints[k].joint);
    CHECK(a.loaded_joints[k].direction == b.loaded_joints[k].direction);
    CHECK(a.loaded_joints[k].at_times == b.loaded_joints[k].at_times);
  }
  REQUIRE(a.seam_rods.size() == b.seam_rods.size());
  for (std::size_t k = 0; k < a.seam_rods.size(); ++k) {
    const SeamRod &x = a.seam_rods[k], &y = b.seam_rods[k];
    CHECK((x.seam == y.seam && x.family == y.family));
    CHECK((same_bits(x.line_mm, y.line_mm) && same_bits(x.gap_mm, y.gap_mm)));
    CHECK(same_bits(x.kink_deg, y.kink_deg));
  }
}

inline bool same(int a, int b) { return a == b; }
inline bool same(double a, double b) { return same_bits(a, b); }
inline bool same(const std::string& a, const std::string& b) { return a == b; }

inline void check_same_frame(const Frame& a, const Frame& b) {
  CHECK(same_bits(a.nodes, b.nodes));
  CHECK(same_bits(a.cell_K, b.cell_K));
  CHECK(same_bits(a.K_bins, b.K_bins));
  CHECK(same_bits(a.axial_force_N, b.axial_force_N));
  CHECK(same_bits(a.curvature_per_mm, b.curvature_per_mm));
  CHECK(same_bits(a.stress_MPa, b.stress_MPa));
  CHECK(same_bits(a.bending_mJ_per_m, b.bending_mJ_per_m));
  CHECK(same_bits(a.reactions_N, b.reactions_N));
  CHECK(same_bits(a.actuation, b.actuation));
  for (const FrameColumn& column : frame_columns) {
    INFO(column.name);
    visit_column(column, a, [&]<class T>(const T& x) {
      visit_column(column, b, [&]<class U>(const U& y) {
        if constexpr (std::is_same_v<T, U>) CHECK(same(x, y));
      });
    });
  }
}

}  // namespace gridshell::record
