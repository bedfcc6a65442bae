// Frames between the load steps of a path, read off it.
#pragma once

#include <map>
#include <optional>

#include "engine/footprint/mesh.h"
#include "engine/record/contacts.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Between two load steps of one smooth branch the coarsest mesh is brought to rest at t, from the
/// cubic through states and tangents of both [Hermite]; what finer meshes add to its nodes, K,
/// reactions and energies, and what lies along the rods, is a polynomial in t through up to six
/// load steps of that branch [Lagrange]. Residual and pivots are the coarsest mesh's. The error
/// estimates are those of the load steps around it, evenly in between, and twice what polynomials
/// of one degree less, without the first or the last of those load steps, would have changed.
class FramesBetween {
 public:
  /// `measure`: as of Caption.
  FramesBetween(EquilibriumPath& path, decltype(Caption::measure) measure, const Watch& watch);

  /// The frame of a sample, without its place and event. Nothing: on a load step; where the branch
  /// is left, not stable, on one mesh, or pressed together by contact; where the error by the
  /// polynomial is more than a tenth of the tolerance.
  std::optional<record::Frame> at(const PathSample& sample);

 private:
  struct Window {
    std::size_t first = 0;       ///< load step
    Eigen::VectorXd weights;     ///< of the polynomial
    Eigen::VectorXd without[2];  ///< of it less those without the first, the last load step
    double share = 0;            ///< of the way between the two load steps around it
    std::size_t before = 0;      ///< the first of those
  };
  std::optional<Window> window_at(const PathSegment& segment, double t) const;
  std::vector<const record::Frame*> knots_in(const PathSample& sample, const Window& window);
  std::optional<record::Frame> knot_at(const LoadStep& step);
  std::optional<record::Frame> leading_at(double t, State guess);

  EquilibriumPath& path_;
  decltype(Caption::measure) measure_;
  const Watch& watch_;
  MeshTransfer to_finest_;
  record::ContactSearch contacts_;
  bool wanted_;
  std::size_t segment_ = 0;
  std::map<std::size_t, std::optional<record::Frame>> knots_;  // by load step; nothing: it has none
};

}  // namespace gridshell::simulate
