// The region of the flat (u, v) plane that an original boundary encloses, seen along grid lines.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/choices.h"
#include "engine/core/result.h"

namespace gridshell {

/// Which of the two sets of parallel rods: a u-rod runs along u (v = const), a v-rod along v; or of
/// neither, in a network that is no square grid.
enum class Family { u, v, other };
/// "u", "v", or "rod ".
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

/// A piece of a grid line that lies inside the boundary: along the line, begin < end, mm.
struct Interval {
  double begin = 0, end = 0;
};

/// The inside of an original boundary. Grid lines are cut exactly where they meet it.
class Domain {
 public:
  virtual ~Domain() = default;
  /// Pieces of the line v = c (Family::u) or u = c (Family::v) inside the boundary, in order.
  virtual std::vector<Interval> intervals(Family family, double c) const = 0;
  /// The boundary as a closed polyline of `points` points (the last joins the first), 2 x points.
  virtual Eigen::Matrix2Xd boundary(int points) const = 0;
  /// Largest |u| or |v| reached, mm: grid lines outside it need not be computed.
  virtual double reach() const = 0;
};

/// The points at radius_at(direction) along `points` directions, the first along +u.
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

/// A joint: of a square grid the crossing of the u-rod with index j and the v-rod with index i, of
/// another network point i of its file.
struct FootprintJoint {
  int i = 0, j = 0;
  double u = 0, v = 0;  ///< mm
  double height = 0;    ///< above their plane, mm; of a network that is drawn in space
  /// How far the axis of its second rod lies above that of the first along the normal, mm; 0: they
  /// meet. Of joints of two rods alone.
  double eccentricity = 0;
  bool centred = false;  ///< a law connects its rods: each of them has an edge centred on it
};

/// A complete cell: joints (i,j), (i+1,j), (i+1,j+1), (i,j+1), all four rods between them present.
struct FootprintCell {
  int i = 0, j = 0;
  std::array<int, 4> joints{};
};

/// The constraint of a rod's end: nothing, its position, its position and direction, or its spin
/// too; or it is `joined`: it ends at a joint, of another rod or of its own other end; or `sprung`:
/// a spring pulls it to its support.
enum class RodEnd { free, pinned, tangent, clamped, joined, sprung };

inline bool holds_direction(RodEnd end) { return end == RodEnd::tangent || end == RodEnd::clamped; }
/// Whether the boundary fixes it.
inline bool is_held(RodEnd end) { return end != RodEnd::free && end != RodEnd::joined; }

/// One rod from edge point to edge point, straight in the flat or along a polyline. Positions run
/// along the rod: u on a u-rod, v on a v-rod.
struct FootprintRod {
  Family family = Family::u;
  int index = 0;                    ///< j of a u-rod, i of a v-rod, else its number
  Eigen::Vector2d origin{0, 0};     ///< where its position is 0, mm
  Eigen::Vector2d direction{1, 0};  ///< unit; of a straight rod
  /// (u, v, height, position) of one that is not, or not in the plane; empty: straight
  std::vector<Eigen::Vector4d> path{};
  Interval span;                ///< edge points
  std::vector<int> joints;      ///< in order along the rod, at least one
  std::vector<double> marks{};  ///< where they are
  int number = -1;              ///< of a network's rod in its file
  bool reversed = false;        ///< of that rod: it runs against its order in the file
  RodEnd begin = RodEnd::pinned, end = RodEnd::pinned;
  double tail_begin = 0, tail_end = 0;  ///< past the edge point to a second pin, mm; 0: none
  /// by how much the legs of a designed shell are longer than to the net's boundary, mm
  double longer_begin = 0, longer_end = 0;

  /// On the grid line v = `line` (u-rod) or u = `line`.
  static FootprintRod of_grid(Family family, int index, double line, const Interval& span);
  /// (u, v) of a position, and the unit tangent there in the plane.
  Eigen::Vector2d at(double position) const;
  Eigen::Vector2d tangent(double position) const;
  /// (u, v, height) of the unit tangent there.
  Eigen::Vector3d tangent_in_space(double position) const;
  /// Above the plane.
  double height(double position) const;
  /// (u, v, height) of a position on the path.
  Eigen::Vector3d on_path(double position) const;
  /// The grid line of a u- or v-rod.
  double line() const { return family == Family::u ? origin.y() : origin.x(); }
  bool has_tails() const { return tail_begin > 0 || tail_end > 0; }
  /// A ring: its first joint is its last one.
  bool closed() const { return joints.size() > 1 && joints.front() == joints.back(); }
};

/// A support on a spring: of a rod's end, which is `sprung`, or of one of the fixed joints.
struct SupportSpring {
  int end = -1;                       ///< begin of rod r at 2 r; -1: of a joint
  int joint = -1;                     ///< -1: of an end
  Eigen::Vector3d N_per_mm{0, 0, 0};  ///< along x, y, z; 0: it slides in that direction
};

/// All rods, joints and complete cells inside an original boundary. Lengths in mm.
struct Footprint {
  double spacing = 0;  ///< of a network that is no square grid its median segment
  Placement placement = Placement::half;
  std::vector<FootprintJoint> joints;
  std::vector<FootprintRod> rods;
  std::vector<FootprintCell> cells;      ///< none where rods are not of a square grid
  std::vector<int> fixed_joints{};       ///< those that the boundary fixes, as it does edge points
  std::vector<SupportSpring> springs{};  ///< of the supports on springs; none of the remaining ones
  std::vector<int> end_points{};  ///< of a network: the point of each end, begin of rod r at 2 r
  int lone_lines = 0;  ///< pieces of grid lines within the boundary that no other crosses

  bool is_sprung(int joint) const;  ///< whether a fixed joint is on a spring
  bool in_space() const;            ///< whether a joint or a rod leaves the plane

  /// shortest and longest leg: from an edge point to the joint next to it
  double shortest_leg() const;
  double longest_leg() const;
};

/// The rods' lines of one family that a placement puts within `reach` of the origin.
double line_of(Placement placement, int index, double spacing);

/// Fills the complete cells of a footprint whose rods and joints are of a square grid.
void find_cells(Footprint& footprint);

/// Cuts the square grid along the boundary of `domain`. Rods of both families at
/// line_of(placement, k, d) for every k whose line meets the domain and crosses another rod there.
/// Errors (bad_input): no rods at all; too many joints (above 1e6).
Result<Footprint> cut_footprint(const Domain& domain, double spacing, Placement placement);

/// The paper's circle: n rods per direction in a disk of radius R_o. Errors (bad_input), with
/// numbers: n < 2, placement that cannot give n rods (half needs n even, on_axis n odd), longest
/// leg L_d = R_o/d - (n-1)/2 <= 0, a boundary that would contain more than n rods (L_d > 1 is
/// allowed: the legs are then longer than a cell and the rods outside are left out), a rod without
/// a joint.
Result<Footprint> circular_footprint(double radius, int rods, double spacing, Placement placement);

}  // namespace gridshell
