// Whether two runs are the same bit for bit.
#pragma once

#include <catch2/catch.hpp>

#include "engine/record/journal.h"
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
  CHECK((a.joints == b.joints));
  CHECK((a.cells == b.cells));
  CHECK((a.seam_rods == b.seam_rods));
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
}

/// By all that a journal keeps of them.
inline void check_same_frame(const Frame& a, const Frame& b) {
  CHECK(packed_frame(a) == packed_frame(b));
}

}  // namespace gridshell::record
