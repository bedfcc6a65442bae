// Frames between the load steps of a path, read off it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/footprint/mesh.h"
#include "engine/record/contacts.h"
#include "engine/simulate/path_sampler.h"

namespace gridshell::simulate {

/// Between two load steps of one smooth branch the coarsest mesh is brought to rest at t, from the
/// polynomial through states and tangents of up to four, two on each side [Hermite]; what finer
/// meshes add to its nodes, K, reactions and energies, and what lies along the rods, is a
/// polynomial in t through up to six load steps of that branch [Lagrange], or, where that leaves
/// too much or does not lead to a state, through the two around it and three states certified
/// between them. The residual is the coarsest mesh's. Its pivots are those in the middle of a
/// quarter of the way between the load steps, as long as corrections by that factorisation shrink
/// tenfold: no stiffness that they meet differs by more than a tenth then. The error estimates are
/// those of the load steps around it, evenly in between, and twice what polynomials of one degree
/// less, without the first or the last of those load steps, would have changed.
class FramesBetween {
 public:
  /// `measure`: as of Caption; `expected`: samples that may come, in the order of their index.
  /// Frames are made some pieces of the way ahead, by all of the scene's team, and are the same
  /// without one.
  FramesBetween(EquilibriumPath& path, decltype(Caption::measure) measure, const Watch& watch,
                std::vector<PathSample> expected = {});

  /// The frame of a sample, without its place and event. Nothing: on a load step; where the branch
  /// is left, not stable, on one mesh, or pressed together by contact; where the error by the
  /// polynomial is more than a tenth of the tolerance.
  std::optional<record::Frame> at(const PathSample& sample);

 private:
  /// What finer meshes add at a certified state, and the coarsest mesh there.
  struct Knot {
    record::Frame added;
    PathPoint leading;
    bool hard = false;  ///< whether the coarsest mesh took many steps to it
  };
  using Knots = std::vector<std::shared_ptr<const Knot>>;
  /// Of a polynomial in t at a place.
  struct Weights {
    Eigen::VectorXd all;
    Eigen::VectorXd without[2];  ///< less those without the first, the last of its knots
  };
  struct Window {
    std::size_t first = 0, last = 0;  ///< load steps
    std::size_t before = 0;           ///< that in front of the sample
  };
  /// A frame as it is begun, and as it becomes.
  struct Draft {
    PathSample sample;
    Knots around, knots;  ///< those at the load steps around it, and all that count
    Weights weights;
    bool closer = false;  ///< whether the knots are those between two load steps
    std::optional<record::Frame> frame = {};

    double from() const { return around[0]->leading.t; }
    double to() const { return around[1]->leading.t; }
    double share() const { return (sample.t - from()) / (to() - from()); }
    /// Path parameter in the middle of its piece of the way.
    double middle() const;
  };
  /// Where the coarsest mesh was factorised last for a frame, and how often it was by then.
  struct Factored {
    Linearisation& system;
    double t = record::unknown;
    bool closer = false;  ///< as of the draft
    Inertia inertia = {};
    int count = 0;
  };
  static Weights weights_at(const Knots& knots, double t);
  std::optional<Window> window_at(const PathSegment& segment, double t) const;
  State guess_at(double t, const Knots& knots) const;
  Knots knots_in(const PathSegment& segment, const Window& window);
  Knots knots_between(const PathSegment& segment, const Window& window);
  double doubt_mm(const Knots& knots, const Weights& weights) const;
  std::shared_ptr<const Knot> knot_at(double t, const LoadStep& beside, const LoadStep* across);
  std::optional<Draft> draft_at(const PathSample& sample, bool closer);
  std::size_t helpers() const;
  void read_ahead(const PathSample& sample);
  void forget_behind(const PathSample& sample);
  void finish(std::vector<Draft>& drafts);
  void finish(Draft& draft, Factored& factored) const;
  std::optional<record::Frame> leading_at(Linearisation& system, double t, State& guess,
                                          std::optional<Inertia> factored = {}) const;
  void compose(Draft& draft) const;

  EquilibriumPath& path_;
  decltype(Caption::measure) measure_;
  const Watch& watch_;
  MeshTransfer to_finest_;
  record::ContactSearch contacts_;
  bool wanted_;
  std::size_t segment_ = 0;
  std::vector<PathSample> expected_;
  std::map<int, std::optional<record::Frame>> ready_;    // by index of the sample
  std::vector<std::unique_ptr<Linearisation>> systems_;  // of the team but for its first
  // by load step, and by quarters of the way to the next; nothing: there is none
  std::map<std::pair<std::size_t, int>, std::shared_ptr<const Knot>> knots_;
};

}  // namespace gridshell::simulate
