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
/// load steps of that branch [Lagrange], or, where that leaves too much, through the two around it
/// and three states certified between them. The residual is the coarsest mesh's. Its pivots are
/// those in the middle of a quarter of the way between the load steps, as long as corrections by
/// that factorisation shrink tenfold: no stiffness that they meet differs by more than a tenth
/// then. The error estimates are those of the load steps around it, evenly in between, and twice
/// what polynomials of one degree less, without the first or the last of those load steps, would
/// have changed.
class FramesBetween {
 public:
  /// `measure`: as of Caption.
  FramesBetween(EquilibriumPath& path, decltype(Caption::measure) measure, const Watch& watch);

  /// The frame of a sample, without its place and event. Nothing: on a load step; where the branch
  /// is left, not stable, on one mesh, or pressed together by contact; where the error by the
  /// polynomial is more than a tenth of the tolerance.
  std::optional<record::Frame> at(const PathSample& sample);

 private:
  /// What finer meshes add at a certified state, and the coarsest mesh's state there.
  struct Knot {
    record::Frame added;
    State leading;
  };
  using Knots = std::vector<const Knot*>;
  /// Of a polynomial in t at a place.
  struct Weights {
    Eigen::VectorXd all;
    Eigen::VectorXd without[2];  ///< less those without the first, the last of its knots
  };
  struct Window {
    std::size_t first = 0;   ///< load step
    std::vector<double> t;   ///< of the load steps
    std::size_t before = 0;  ///< that in front of the sample
  };
  static Weights weights_at(const std::vector<double>& known, double t);
  std::optional<Window> window_at(const PathSegment& segment, double t) const;
  Knots knots_in(const PathSegment& segment, const Window& window);
  Knots knots_between(const PathSegment& segment, const Window& window);
  double doubt_mm(const Knots& knots, const Weights& weights) const;
  std::optional<Knot> knot_at(double t, const LoadStep& beside);
  Inertia factored_near(double t, const PathPoint& from, const PathPoint& to);
  std::optional<record::Frame> leading_at(double t, State& guess,
                                          std::optional<Inertia> factored = {});
  record::Frame composed(record::Frame frame, double t, double share, const Knots& around,
                         const Knots& knots, const Weights& weights) const;

  EquilibriumPath& path_;
  decltype(Caption::measure) measure_;
  const Watch& watch_;
  MeshTransfer to_finest_;
  record::ContactSearch contacts_;
  bool wanted_;
  std::size_t segment_ = 0;
  /// Where the coarsest mesh was factorised last for a frame, and how often it was by then.
  struct Factored {
    double t = record::unknown;
    Inertia inertia = {};
    int count = 0;
  } factored_;
  // by load step, and by quarters of the way to the next; nothing: there is none
  std::map<std::pair<std::size_t, int>, std::optional<Knot>> knots_;
};

}  // namespace gridshell::simulate
