// Prescribed motion along a path: pinned nodes, constrained joints, loads.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/footprint/actuation.h"
#include "engine/footprint/mesh.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// Progress of a motion, 0 to 1, as a function of the path parameter t.
enum class PathLaw {
  square,  ///< t^2: a flat shell that buckles rises as the square root of the progress of its
           ///< boundary, so positions are smooth in t = sqrt(progress) down to the flat
  even     ///< t
};

/// Progress of an actuation at path parameter t.
inline double progress_at(double t) { return t * t; }
/// Path parameter of a progress, the inverse of progress_at().
inline double parameter_at(double progress) { return std::sqrt(std::max(progress, 0.0)); }

/// A factor that grows with the motion.
struct LoadFactor {
  double begin = 0, change = 0;
};

/// A node on an arm about another one: the arm turns and changes its length evenly in t.
struct EndRotation {
  int node = 0, about = 0;
  Eigen::Vector3d arm{0, 0, 0};   ///< at t = 0, mm
  Eigen::Vector3d axis{0, 0, 1};  ///< unit
  double angle = 0;               ///< to t = 1, rad
  double stretch = 0;             ///< the arm's length is multiplied by 1 + t stretch

  /// The arm at t.
  Eigen::Vector3d at(double t) const;
  /// Derivative of the arm by t.
  Eigen::Vector3d rate(double t) const;
};

/// Rotation about a node that maps the arm `from` to the arm `to` by the smaller angle.
EndRotation rotation_between(int node, int about, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to);

/// Positions and velocities of pinned nodes and of constrained components at path parameter t, and
/// the factors of the dead loads and of the applied load. By default loads are applied in
/// proportion to the progress; the flat shell carries none.
struct PinnedMotion {
  Eigen::Matrix3Xd begin;   ///< 3 x nodes at t = 0, mm; free components are ignored
  Eigen::Matrix3Xd change;  ///< to t = 1
  PathLaw law = PathLaw::square;
  LoadFactor load{0, 1};
  LoadFactor field{0, 0};
  LoadFactor opening{0, 0};             ///< factor of the joint actuation
  std::vector<EndRotation> turns = {};  ///< nodes that move on circles instead of lines

  double progress(double t) const { return law == PathLaw::square ? progress_at(t) : t; }
  double speed(double t) const { return law == PathLaw::square ? 2 * t : 1.0; }
  Eigen::Matrix3Xd at(double t) const;
  Eigen::Matrix3Xd rate(double t) const;  ///< derivative by t
  double factor_at(const LoadFactor& growth, double t) const {
    return growth.begin + progress(t) * growth.change;
  }
  /// Sets the loads of `system` to those at t.
  void apply_loads(Linearisation& system, double t) const;
  /// Sets the prescribed components of `state` and the loads of `system` to their values at t.
  void impose(Linearisation& system, double t, State& state) const;
  /// Derivative by t of all columns and of the axial forces at a state just factorised.
  void velocity(Linearisation& system, double t, const State& state, State& velocity) const;
};

/// The motion of a mesh's pinned nodes: its edge points and prescribed joints, the far ends of
/// tails, which rotate about them, the ghosts of ends with prescribed direction, and the supports
/// of springs.
PinnedMotion pinned_motion(const RodMesh& mesh, const BoundaryMotion& motion);

}  // namespace gridshell
