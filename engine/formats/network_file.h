// Networks of rods in files of users.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// The largest file of a network that is read.
inline constexpr std::size_t largest_network_file = std::size_t(16) << 20;

/// Points of a file nearer to each other than this are merged.
inline constexpr double one_point_mm = 1e-3;

/// Largest angle between two lines that meet end to end and become one rod.
inline constexpr double most_turn_deg = 30;

/// Range of the stiffness of supports' springs, N/mm: far below and far above that of any rod.
inline constexpr double softest_spring = 1e-6, stiffest_spring = 1e6;

/// How a file of a network is read.
struct NetworkOptions {
  double unit_mm = 0;  ///< unit of a drawing; 0: the unit that it names, else mm
  /// Points nearer to each other than this are merged, and ends nearer to a rod are joined to it;
  /// 0: points within one_point_mm are merged, and ends are joined only to rods that they touch.
  double join_mm = 0;
  double rod_mm = 0;     ///< diameter of a rod, to notice an impossible unit; 0: not known
  bool linkage = false;  ///< each line of a drawing is one segment (NetworkBuilder::join_segments)
};

/// Reads a file in the format of its name's ending:
///   .json: an object with the lists "points_mm" [[x, y], ...], "rods", "joints", "supports", and
///     the "law" of all joints without one:
///     - A rod is a list of indices of points (from 0) or of positions [x, y], or an object
///       {"points": list, "diameter_mm": d, "begin": END, "end": END, other keys of [rod]}, END
///       being "pinned", "tangent" or "clamped".
///     - A support is {"point": index or position, "to_mm": [x, y, z]}. "to_mm" may be "free", for
///       an end that nothing fixes; without it the preset decides. "spring_N_per_mm": k, or
///       [kx, ky, kz], puts the support on a spring.
///     - A joint is a list of points that become one joint although their positions differ, or
///       {"point": index or position, "law": LAW, "eccentricity_mm": e}, or with "points": list.
///     - LAW is "free", "hinge", "rigid", or "spring" with "shear_Nmm" and "twist_Nmm".
///   .obj: vertices "v x y z" and polylines "l a b c ..."; without polylines the edges of the faces
///     "f a b c ..."
///   .ply, .off: the edges of faces, and in a .ply also its elements "edge"
///   .dxf: the visible curves of model space (dxf_file.h), only those of layer "rods" if there is
///     one; a circle that marks a point of a rod is no rod
/// In drawings (.obj and .dxf) lines that meet end to end at an angle of at most 30 degrees become
/// one rod, and rods are joined wherever they cross or touch. In JSON rods are joined at common
/// points, common positions and listed joints. Edges of meshes are joined at common vertices; those
/// in line become one rod. Points [x, y] have z = 0. A rod that ends at its first point is a ring.
/// Errors (bad_input), with `name` and the line: text that is not of the format, NaN, a point that
/// does not exist, in JSON a point named by its index that has the position of an earlier one, a
/// segment without length, an entity of a drawing that may be a rod and is not supported, lines on
/// one another, more than 100 000 points or rods, another ending.
Result<NetworkData> read_network(std::string_view bytes, const std::string& name,
                                 const NetworkOptions& options = {}, FileReport* report = nullptr);

/// Position of a point of a network, mm.
inline Eigen::Vector3d position_of(const NetworkData& network, int point) {
  const auto& at = network.points[std::size_t(point)];
  return {at[0], at[1], at[2]};
}

/// Directions in which the rods of a network must run so that all joints of two rods open together:
/// the rods of a linkage are two families, and the angle from a rod of the first family to one of
/// the second grows on the same side of the surface at all joints.
struct OpeningSense {
  std::vector<int> family;     ///< family of each rod, 0 or 1; empty: there are no two families
  std::vector<char> reversed;  ///< for each rod: whether its points must be reversed
  std::vector<int> against{};  ///< points of joints that close when the others open
};
OpeningSense opening_sense(const NetworkData& network);

/// Mean angle between the rods at all joints of two rods, as drawn, rad; 0 if there is no such
/// joint.
double mean_angle(const NetworkData& network);

/// Median distance of neighbouring joints and ends along the rods, mm.
double spacing_of(const NetworkData& network);

/// The error in a spring's stiffnesses along x, y, z; empty: none.
std::string spring_error(const std::vector<double>& k);

/// The error in a network that a preset contains itself; empty: none.
std::string network_error(const NetworkData& network);

