// How a computation ended, from a Newton step to the summary of a run: one list for all.
#pragma once

#include <array>
#include <cstddef>

#include "engine/core/enum_words.h"

namespace gridshell {

enum class Outcome {
  reached,
  unstable,
  lost,
  folded,
  not_finite,
  not_converged,
  too_coarse,
  locked,
  overbent,
  contact,
  cancelled,
};

/// Name of an outcome, and a sentence on it that can be continued by "... at progress 0.4".
struct OutcomeText {
  Outcome outcome;
  const char* name;
  const char* what;
};

inline constexpr std::array outcomes{
    OutcomeText{Outcome::reached, "reached", "the requested end was reached"},
    OutcomeText{Outcome::unstable, "unstable", "the path lost its stability"},
    OutcomeText{Outcome::lost, "lost", "the state jumped between load steps however small"},
    OutcomeText{Outcome::folded, "folded", "two edges folded onto one another"},
    OutcomeText{Outcome::not_finite, "not_finite", "a pivot or a position was not finite"},
    OutcomeText{Outcome::not_converged, "not_converged", "the iterations did not converge"},
    OutcomeText{Outcome::too_coarse, "too_coarse", "the mesh is too coarse for the tolerance"},
    OutcomeText{Outcome::locked, "locked",
                "the limit of the strain or of a push's stiffness was reached"},
    OutcomeText{Outcome::overbent, "overbent", "a rod is bent as far as is allowed"},
    OutcomeText{Outcome::contact, "contact", "rods or joints came into contact"},
    OutcomeText{Outcome::cancelled, "cancelled", "it was stopped"},
};

static_assert(
    [] {
      for (std::size_t k = 0; k < outcomes.size(); ++k)
        if (outcomes[k].outcome != Outcome(k)) return false;
      return !is_enumerator<Outcome(outcomes.size())>();
    }(),
    "every outcome has its line in outcomes, in their order");

/// Whether a path ended at a limit of the preset, in the last certified state before.
constexpr bool at_limit(Outcome outcome) {
  return outcome == Outcome::locked || outcome == Outcome::overbent || outcome == Outcome::contact;
}

constexpr const OutcomeText& words_of(Outcome outcome) { return outcomes[std::size_t(outcome)]; }

}  // namespace gridshell
