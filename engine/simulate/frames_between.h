// Frames between the load steps of a path: polynomials through states, tangents and what was
// measured there.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/record/contacts.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Interpolates frames between two load steps of one stable branch:
/// 1. the finest mesh's nodes, and K with them, by the polynomial through states and tangents of up
///    to four load steps [Hermite];
/// 2. what companions add to them, energies, reactions and what lies along the rods by the
///    polynomial through up to six load steps of that branch [Lagrange];
/// 3. where either is in doubt, through the two load steps around it and three states solved at
///    quarters between them.
/// Doubt is twice what the polynomial without its first or last state would change, of 1. four
/// times what it would without the farthest. A frame has the
/// errors of the load steps around it and that. Its residual is not known; its pivots are those of
/// the load steps around it.
class FramesBetween {
 public:
  /// `measure`: as of Caption.
  FramesBetween(EquilibriumPath& path, std::function<void(record::Frame&, double, bool)> measure,
                const Watch& watch);

  /// The frame of a sample, without its position on the path and event. Nothing: it must be solved,
  /// as it is a load step, or none of one smooth branch, or the interpolation leaves more than a
  /// tenth of the tolerance.
  std::optional<record::Frame> at(const PathSample& sample);

 private:
  /// A solved state and its frame, whose nodes and K are what companions add.
  struct Knot {
    NestedPathPoint point;
    record::Frame frame;
  };
  using Knots = std::vector<const Knot*>;
  /// Weights of a polynomial in t at one parameter.
  struct Weights {
    Eigen::VectorXd all;
    Eigen::VectorXd without[2];  ///< less those without the first, the last of its knots
  };
  /// Load steps: the one in front of a sample, and those of its branch around it.
  struct Window {
    std::size_t before = 0, first = 0, last = 0;
  };
  static std::optional<Window> window_at(const PathSegment& segment, double t);
  Knots knots_in(const PathSegment& segment, const Window& window);
  Knots knots_between(const PathSegment& segment, const Window& window);
  const Knot* knot_at(std::size_t step, int quarter, double t, const LoadStep& beside,
                      const LoadStep* across);
  Eigen::VectorXd curvature(const Eigen::Matrix3Xd& nodes) const;
  std::optional<Eigen::Matrix3Xd> nodes_at(double t, const Knots& knots, double& doubt_mm) const;
  std::optional<record::Frame> between(double t, const Knots& knots) const;

  EquilibriumPath& path_;
  std::function<void(record::Frame&, double, bool)> measure_;
  const Watch& watch_;
  record::ContactSearch contacts_;
  bool wanted_;
  // by load step of the segment and quarter to the next; nothing: there is no stable state
  std::map<std::pair<std::size_t, int>, std::optional<Knot>> known_;
  std::size_t segment_ = 0;
};

}  // namespace gridshell::simulate
