// The path of an experiment as an object: followed once, by steps of its own, then sampled.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/record/sink.h"
#include "engine/record/summary.h"
#include "engine/session/session.h"

namespace gridshell::experiment {

/// One way along the path of a session, from where it began to where it was to end.
struct Leg {
  double from = 0, to = 0;  ///< path parameter
  Trail trail;
  Report report;  ///< how it ended
};

/// A session with the legs that were followed in it, and what ended the last one.
struct Course {
  Session session;
  std::vector<Leg> legs;
  record::Limit limit = record::Limit::none;
  std::string limit_reason;
  double seconds_setup = 0;

  /// The error estimate at the end, where errors are largest as a rule, mm; NaN where not known.
  double last_estimate_mm() const;
};

/// Follows a path on the meshes of a plan. Errors: bad_input, no_equilibrium, cancelled.
using Follow = std::function<Result<Course>(const LevelPlan&, const Watch&)>;

/// The path on the coarsest plan whose estimate meets the scene's tolerance at its end. Errors:
/// those of `follow`; no_equilibrium where the finest meshes do not meet it.
Result<Course> course_of(const Scene& scene, const Follow& follow, const Watch& watch);

/// A sample of a leg.
struct Sample {
  int index = 0;  ///< of the frame
  std::size_t leg = 0;
  double t = 0;  ///< path parameter
};

/// Certifies the course at a sample and leaves the session there; what the path itself found is
/// not changed by it. Outcomes as of a path; `reached` also where the sample lies beyond the leg's
/// end, which is then told by its t.
Report stand_at(Course& course, const Sample& sample, const Watch& watch);

/// How a leg that ended before its end is told, as a limit and a sentence. `at` says where, given a
/// path parameter: "at progress 0.4312".
void tell_limit(Course& course, const Leg& leg, const std::function<std::string(double)>& at);

}  // namespace gridshell::experiment
