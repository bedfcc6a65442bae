// Fabrication plan of a gridshell: rods with their marks, the flat grid, and the pins. Millimetres.
#pragma once

#include <Eigen/Core>
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

/// One rod as it is cut. Positions along it count from its start; tail and leg are included.
struct CutRod {
  std::string name;  ///< "u-3": its family and index
  double length_mm = 0;
  std::vector<double> joint_marks_mm;      ///< where it is tied to others
  std::vector<double> pin_marks_mm;        ///< its edge points, where they are not its ends
  Eigen::Vector2d begin, end;              ///< of all of it in the flat
  std::vector<Eigen::Vector2d> corners{};  ///< between them, of one that is not straight there
  /// from the edge points to the joints next to them; NaN: it ends at a joint
  double leg_begin_mm = 0, leg_end_mm = 0;
  std::vector<double> splices_mm{};           ///< where pieces of stock length meet
  bool free_begin = false, free_end = false;  ///< not pinned

  bool hard_to_build() const {
    return leg_begin_mm < shortest_leg_mm || leg_end_mm < shortest_leg_mm;
  }
};

/// "u-3 begin", "u-3 end".
inline std::string pin_name(const std::string& rod, bool at_end) {
  return rod + (at_end ? " end" : " begin");
}

/// A hole for an end of a rod in the actuated shell.
struct Pin {
  std::string name;  ///< pin_name(), ", far" after it of a second ring
  Eigen::Vector3d at;
  bool in_ring = true;  ///< of the actuated boundary; a far pin of the second ring is not
};

/// All of it.
struct FabricationPlan {
  std::string title;
  double spacing_mm = 0, rod_diameter_mm = 0;
  double width_mm = 0, thickness_mm = 0;  ///< of laths; 0: the rods are round
  /// What the builder does after the ends are pinned, as sentences.
  std::vector<std::string> hand = {};
  std::vector<CutRod> rods;
  std::vector<Eigen::Vector2d> joints;
  Eigen::Matrix2Xd original_boundary;  ///< closed polyline in the flat
  Eigen::Matrix3Xd actuated_boundary;  ///< closed polyline
  double original_radius_mm = std::numeric_limits<double>::quiet_NaN();  ///< of circles
  double actuated_radius_mm = std::numeric_limits<double>::quiet_NaN();
  std::vector<Pin> pins;
  bool in_space = false;  ///< it has no flat footprint: rods and joints are seen from above

  Eigen::Vector2d middle() const;
  /// Position of a rod's label in the flat grid, `away` outside one of its ends: the start for rods
  /// left of the middle, seen along the rod, the end for the others, so that the labels of the two
  /// families are in separate quarters.
  Eigen::Vector2d label_position(const CutRod& rod, double away) const;
  double total_length_mm() const;
  /// "60 x 30 mm laths", "rods of 0.254 mm diameter".
  std::string section_text() const;
  /// Lowest and highest pin of the ring; without one infinite, the first above the second.
  std::pair<double, double> heights_of_pins() const;
  /// Whether one flat plate has all pins of the ring.
  bool has_plate() const;
};

/// Lengths and marks as multiples of a step (0: as they are): marks lie at rounded distances from a
/// rod's begin, and legs are what is left between them, so that pieces add up to their rod.
FabricationPlan rounded(FabricationPlan plan, double step_mm);

/// Splices rods that are longer than `stock_mm` (0: none are): pieces as long as the stock gives,
/// which meet in the middle between two joints. Errors (bad_input): joints further apart than it.
Result<FabricationPlan> spliced(FabricationPlan plan, double stock_mm);

// Files for the workshop: the footprint and the plate as drawings, the cut list and the pins as
// tables.

/// The flat footprint; u-rods begin at the left, v-rods below. Layers: `rods`, `joints` (a cross
/// each), `boundary`, `labels`, and where there is a second ring `tails` (a tick across a rod at
/// its edge point).
Drawing footprint_drawing(const FabricationPlan& work);

/// The plate of the pins: the actuated boundary and a hole of the rods' diameter for each pin of
/// the ring. Layers: `boundary`, `holes`, `labels`. Errors (bad_input): the pins are not in one
/// horizontal plane.
Result<Drawing> plate_drawing(const FabricationPlan& work);

/// Columns `rod,length_mm,joint_marks_mm,pin_marks_mm,leg_begin_mm,leg_end_mm,splices_mm,note`, one
/// row per rod; marks are measured from the rod's start and separated by blanks.
std::string cut_list_csv(const FabricationPlan& work);

/// `pin,ring,x_mm,y_mm,z_mm`, those of the second ring too.
std::string pins_csv(const FabricationPlan& work);

}  // namespace gridshell::exports
