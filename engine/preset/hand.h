// What a user does to a formed shell: a push, steps, additional loads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/enum_words.h"

namespace gridshell::preset {

/// A table of numbers: one row per point, each with the coordinates that its key defines, mm. A
/// coordinate that is a name ("u", "v") is stored as the index of that name.
using Points = std::vector<std::vector<double>>;

/// The kinds of [[step]]: what a user can do to a shell.
enum class StepKind { move, push, hold, release, load, rest, jitter, tighten, brace, open };

enum class IndentationPosition { pole, highest };
enum class Direction { inward, outward };
enum class Lateral { free, held };
/// A push at one joint of the actuated shell.
struct Indentation {
  IndentationPosition at = IndentationPosition::pole;
  double latitude_deg = 90, longitude_deg = 0;  ///< joint nearest to them; 90: `at` is used
  std::vector<int> joint;  ///< indices (i, j) of the joint; empty: the joint is given otherwise
  Direction direction = Direction::inward;
  double depth = 0;     ///< depth of the push over rho of a net or R_o of a circle; 0: none
  double depth_mm = 0;  ///< depth of the push, instead of `depth`; 0: none
  Lateral lateral = Lateral::free;
  bool unload = false;  ///< whether the push is removed again

  /// Whether a push is requested.
  bool requested() const { return depth > 0 || depth_mm > 0; }
};

/// What a release removes: constraints of joints, all bolts or all braces.
enum class Released { joints, bolts, braces };
enum class Diagonals { both, first, second };
enum class BraceKind { cable, strut };

/// What opens joints: a spring at each, or one torque, equal at all, that prescribes their mean.
enum class JointDrive { each, mean };
/// One step of what is done to a formed shell. Steps are done in order; members that the kind of a
/// step does not use have no effect.
struct Step {
  StepKind kind = StepKind::move;
  double progress = 1;     ///< progress of the boundary; 0: original, 1: actuated, may be above 1
  double radius_mm = 0;    ///< radius of a circle's boundary; 0: `progress` is used
  Points edge_points;      ///< (k, x, y, z): displacement of edge point k off the motion
  std::vector<int> joint;  ///< indices (i, j)
  std::vector<double> to_mm;  ///< target (x, y, z) of the joint; empty: `depth_mm` is used
  double depth_mm = 0;        ///< inward, against the shell's normal at the joint
  std::vector<double> along;  ///< direction of a joint's constraint; empty: direction of the push
  Lateral lateral = Lateral::free;
  double factor = 1;  ///< multiple of the loads that `load_case` names
  BranchSide side = BranchSide::lower;
  int seed = 1;
  double force_N = 0.4;      ///< largest force of a jitter on a joint along each axis
  std::string load_case;     ///< name of a load case; empty: the loads present during forming
  double stiffness_Nmm = 0;  ///< stiffness of a bolt or of an opened joint, per rad; 0: rigid
  Points cells;              ///< indices (i, j) of the braced cells; empty: all complete ones
  Diagonals diagonals = Diagonals::both;
  BraceKind brace = BraceKind::cable;
  double EA_N = 0;
  Released what = Released::joints;
  double angle_deg = 0;  ///< target for the mean angle of all joints; 0: `angles` is used
  Points angles;         ///< target angles (i, j, degrees) of single joints
  JointDrive drive = JointDrive::each;
};

/// Direction of a load on the edge: downwards; against the shell's normal; inward in the surface,
/// across the edge; in plan across the edge, turning with it.
enum class EdgeDirection { down, normal, inward, pressure };
/// Loads on the shell, in addition to its boundary.
struct Loads {
  double gravity_m_s2 = 0;    ///< downwards
  double field_N_per_mm = 0;  ///< downward force per length of rod
  Points points;              ///< forces (i, j, F_x, F_y, F_z) on joints, N
  // the following act on the formed shell alone, multiplied by the factors of a LoadCase
  double snow_N_m2 = 0;      ///< downward load per area of plan
  double wind_N_m2 = 0;      ///< wind pressure at normal incidence
  double pressure_N_m2 = 0;  ///< pressure on all faces, turning with them
  double edge_N_m = 0;       ///< load per length of the shell's edge
  EdgeDirection edge_direction = EdgeDirection::down;
  /// largest displacement of the imperfect shapes of a load case, over R_o, rho or half the
  /// bounding diagonal
  double imperfection = 0.002;
  double wind_deg = 0;  ///< direction to which the wind blows, from +x towards +y

  /// Whether there are loads during forming.
  bool any() const { return gravity_m_s2 != 0 || field_N_per_mm != 0 || !points.empty(); }
};

/// Half of the shell that has snow, seen from the middle of its joints.
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
  std::optional<double> wind_deg = {};  ///< direction of its wind; empty: that of [loads]
  Points points;                        ///< forces (i, j, F_x, F_y, F_z) on joints, N
};

}  // namespace gridshell::preset
