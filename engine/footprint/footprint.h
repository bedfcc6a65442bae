// Footprint: the flat grid of rods, joints and cells inside an original boundary; and Domain, the
// region of the (u, v) plane that the boundary encloses.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/choices.h"
#include "engine/core/result.h"

namespace gridshell {

/// Family of a rod: a u-rod runs along u (v = const), a v-rod along v; `other` for all rods of a
/// network that is no square grid.
enum class Family { u, v, other };
/// Name of a family in the names of rods, before the index: "u", "v", or "rod ".
inline const char* name_of(Family family) {
  switch (family) {
    case Family::u:
      return "u";
    case Family::v:
      return "v";
    case Family::other:
      break;
  }
  return "rod ";
}

/// A piece of a line: positions along it, begin < end, mm.
struct Interval {
  double begin = 0, end = 0;
};

/// The region inside an original boundary.
class Domain {
 public:
  virtual ~Domain() = default;
  /// Pieces of the line v = c (Family::u) or u = c (Family::v) inside the boundary, in order; their
  /// ends are on the boundary to round-off.
  virtual std::vector<Interval> intervals(Family family, double c) const = 0;
  /// The boundary as a closed polyline of `points` points (the last joins the first), 2 x points.
  virtual Eigen::Matrix2Xd boundary(int points) const = 0;
  /// A bound of |u| and |v| in the region, mm: grid lines outside it do not meet the region.
  virtual double reach() const = 0;
};

/// A ring of `points` points at even polar angles from +u, each at the distance
/// radius_at(direction) from the origin. 2 x points, mm.
template <class Radius>
Eigen::Matrix2Xd ring_about_origin(int points, Radius radius_at) {
  Eigen::Matrix2Xd ring(2, points);
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * M_PI * k / points;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    ring.col(k) = radius_at(direction) * direction;
  }
  return ring;
}

/// A disk of radius R_o about the origin.
class Disk final : public Domain {
 public:
  explicit Disk(double radius_mm) : radius_(radius_mm) {}
  std::vector<Interval> intervals(Family, double c) const override;
  Eigen::Matrix2Xd boundary(int points) const override;
  double reach() const override { return radius_; }

 private:
  double radius_;
};

// The footprint of a gridshell: a square grid of straight rods cut along an original boundary
// [Baek 2018, 'Anatomy and Actuation'], or any other network of rods, in the plane or drawn in
// space (network.h).

/// A joint: in a square grid the crossing of the u-rod with index j and the v-rod with index i; in
/// another network point i of its file, with j = 0.
struct FootprintJoint {
  int i = 0, j = 0;
  double u = 0, v = 0;  ///< mm
  double height = 0;    ///< height above the plane, mm; 0 unless a network is drawn in space
  /// Distance of the second rod's axis above the first's along the normal, mm; 0: the axes meet.
  /// Only joints of two rods have it.
  double eccentricity = 0;
  bool centred = false;  ///< whether a law connects its rods: each has an edge centred on the joint
};

/// A complete cell: joints (i,j), (i+1,j), (i+1,j+1), (i,j+1), all four rods between them present.
struct FootprintCell {
  int i = 0, j = 0;
  std::array<int, 4> joints{};
};

/// The constraint of a rod's end: `free`; position prescribed (`pinned`); direction, too
/// (`tangent`); twist angle, too (`clamped`). `joined`: the rod ends at a joint, of another rod or
/// of its own other end. `sprung`: a spring pulls the end to its support.
enum class RodEnd { free, pinned, tangent, clamped, joined, sprung };

/// Whether the direction of the end is prescribed.
inline bool fixes_direction(RodEnd end) { return end == RodEnd::tangent || end == RodEnd::clamped; }
/// Whether the boundary fixes the end, rigidly or by a spring.
inline bool is_fixed(RodEnd end) { return end != RodEnd::free && end != RodEnd::joined; }

