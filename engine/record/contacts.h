// Interpenetrations of a shell with itself or with its table, computed on the shape that is shown;
// they exert no force on the shell.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/record/trajectory.h"

namespace gridshell::record {

/// What overlaps: two rods, the cylinders of two joints, a rod and the table.
enum class ContactKind { rods, joints, table };
inline constexpr int contact_kinds = 3;

struct Contact {
  ContactKind kind = ContactKind::rods;
  int first = 0, second = -1;   ///< indices into Layout::rods or Layout::joints; -1: the table
  double gap_mm = 0;            ///< gap between the surfaces; below 0: they overlap by that much
  Eigen::Vector3d at{0, 0, 0};  ///< position, mm
};

struct Contacts {
  /// All interpenetrations: those of rods, of joints, with the table; the deepest of each kind
  /// first.
  std::vector<Contact> interpenetrations;
  /// Least gaps between the surfaces of rods away from their joints and between the joints'
  /// cylinders, mm; NaN if they are above the diameter of a rod or of a joint.
  double rod_gap_mm = unknown, joint_gap_mm = unknown;

  /// The deepest interpenetration of a kind; null if there is none.
  const Contact* deepest(ContactKind kind) const;
};

/// Finds interpenetrations in shapes of one layout. Rods are tubes about their edges. Joints (and a
/// rod's end) divide them into *segments*. Two segments, or one and itself, count as one
/// interpenetration at most, where they overlap most, so that the number does not depend on the
/// mesh.
///
/// Two segments with a common joint are close there. With S the sum of their radii and a the angle
/// between them at the joint, their nearest points are reported unless both are within
///     max(D/2, min(S / sin(a/2), l/2))
/// of the joint along the rods: D is the diameter of the joint's cylinder, l the length of the
/// shorter segment. Straight rods overlap up to half of S / sin(a/2), so that only overlap by
/// bending is reported; past the middle of a segment all overlap is, as in a cell that closes.
/// Ends of two rods at a distance below S are at one support, which counts as a joint. Points of
/// one rod are compared if they are more than pi S apart along it, regardless of joints between
/// them.
///
/// Laths whose sections follow the joints' normals are rectangles. The vector between two nearest
/// points has a part along the normal (between two joints along the mean of their normals), which
/// is compared with the thickness, and a part perpendicular to it, which is compared with the width
/// in that direction; the larger gap counts.
///
/// The cylinder of a joint is centred on the rods' crossing, along t_u x t_v, with the height of
/// the layout and rounded ends. A joint of one rod, as at a corner or a support, has none. A rod
/// touches the table if its axis is more than its radius below the plane.
class ContactSearch {
 public:
  explicit ContactSearch(const Layout& layout);

  /// Interpenetrations in a shape, 3 x nodes, mm. Trees of bounding boxes exclude distant pairs;
  /// the time is about that of computing the edges' boxes.
  Contacts in(const Eigen::Matrix3Xd& nodes) const;
  /// Interpenetrations by comparison of every pair of edges: a reference for tests.
  Contacts by_all_pairs(const Eigen::Matrix3Xd& nodes) const;

 private:
  friend class ShapeContacts;
  /// The piece of a rod between two joints, or between a joint and an end of the rod.
  struct Segment {
    int rod = 0;
    int begin = 0, end = 0;  ///< first and last point, as indices into points_
    int from = -1, to = -1;  ///< joints at these two points; -1: an end of the rod
  };
  /// The node of a joint, and its neighbours on two of its rods; -1: fewer than two rods.
  struct Axis {
    int node = 0;
    std::array<int, 4> neighbours{-1, -1, -1, -1};
  };
  std::vector<int> points_;  ///< node of each point of a rod, rod after rod
  /// Like points_, with the node of its first rod for all rods of a joint.
  std::vector<int> joint_nodes_;
  std::vector<Segment> segments_;
  std::vector<std::array<int, 2>> ends_;  ///< first and last point of each rod
  std::vector<double> radius_mm_;         ///< radius of each rod; of a lath half its diagonal
  /// Half the width and half the thickness (along the normal) of each rod that is a lath; else 0.
  std::vector<std::array<double, 2>> half_mm_;
  std::vector<Axis> axes_;
  double joint_diameter_mm_ = 0, joint_height_mm_ = 0, table_mm_ = unknown;
};

}  // namespace gridshell::record
