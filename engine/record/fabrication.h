// Fabrication plan of a gridshell: rods with their marks, the flat grid, and the pins. Millimetres.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/drawing.h"

namespace gridshell::exports {

/// A leg shorter than this leaves no room between a joint and the boundary: a joint of the paper is
/// a cylinder of 3 mm [Baek 2018, 'Materials'].
inline constexpr double shortest_leg_mm = 3;

/// Section of a rod: a circle or, where it has a width, a rectangle.
struct CutSection {
  double diameter_mm = 0, width_mm = 0, thickness_mm = 0;
  double wall_mm = 0;  ///< of a tube; 0: solid

  bool lath() const { return width_mm > 0; }
  /// Diameter of the hole that it needs; that of a rectangle is its diagonal.
  double hole_mm() const { return lath() ? std::hypot(width_mm, thickness_mm) : diameter_mm; }
  /// "0.254 mm diameter", "60 x 30 mm", "50 mm diameter, 3 mm wall".
  std::string text() const;
  bool operator==(const CutSection&) const = default;
};

/// One rod as it is cut. Positions along it count from its start; tail and leg are included.
struct CutRod {
  std::string name;  ///< "u-3": its family and index
  CutSection section{};
  double length_mm = 0;
  std::vector<double> joint_marks_mm;  ///< positions of its joints
  std::vector<double> pin_marks_mm;    ///< positions of its edge points that are not its ends
  Eigen::Vector2d begin, end;          ///< ends of the rod with its tails in the flat grid
  /// Points between them, if the rod is not straight in the flat.
  std::vector<Eigen::Vector2d> corners{};
  /// lengths from the edge points to the joints next to them; NaN: the rod ends at a joint
  double leg_begin_mm = 0, leg_end_mm = 0;
  std::vector<double> splices_mm{};           ///< positions where pieces of stock length meet
  bool free_begin = false, free_end = false;  ///< whether the end is not pinned

  /// Whether a leg leaves no room for a joint.
  bool hard_to_build() const {
    return leg_begin_mm < shortest_leg_mm || leg_end_mm < shortest_leg_mm;
  }
};

/// Name of the pin at an end of a rod: "u-3 begin", "u-3 end".
inline std::string pin_name(const std::string& rod, bool at_end) {
  return rod + (at_end ? " end" : " begin");
}

/// A hole for an end of a rod in the actuated shell.
struct Pin {
  std::string name;     ///< pin_name(); in the second ring with ", far" after it
  Eigen::Vector3d at;   ///< position, mm
  bool in_ring = true;  ///< whether it is on the actuated boundary, not in the second ring
  double hole_mm = 0;   ///< CutSection::hole_mm() of its rod
};

/// The complete plan.
struct FabricationPlan {
  std::string title;
  double spacing_mm = 0;
  /// What the builder does after the ends are pinned, as sentences.
  std::vector<std::string> hand = {};
  std::vector<CutRod> rods;
  std::vector<Eigen::Vector2d> joints;  ///< positions in the flat grid
  Eigen::Matrix2Xd original_boundary;   ///< closed polyline in the flat
  Eigen::Matrix3Xd actuated_boundary;   ///< closed polyline
  /// Radii of circular boundaries; NaN for other boundaries.
  double original_radius_mm = std::numeric_limits<double>::quiet_NaN();
  double actuated_radius_mm = std::numeric_limits<double>::quiet_NaN();
  std::vector<Pin> pins;
  bool in_space = false;  ///< true: there is no flat grid; rods and joints are seen from above

  Eigen::Vector2d middle() const;
  /// Position of a rod's label in the flat grid, `away` outside one of its ends: the start for rods
  /// left of the middle, seen along the rod, the end for the others, so that the labels of the two
  /// families are in separate quarters.
  Eigen::Vector2d label_position(const CutRod& rod, double away) const;
  double total_length_mm() const;
  /// The rods' sections: "laths of 60 x 30 mm", "rods: 12 of 0.3 mm diameter, 12 of 0.9 mm
  /// diameter".
  std::string section_text() const;
  /// Heights of the lowest and the highest pin of the ring; without pins (+infinity, -infinity).
  std::pair<double, double> heights_of_pins() const;
  /// Whether one flat plate has all pins of the ring.
  bool has_plate() const;
};

/// Rounds lengths and marks to multiples of a step (0: no rounding). Marks are at rounded distances
/// from the start of a rod, and legs are differences of marks, so that pieces add up to their rod.
FabricationPlan rounded(FabricationPlan plan, double step_mm);

/// Splices rods that are longer than `stock_mm` (0: none). Pieces are as long as possible and meet
/// in the middle between two joints. Errors (bad_input): joints too far from each other for the
/// stock.
Result<FabricationPlan> spliced(FabricationPlan plan, double stock_mm);

// Files for the workshop: the footprint and the plate as drawings, the cut list and the pins as
// tables.

/// Drawing of the flat footprint; u-rods start at the left, v-rods at the bottom. Layers: `rods`,
/// `joints` (a cross each), `boundary`, `labels`, and with a second ring `tails` (a tick across
/// each rod at its edge points).
Drawing footprint_drawing(const FabricationPlan& work);

/// Drawing of the plate with the pins: the actuated boundary and a hole for its rod at
/// each pin of the ring. Layers: `boundary`, `holes`, `labels`. Errors (bad_input): there is no
/// pin, or the pins are not in one horizontal plane.
Result<Drawing> plate_drawing(const FabricationPlan& work);

/// The cut list, one row per rod, with the columns
/// `rod,length_mm,joint_marks_mm,pin_marks_mm,leg_begin_mm,leg_end_mm,splices_mm,note,section`;
/// marks are measured from the rod's start and separated by blanks.
std::string cut_list_csv(const FabricationPlan& work);

/// All pins, also those of the second ring, with the columns `pin,ring,x_mm,y_mm,z_mm`.
std::string pins_csv(const FabricationPlan& work);

}  // namespace gridshell::exports
