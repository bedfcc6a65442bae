// What a user does to a formed shell: a push, steps, additional loads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/enum_words.h"

namespace gridshell::preset {

/// Points of a curve, each of as many coordinates as its key says, mm; a coordinate that is a word
/// is the number of that word among those of its key.
using Points = std::vector<std::vector<double>>;

/// The kinds of [[step]]: what a user can do to a shell.
enum class StepKind { move, push, hold, release, load, rest, jitter, tighten, brace, open };

enum class IndentationPlace { pole, highest };
enum class Direction { inward, outward };
enum class Lateral { free, held };
struct Indentation {
  IndentationPlace at = IndentationPlace::pole;
  double latitude_deg = 90, longitude_deg = 0;
  std::vector<int> joint;  ///< (i, j), or empty
  Direction direction = Direction::inward;
  double depth = 0;     ///< of rho; 0: none
  double depth_mm = 0;  ///< 0: none
  Lateral lateral = Lateral::free;
  bool unload = false;

  bool requested() const { return depth > 0 || depth_mm > 0; }
};

/// What a release takes out or lets go.
enum class Released { joints, bolts, braces };
enum class Diagonals { both, first, second };
enum class BraceKind { cable, strut };

/// One step of a hand, in a list that is done in order; numbers that its kind does not use count
/// for nothing.
/// What opens joints: a spring at each, or one torque, equal at all, that prescribes their mean.
enum class JointDrive { each, mean };
struct Step {
  StepKind kind = StepKind::move;
  double progress = 1;        ///< of the boundary; above 1 it moves further than in the actuation
  double radius_mm = 0;       ///< of a circle's boundary; 0: `progress` says it
  Points edge_points;         ///< (k, x, y, z): by how much edge points lie off the motion
  std::vector<int> joint;     ///< (i, j)
  std::vector<double> to_mm;  ///< (x, y, z) of the joint; empty: `depth_mm` says it
  double depth_mm = 0;        ///< inward, against the shell's normal at the joint
  std::vector<double> along;  ///< direction of a joint's constraint; empty: direction of the push
  Lateral lateral = Lateral::free;
  double factor = 1;  ///< of the dead loads
  BranchSide side = BranchSide::lower;
  int seed = 1;
  double force_N = 0.4;      ///< of a jitter
  std::string load_case;     ///< whose factor it is; empty: that of the dead loads
  double stiffness_Nmm = 0;  ///< of the bolts, per rad; 0: rigid
  Points cells;              ///< (i, j) of those that are braced; empty: all
  Diagonals diagonals = Diagonals::both;
  BraceKind brace = BraceKind::cable;
  double EA_N = 0;
  Released what = Released::joints;
  double angle_deg = 0;  ///< that joints are opened to on average
  Points angles;         ///< (i, j, degrees) of those that are opened; empty: all
  JointDrive drive = JointDrive::each;
};

/// Where a load on the edge points: downwards; against the shell's normal there; into the shell, in
/// its surface and across the edge; in plan across the edge as it turns.
enum class EdgeDirection { down, normal, inward, pressure };
struct Loads {
  double gravity_m_s2 = 0;    ///< downwards
  double field_N_per_mm = 0;  ///< of rod, downwards
  Points points;              ///< (i, j, F_x, F_y, F_z), N
  // what cases have of it acts on the formed shell
  double snow_N_m2 = 0;      ///< of plan, downwards
  double wind_N_m2 = 0;      ///< its pressure where it meets the shell at right angles
  double pressure_N_m2 = 0;  ///< on all faces, turning with them
  double edge_N_m = 0;       ///< on the shell's edge
  EdgeDirection edge_direction = EdgeDirection::down;
  double imperfection = 0.002;  ///< of the length scale
  double wind_deg = 0;          ///< where it blows to, from +x towards +y

  bool any() const { return gravity_m_s2 != 0 || field_N_per_mm != 0 || !points.empty(); }
};

/// Which half of the shell snow lies on, as seen from the middle.
enum class SnowSide { all, x, minus_x, y, minus_y };
constexpr auto words(SnowSide) {
  return names_except<SnowSide>({{SnowSide::x, "+x"},
                                 {SnowSide::minus_x, "-x"},
                                 {SnowSide::y, "+y"},
                                 {SnowSide::minus_y, "-y"}});
}
/// Loads that are applied together to the formed shell, in addition to those present during
/// forming.
struct LoadCase {
  std::string name;
  double dead = 0, snow = 0, wind = 0, pressure = 0, edge = 0;  ///< factors
  SnowSide snow_side = SnowSide::all;
  std::optional<double> wind_deg = {};  ///< where its wind blows to; none: as [loads] has it
  Points points;                        ///< (i, j, F_x, F_y, F_z), N
};

}  // namespace gridshell::preset
