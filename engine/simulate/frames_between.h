// Frames between the load steps of a path: polynomials through states, tangents and what was
// measured there.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "engine/record/contacts.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Interpolates frames between two load steps of one stable branch:
/// 1. the finest mesh's nodes, and K with them, by the polynomial through states and tangents of up
///    to four load steps [Hermite];
/// 2. corrections from coarser meshes, energies, reactions and values along the rods by the
/// polynomial through up to six load steps of that branch [Lagrange];
/// 3. where either is not accurate, through the two load steps around it and three states solved at
/// quarters between them.
/// The accuracy is estimated by twice the change of the polynomial without its first or last state,
/// for 1. four times its change without the farthest. A frame has the errors of the load steps
/// around it and this estimate. Its residual is not known; its pivots are those of the load steps
/// around it.
class FramesBetween {
 public:
  FramesBetween(EquilibriumPath& path, const Watch& watch);

  /// The frame of a sample, without its position on the path and event. Empty if it must be solved:
  /// it is a load step, is on no smooth branch, or the interpolation error exceeds a tenth of the
  /// tolerance.
  std::optional<record::Frame> at(const PathSample& sample);

 private:
  /// A solved state and its frame. Nodes and K of the frame are only the corrections from coarser
  /// meshes.
  struct Knot {
    NestedPathPoint point;
    record::Frame frame;
  };
  using Knots = std::vector<const Knot*>;
  /// Weights of a polynomial in t at one parameter.
  struct Weights {
    Eigen::VectorXd all;
    Eigen::VectorXd without[2];  ///< less the weights without the first [0], the last [1] knot
  };
  /// Load steps: the one in front of a sample, and those of its branch around it.
  struct Window {
    std::size_t before = 0, first = 0, last = 0;
  };
  static std::optional<Window> window_at(const PathSegment& segment, double t);
  Knots knots_in(const PathSegment& segment, std::size_t first, std::size_t last, std::size_t by);
  const Knot* knot_at(const PathSegment& segment, std::size_t quarter);
  Eigen::VectorXd curvature(const Eigen::Matrix3Xd& nodes) const;
  std::optional<Eigen::Matrix3Xd> nodes_at(double t, const Knots& knots, double& doubt_mm) const;
  std::optional<record::Frame> between(double t, const Knots& knots) const;

  EquilibriumPath& path_;
  const Watch& watch_;
  record::ContactSearch contacts_;
  bool requested_;
  // key: four times the load step of the segment, plus quarters from there to the next one; empty
  // value: there is no stable state
  std::map<std::size_t, std::optional<Knot>> known_;
  std::size_t segment_ = 0;
};

}  // namespace gridshell::simulate