/// Builds a network of rods from a file. Points at equal positions are merged. In all functions
/// `at` is the position in the file, for messages.
class NetworkBuilder {
 public:
  /// Points nearer to each other than `join_mm` (at least one_point_mm) are merged.
  explicit NetworkBuilder(double join_mm = 0) : near_mm_(std::max(join_mm, one_point_mm)) {}
  /// Whether points at a larger distance than one_point_mm are merged.
  bool joins_near() const { return near_mm_ > one_point_mm; }
  /// Index of the point at a position of two or three coordinates, which is added if it is new.
  /// Errors (bad_input): another number of coordinates, a coordinate that is not finite or above
  /// 1e9, too many points.
  Result<int> find_or_add_point(const std::vector<double>& xyz, const std::string& at);
  /// Adds a point with the next index. If an earlier point has its position, point() returns that
  /// one instead. Errors: those of find_or_add_point().
  Result<void> add_point(const std::vector<double>& xyz, const std::string& at);
  /// The earliest point at the position of point `number`. Errors (bad_input): there is no such
  /// point.
  Result<int> point(long number, const std::string& at) const;
  /// Adds a rod through points. Errors (bad_input): fewer than two different points, a point that
  /// follows itself, too many rods.
  Result<void> add_rod(std::vector<int> points, double diameter_mm, const std::string& at);
  /// Adds a key of [rod] that the last rod has with another value.
  void add_own(const std::string& key, double value) {
    network_.own.push_back({int(network_.rods.size()) - 1, key, value});
  }
  /// Adds a constraint of the start or the end of the last rod.
  void add_constraint(bool end, EndKind kind) {
    network_.end_constraints.push_back(
        {double(network_.rods.size()) - 1, double(end), double(kind)});
  }
  void add_support(std::vector<double> row) { network_.supports.push_back(std::move(row)); }
  /// Adds the spring of a support: stiffness along x, y, z, N/mm.
  void add_spring(int point, const std::vector<double>& k) {
    network_.springs.push_back({double(point), k[0], k[1], k[2]});
  }
  void add_free(int point) { network_.free.push_back(point); }
  /// Adds a row of NetworkData::joint_laws.
  void add_law(std::vector<double> row) { network_.joint_laws.push_back(std::move(row)); }
  /// Adds a list of points that are one joint. Errors (bad_input): a point that is in another list.
  Result<void> add_joint(std::vector<int> points, const std::string& at);
  /// Merges the points of every list of add_joint() into the first one, at their mean position, in
  /// rods, supports and free ends. If rods only end there, and it is no support, they are joined by
  /// a hinge. Errors (bad_input), at the joint: a point of no rod, two points of one rod that are
  /// not its two ends, a point whose distance from the mean exceeds a quarter of the shortest
  /// segment of rod at the joint.
  Result<void> join_listed();
  /// Joins lines that meet end to end to rods: each end continues in the line with the smallest
  /// angle, at most most_turn_deg. Returns the number of points where lines were joined. Errors
  /// (bad_input): more than 100 ends at one point.
  Result<int> join_in_line();
  /// Makes a linkage from lines that are its segments, as X-shells are stored [Panetta et al.
  /// 2019]. At a point of four segments the opposite ones continue each other, at a point of three
  /// the straightest two that make no triangle, at a point of two none. Rods run so that all joints
  /// open together, from an acute mean angle. Every joint is a hinge, ends are free, and springs at
  /// three joints prevent rigid motions. Errors (bad_input): a line of more than two points, more
  /// than four segments at a point.
  Result<void> join_segments(FileReport& report);
  /// Moves ends without a joint that are within join_mm of another rod onto that rod and joins
  /// them. Errors (bad_input): too many ends and rods.
  Result<void> join_ends(const std::string& name);
  /// Joins rods where they cross or touch: adds a common point to both. Errors (bad_input): rods
  /// that lie on one another, too many segments.
  Result<void> join_crossings(const std::string& name);
  /// Removes points of curved pieces, so that rods turn by some degrees at each remaining one, and
  /// points between lines that were joined in line. Points of two rods remain.
  void thin_out();
  /// Marks a point of a curved piece, which thin_out() may remove.
  void mark_sample(int point) { samples_.insert(point); }
  std::size_t points() const { return network_.points.size(); }
  /// The network. Errors (bad_input): no rods; those of network_error().
  Result<NetworkData> take(const std::string& name);

 private:
  using Cell = std::tuple<long, long, long>;
  int known(const std::vector<double>& xyz) const;

  /// Points that are one joint, and the position of the list in the file.
  struct Joint {
    std::vector<int> points;
    std::string at;
  };
  Result<void> check_rods(const std::vector<int>& joint_of) const;
  Result<void> check_reach(const std::vector<int>& joint_of) const;
  void rename(const std::vector<int>& joint_of);

  Result<std::vector<int>> continued_by_direction() const;
  void chain(const std::vector<int>& partner);
  void support_on_springs();

  double near_mm_;
  NetworkData network_;
  std::vector<std::string> locations_;  // position of each rod in the file
  std::set<int> samples_, seams_;       // points that thin_out() may remove
  std::vector<Joint> joints_;
  std::set<int> listed_;      // points of joints_
  std::vector<int> same_as_;  // for each point the earliest one at its position
  std::map<Cell, std::vector<int>> at_;
  std::size_t entries_ = 0;
  bool diameters_ = false;
};

// Readers of the formats; their errors are those of read_network().
Result<NetworkData> read_network_json(std::string_view bytes, const std::string& name,
                                      const NetworkOptions& options);
Result<NetworkData> read_network_obj(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report);
Result<NetworkData> read_network_mesh(std::string_view bytes, const std::string& name,
                                      const NetworkOptions& options, FileReport& report);
Result<NetworkData> read_network_dxf(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report);

/// Adds the numbers of rods, joints and supports to a report's sentence, and notes on points that
/// are near to each other and not joined.
void report_network(const NetworkData& network, const NetworkOptions& options, FileReport& report);

}  // namespace gridshell::preset