/// One rod from edge point to edge point, straight in the flat or along a polyline. Positions along
/// it, mm, are u on a u-rod, v on a v-rod, and else the arc length from its first point.
struct FootprintRod {
  Family family = Family::u;
  int index = 0;                    ///< j of a u-rod, i of a v-rod, else its number
  Eigen::Vector2d origin{0, 0};     ///< (u, v) at position 0, mm
  Eigen::Vector2d direction{1, 0};  ///< unit vector along a straight rod
  /// Corners (u, v, height, position) of a rod that is not straight or not in the plane; empty:
  /// straight.
  std::vector<Eigen::Vector4d> path{};
  Interval span;                ///< positions of its edge points
  std::vector<int> joints;      ///< joints in order along the rod, at least one
  std::vector<double> marks{};  ///< positions of the joints
  int number = -1;              ///< number of the rod in a network's file; -1: no network
  bool reversed = false;        ///< whether it runs against the order of its points in the file
  RodEnd begin = RodEnd::pinned, end = RodEnd::pinned;
  /// Lengths from the edge points to second pins, mm; 0: none.
  double tail_begin = 0, tail_end = 0;
  /// Lengths by which the legs of a designed shell exceed those to the net's boundary, mm.
  double longer_begin = 0, longer_end = 0;

  /// A rod on the grid line v = `line` (u-rod) or u = `line` (v-rod).
  static FootprintRod of_grid(Family family, int index, double line, const Interval& span);
  /// (u, v) at a position.
  Eigen::Vector2d at(double position) const;
  /// Unit tangent in the plane at a position.
  Eigen::Vector2d tangent(double position) const;
  /// Unit tangent (u, v, height) at a position.
  Eigen::Vector3d tangent_in_space(double position) const;
  /// Height above the plane at a position, mm.
  double height(double position) const;
  /// (u, v, height) at a position of a rod with a path.
  Eigen::Vector3d on_path(double position) const;
  /// v of a u-rod, u of a v-rod.
  double line() const { return family == Family::u ? origin.y() : origin.x(); }
  bool has_tails() const { return tail_begin > 0 || tail_end > 0; }
  /// Whether the rod is a ring: its first joint is its last one.
  bool closed() const { return joints.size() > 1 && joints.front() == joints.back(); }
};

/// A support on a spring, for a rod's end that is `sprung` or for one of the fixed joints.
struct SupportSpring {
  int end = -1;                       ///< rod r starts at 2 r and ends at 2 r + 1; -1: a joint
  int joint = -1;                     ///< index of the joint; -1: an end
  Eigen::Vector3d N_per_mm{0, 0, 0};  ///< stiffness along x, y, z; 0: it slides in that direction
};

/// All rods, joints and complete cells inside an original boundary. Lengths in mm.
struct Footprint {
  double spacing = 0;  ///< d of a square grid; of another network the median length of its segments
  Placement placement = Placement::half;
  std::vector<FootprintJoint> joints;
  std::vector<FootprintRod> rods;
  std::vector<FootprintCell> cells;  ///< complete cells; empty if this is no square grid
  std::vector<int> fixed_joints{};   ///< joints that the boundary fixes, as it fixes edge points
  std::vector<SupportSpring> springs{};  ///< springs of those supports that are not rigid
  /// The network's point at each end, rod r starts at 2 r; empty without a network.
  std::vector<int> end_points{};
  /// Number of pieces of grid lines left out, since no other line crosses them.
  int lone_lines = 0;

  bool is_sprung(int joint) const;  ///< whether a fixed joint is on a spring
  bool in_space() const;            ///< whether a joint or a rod is outside the plane

  /// Shortest and longest leg, from an edge point to the joint next to it, mm.
  double shortest_leg() const;
  double longest_leg() const;
};

/// Position of the grid line with this index, mm: (index + 1/2) d for Placement::half, else index
/// d.
double line_of(Placement placement, int index, double spacing);

/// Fills the complete cells of a footprint whose rods and joints are of a square grid.
void find_cells(Footprint& footprint);

/// Cuts the square grid along the boundary of `domain`: rods of both families at line_of(placement,
/// k, d), for every k whose line meets the domain and crosses another rod in it. Errors
/// (bad_input): no rods; more than 1e6 joints.
Result<Footprint> cut_footprint(const Domain& domain, double spacing, Placement placement);

/// The paper's circle: n rods per direction in a disk of radius R_o. Errors (bad_input), with
/// numbers: n < 2, placement that cannot give n rods (half needs n even, on_axis n odd), longest
/// leg L_d = R_o/d - (n-1)/2 <= 0, a boundary that would contain more than n rods (L_d > 1 is
/// allowed: the legs are then longer than a cell and the rods outside are left out), a rod without
/// a joint.
Result<Footprint> circular_footprint(double radius, int rods, double spacing, Placement placement);

}  // namespace gridshell
