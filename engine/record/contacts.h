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
  int first = 0, second = -1;  ///< of Layout::rods, or of Layout::joints; -1: the table
  double gap_mm = 0;           ///< between the surfaces, below 0: by how much they overlap
  Eigen::Vector3d at{0, 0, 0};
};

struct Contacts {
  std::vector<Contact> places;  ///< rods, joints, table, of each kind the deepest first
  /// Least gaps between the surfaces of rods away from their joints and between the joints'
  /// cylinders, mm; NaN where they are above a rod's and a joint's diameter.
  double rod_gap_mm = unknown, joint_gap_mm = unknown;

  /// The deepest of a kind, or nothing.
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

  /// Interpenetrations in a shape, 3 x nodes. Trees of bounding boxes leave out distant pairs; the
  /// time is about that of computing the edges' boxes.
  Contacts in(const Eigen::Matrix3Xd& nodes) const;
  /// Interpenetrations by comparison of every pair of edges, a reference for tests.
  Contacts by_all_pairs(const Eigen::Matrix3Xd& nodes) const;

 private:
  friend class ShapeContacts;
  /// A rod's piece between two joints, or a joint and its end.
  struct Segment {
    int rod = 0;
    int begin = 0, end = 0;  ///< points, both among them
    int from = -1, to = -1;  ///< joints at them; -1: an end
  };
  /// The node of a joint, and its neighbours on two of its rods; -1: fewer than two rods.
  struct Axis {
    int node = 0;
    std::array<int, 4> beside{-1, -1, -1, -1};
  };
  std::vector<int> points_;  ///< nodes, rod after rod
  std::vector<int> places_;  ///< of the points: their nodes, of joints those of their first rod
  std::vector<Segment> segments_;
  std::vector<std::array<int, 2>> ends_;  ///< of each rod, points
  std::vector<double> radius_mm_;         ///< of each rod; of a lath as far as its corners reach
  /// Half the width and half the thickness of each rod that is a lath, along the normal; else 0.
  std::vector<std::array<double, 2>> half_mm_;
  std::vector<Axis> axes_;
  double joint_diameter_mm_ = 0, joint_height_mm_ = 0, table_mm_ = unknown;
};

}  // namespace gridshell::record
