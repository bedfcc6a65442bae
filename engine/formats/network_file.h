// Networks of rods in files that a user brings.
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

/// Points of a file nearer to one another than this are one.
inline constexpr double one_point_mm = 1e-3;

/// By how much lines that meet end to end may turn to be one rod.
inline constexpr double most_turn_deg = 30;

/// Stiffnesses of supports' springs, N/mm: far below and far above that of any rod.
inline constexpr double softest_spring = 1e-6, stiffest_spring = 1e6;

/// How a file of a network is read.
struct NetworkOptions {
  double unit_mm = 0;  ///< of a drawing; 0: the one that it names, else mm
  /// Points nearer to one another are one, and an end that lies as near to a rod is joined to it;
  /// 0: as one_point_mm says, ends joined only where they touch.
  double join_mm = 0;
  double rod_mm = 0;  ///< diameter of a rod, by which an impossible unit is noticed; 0: not known
  bool linkage = false;  ///< each line of a drawing is one segment (NetworkBuilder::join_segments)
};

/// Reads a file as its name's ending says:
///   .json  {"points_mm": [[x, y], ...], "rods": [[0, 1, ...], ...], "supports": [...]}; a rod is a
/// list of numbers of points (from 0) or of positions [x, y], or {"points": list,
///          "diameter_mm": d, "begin" and "end": "pinned", "tangent" or "clamped"} with any more
/// keys of [rod]; a support {"point": number or position,
/// "to_mm": [x, y, z]}, where "to_mm" may be "free" (of an end that nothing fixes) or left
///          out (as the preset says), and "spring_N_per_mm": k or [kx, ky, kz] puts it on a spring;
///          "joints": [[a, b, ...], ...] lists points that are one joint though they lie apart; or
/// {"point": number or position, or "points": list, "law": "free", "hinge", "rigid" or
///          "spring" of "shear_Nmm" and "twist_Nmm", and "eccentricity_mm"};
///          "law": one of these words, or {"law", "shear_Nmm", "twist_Nmm"}, of all other joints
///   .obj   "v x y z" and polylines "l a b c ..."; without these the edges of its faces
///          "f a b c ..."
///   .ply, .off   the edges of faces, and of a .ply those of its element "edge"
///   .dxf   the curves of model space that are shown (dxf_file.h), where there is a layer "rods" of
///          that one alone; a circle that marks a point of a rod is none
/// In drawings, .obj and .dxf, lines that meet end to end and turn by at most 30 degrees are
/// one rod, and rods are joined wherever they cross or touch; in JSON where they name the same
/// point or position, or points of one listed joint; edges of meshes where they share a vertex,
/// those in line being one rod as the lines of drawings. Points [x, y] lie at z = 0, others [x, y,
/// z] in space; a rod that ends where it begins is a ring. Errors (bad_input), with `name` and the
/// line: not of the format, NaN, a point that is not there, in JSON one named by its number that
/// lies where an earlier one does, a stretch of no length, an entity of a drawing that may be a rod
/// and is not understood, lines that lie on one another, more than 100 000 points or rods, another
/// ending.
Result<NetworkData> read_network(std::string_view bytes, const std::string& name,
                                 const NetworkOptions& options = {}, FileReport* report = nullptr);

/// Where a point of a network is, mm.
inline Eigen::Vector3d place_of(const NetworkData& network, int point) {
  const auto& at = network.points[std::size_t(point)];
  return {at[0], at[1], at[2]};
}

/// How the rods of a network turn where two of them cross, as joints open: those of a linkage are
/// two families, and from a rod of the first to one of the second the angle grows on one side.
struct OpeningSense {
  std::vector<int> family;     ///< of every rod, 0 or 1; empty: rods are no two families
  std::vector<char> reversed;  ///< of every rod: its points are to be reversed
  std::vector<int> against{};  ///< points of joints whose angle grows on the other side
};
OpeningSense opening_sense(const NetworkData& network);

/// The mean angle between the rods of all joints of two rods, rad, as drawn; 0 without one.
double mean_angle(const NetworkData& network);

/// How often rods go through a point, and how often they end there.
struct PointUse {
  int passes = 0, ends = 0;
};
std::vector<PointUse> uses_of(const NetworkData& network);

/// The median distance of neighbouring joints and ends along the rods, mm.
double spacing_of(const NetworkData& network);

/// What is wrong with a spring's stiffnesses along x, y, z; empty: nothing.
std::string spring_error(const std::vector<double>& k);

/// What is wrong with a network that a preset contains itself; empty: nothing.
std::string network_error(const NetworkData& network);

// A network of rods while it is read: points at one position become one.

