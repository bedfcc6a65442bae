// Where a shell touches itself or the table that it stands on: found on the shape that is shown,
// after the fact; nothing of it acts on the shell.
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

/// Looks for contacts in shapes of one layout. Rods are tubes about their edges. Between joints
/// (and a rod's end) they are cut into *segments*; two segments, or one and itself, make one place
/// at most, where they overlap most, so that the number of places does not depend on the mesh.
///
/// Two segments that meet at a joint are near there. With S the sum of their radii and a the angle
/// between them at the joint, their nearest points are told unless both lie within
///     max(D/2, min(S / sin(a/2), l/2))
/// of the joint along the rods: D the diameter of the joint's cylinder, l the length of the shorter
/// segment. Straight rods overlap up to half of S / sin(a/2), so that it is their bending that is
/// told; beyond the middle of a segment all is, so that a closing cell is.
/// Ends of two rods that are nearer than S are held at one place, which counts as a joint. Points
/// of one rod are told that are more than pi S apart along it, whatever joints lie between them.
///
/// Laths whose sections keep to the joints' normals are rectangles: of the way between two nearest
/// points the part along the normal (between two joints along the mean of theirs) is held against
/// their thickness, the part across it against their width as it lies across; the larger gap
/// counts.
///
/// The cylinder of a joint stands on the rods' crossing, along t_u x t_v, as high as the layout
/// says, with rounded ends; where one rod only has a corner or a support there is none. A rod
/// touches the table where its middle is more than its radius below the plane.
class ContactSearch {
 public:
  explicit ContactSearch(const Layout& layout);

  /// In a shape, 3 x nodes. Time: about that of the edges' boxes, whatever is far apart being left
  /// out by trees of them.
  Contacts in(const Eigen::Matrix3Xd& nodes) const;
  /// The same by looking at every pair of edges: to test against.
  Contacts by_all_pairs(const Eigen::Matrix3Xd& nodes) const;

 private:
  friend class ShapeContacts;
  /// A rod's piece between two joints, or a joint and its end.
  struct Segment {
    int rod = 0;
    int begin = 0, end = 0;  ///< points, both among them
    int from = -1, to = -1;  ///< joints at them; -1: an end
  };
  /// The node of a joint, and nodes beside it on two of its rods; -1: fewer than two rods.
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
