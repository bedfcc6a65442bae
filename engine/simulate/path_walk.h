// Simulation::Walk: how a simulation follows one segment of its path.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/simulate/saved_segments.h"
#include "engine/simulate/simulation.h"

namespace gridshell {

/// The load step to take instead of `step`, at least an eighth of it, where the stiffness of the
/// lowest mode decreases towards zero. A branch may lose its stability and regain it within one
/// step, while the shell would have left it in between: the steps become short enough to detect
/// that. `branch`: the stiffness at the load steps of this branch.
double shortened_step(const std::vector<simulate::LowestStiffness>& branch, double step);
/// Whether the last stiffness is low enough for its error by the mesh to matter.
bool near_zero(const std::vector<simulate::LowestStiffness>& branch);

/// Follows one segment of the path: its load steps, its events, and the limit that ends it.
class Simulation::Walk {
 public:
  Walk(Simulation& of, double to, const BifurcationPolicy& leaving, PathRecord* record,
       const Watch& watch)
      : of_(of), to_(to), leaving_(leaving), record_(record), watch_(watch) {}

  Report all();

 private:
  double now() const { return shell_.state().t; }
  void record_step();
  void report_position() const;
  void accept();
  bool resume();
  bool watches_stability() const {
    return record_ && of_.actuating_ && leaving_.requested && scene_.imperfection.chooses();
  }
  void save_segment(std::optional<Outcome> end);
  Outcome step();
  Outcome accept_step(double next, const NestedState& good);
  Outcome branch_ended(Outcome how, double next, const NestedState& good);
  Outcome end_at(Event limit);
  Outcome end_before(Event limit, double bad, const NestedState& good);
  void note_return();
  bool too_coarse();
  double located_to() const;
  double parameter_scale(double t) const;
  void bisect(double bad, const NestedState& good, const std::function<bool()>& accepted);
  bool switch_branch(Event& event, std::vector<TimedState>& moments);
  bool switch_branch_to(double there, const PathPoint& last, Event& event,
                        std::vector<TimedState>& moments);
  bool skipped_a_branch(const PathPoint& last);
  void confirm(Event& event);
  void store_companion();

  Simulation& of_;
  NestedShell& shell_ = *of_.shell_;
  const Scene& scene_ = *of_.scene_;
  double to_;
  BifurcationPolicy leaving_;
  PathRecord* record_;
  const Watch& watch_;
  // a path that starts past a limit may return, but must not exceed it further
  Limits limits_ = of_.limits_here();
  bool from_past_limit_ = of_.exceeded_limit().has_value();
  simulate::SavedSegments* saved_ = record_ ? of_.context_.segments.get() : nullptr;
  simulate::SavedSegment segment_;  // what was followed; its load steps are in *record_
  Effort effort_before_;
};

}  // namespace gridshell
