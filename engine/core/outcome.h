// How a computation ended, from a Newton step to the summary of a run: one list for all.
#pragma once

#include <array>
#include <cstddef>

#include "engine/core/words.h"

namespace gridshell {

enum class Outcome {
  reached,
  unstable,
  lost,
  folded,
  not_finite,
  not_converged,
  meshes_disagree,
  locked,
  cancelled,
};

/// An outcome's word, and what happened as a sentence goes on: "... at progress 0.4".
struct OutcomeWords {
  Outcome outcome;
  const char* name;
  const char* what;
};

inline constexpr std::array outcomes{
    OutcomeWords{Outcome::reached, "reached", "all that was asked for was reached"},
    OutcomeWords{Outcome::unstable, "unstable", "the path lost its stability"},
    OutcomeWords{Outcome::lost, "lost", "the state jumped between load steps however small"},
    OutcomeWords{Outcome::folded, "folded", "two edges folded onto one another"},
    OutcomeWords{Outcome::not_finite, "not_finite", "a pivot or a position was not finite"},
    OutcomeWords{Outcome::not_converged, "not_converged", "the iterations did not come to rest"},
    OutcomeWords{Outcome::meshes_disagree, "meshes_disagree", "a finer mesh went to another state"},
    OutcomeWords{Outcome::locked, "locked", "the rods came to their length"},
    OutcomeWords{Outcome::cancelled, "cancelled", "it was stopped"},
};

static_assert(
    [] {
      for (std::size_t k = 0; k < outcomes.size(); ++k)
        if (outcomes[k].outcome != Outcome(k)) return false;
      return !is_enumerator<Outcome(outcomes.size())>();
    }(),
    "every outcome has its line in outcomes, in their order");

constexpr const OutcomeWords& words_of(Outcome outcome) { return outcomes[std::size_t(outcome)]; }

}  // namespace gridshell