class NetworkBuilder {
 public:
  /// Points nearer to one another than `join_mm`, at least than one_point_mm, are one.
  explicit NetworkBuilder(double join_mm = 0) : near_mm_(std::max(join_mm, one_point_mm)) {}
  /// Whether points further apart than one_point_mm are one.
  bool joins_near() const { return near_mm_ > one_point_mm; }
  /// Number of the point at a position of two or three coordinates: of one that is there already,
  /// or new. `at` is its position in the file. Errors (bad_input): another number of coordinates,
  /// one that is not finite or above 1e9, too many points.
  Result<int> place(const std::vector<double>& xyz, const std::string& at);
  /// A new point; it represents an earlier one at its position.
  Result<void> add_point(const std::vector<double>& xyz, const std::string& at);
  /// The earliest point at the position of point `number`. Errors (bad_input): there is no such
  /// point.
  Result<int> point(long number, const std::string& at) const;
  /// A rod through points. Errors (bad_input): fewer than two points apart, a point that follows
  /// itself, too many rods.
  Result<void> add_rod(std::vector<int> points, double diameter_mm, const std::string& at);
  /// A key of [rod] that the last rod has of its own.
  void add_own(const std::string& key, double value) {
    network_.own.push_back({int(network_.rods.size()) - 1, key, value});
  }
  /// The constraint of the start or the end of the last rod.
  void add_hold(bool end, EndKind kind) {
    network_.holds.push_back({double(network_.rods.size()) - 1, double(end), double(kind)});
  }
  void add_support(std::vector<double> row) { network_.supports.push_back(std::move(row)); }
  /// The spring of a support, along x, y, z, N/mm.
  void add_spring(int point, const std::vector<double>& k) {
    network_.springs.push_back({double(point), k[0], k[1], k[2]});
  }
  void add_free(int point) { network_.free.push_back(point); }
  /// A row of NetworkData::joint_laws.
  void add_law(std::vector<double> row) { network_.joint_laws.push_back(std::move(row)); }
  /// Points that are to be one joint, as `at` lists them. Errors (bad_input): one that another
  /// joint has too.
  Result<void> add_joint(std::vector<int> points, const std::string& at);
  /// Makes the points of every joint that was added one, the first of them, at their mean position:
  /// in rods, supports and what is free. Where rods only end there, and it is no support, they are
  /// joined by a hinge. Errors (bad_input), at the joint: a point of no rod, two of one rod that
  /// are not its two ends, a point further off the mean than a quarter of the shortest stretch of
  /// rod at the joint.
  Result<void> join_listed();
  /// Lines that meet end to end become one rod, each end with the one that it turns least to, by
  /// most_turn_deg at most. Returns how many meetings that were. Errors (bad_input): more than 100
  /// ends at one point.
  Result<int> join_in_line();
  /// Makes a linkage of lines that are its segments, as X-shells are stored [Panetta et al. 2019]:
  /// at a point of four the opposite ones continue one another, at one of three the straightest two
  /// that make no triangle, at one of two none. Rods run so that all joints open together, from an
  /// acute mean angle; every joint is a hinge, ends are free, and springs at three joints prevent
  /// rigid motions. Errors (bad_input): a line of more than two points, more than
  /// four segments at a point.
  Result<void> join_segments(FileReport& report);
  /// Ends that nothing is joined to and that lie within the builder's join_mm of another rod are
  /// moved onto it and joined. Errors (bad_input): too many to be looked at.
  Result<void> join_ends(const std::string& name);
  /// Joins rods where they cross or touch, as drawings have them: a point more on each. Errors
  /// (bad_input): rods that lie on one another, too many to be looked at.
  Result<void> join_crossings(const std::string& name);
  /// Leaves so many points of curved pieces that rods turn by some degrees at each; points
  /// where lines met that were one are left out. Points that another rod has remain.
  void thin_out();
  /// A point of a curved piece, which may be left out.
  void mark_sample(int point) { samples_.insert(point); }
  std::size_t points() const { return network_.points.size(); }
  /// Errors (bad_input): no rods; what network_error() says.
  Result<NetworkData> take(const std::string& name);

 private:
  using Cell = std::tuple<long, long, long>;
  int known(const std::vector<double>& xyz) const;

  /// Points that are to be one, and where the file says so.
  struct Joint {
    std::vector<int> points;
    std::string at;
  };
  Result<void> check_rods(const std::vector<int>& joint_of) const;
  Result<void> check_reach(const std::vector<int>& joint_of) const;
  void rename(const std::vector<int>& joint_of);

  std::vector<int> rods_at_points() const;
  Result<std::vector<int>> continued_by_direction() const;
  void chain(const std::vector<int>& partner);
  void support_on_springs();

  double near_mm_;
  NetworkData network_;
  std::vector<std::string> places_;  // of each rod, where the file has it
  std::set<int> samples_, seams_;    // points that may be left out
  std::vector<Joint> joints_;
  std::set<int> listed_;      // points of joints_
  std::vector<int> same_as_;  // per point: the earliest one at its position
  std::map<Cell, std::vector<int>> at_;
  std::size_t entries_ = 0;
  bool diameters_ = false;
};

// the formats; errors as read_network()
Result<NetworkData> read_network_json(std::string_view bytes, const std::string& name,
                                      const NetworkOptions& options);
Result<NetworkData> read_network_obj(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report);
Result<NetworkData> read_network_mesh(std::string_view bytes, const std::string& name,
                                      const NetworkOptions& options, FileReport& report);
Result<NetworkData> read_network_dxf(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report);

/// Adds to a report's sentence what network came of a file, and notes on what is not joined.
void report_network(const NetworkData& network, const NetworkOptions& options, FileReport& report);

}  // namespace gridshell::preset
