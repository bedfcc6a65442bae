#include "engine/preset/jitter_fields.h"

#include "engine/preset/field_makers.h"

namespace gridshell::preset {

std::vector<Field> jitter_fields() {
  using P = Preset;
  constexpr int most_trials = 1000000;
  return {
      {"jitter", "mode", "", word<&P::jitter, &Jitter::mode>(),
       "\"gravity\": a partly actuated shell is put into a field of random direction and size, the "
       "field is taken away and the actuation finished; \"random\": every joint is thrown by a "
       "random vector; \"poke\": random joints are pushed and let go"},
      {"jitter", "trials", "", integer<&P::jitter, &Jitter::trials>(between(0, most_trials)),
       "times that the shell is shaken; above 0 the run looks for states and makes no movie"},
      {"jitter", "seed", "", integer<&P::jitter, &Jitter::seed>(between(0, 1 << 30)),
       "another seed shakes otherwise; the same finds the same"},
      {"jitter", "levels", "", list<&P::jitter, &Jitter::levels>({0, 1, true}),
       "progress of the actuation at which the shell is shaken, taken in turn; empty: from 0.02 to "
       "0.5 for \"gravity\", at the end for the others"},
      {"jitter", "field_N_per_mm", "N/mm", real<&P::jitter, &Jitter::field_N_per_mm>(above(0)),
       "largest force of the field on a millimetre of rod"},
      {"jitter", "amplitude", "", real<&P::jitter, &Jitter::amplitude>({0, 10, true}),
       "how far a random field throws a joint at most along each axis, of d"},
      {"jitter", "depth", "", real<&P::jitter, &Jitter::depth>({0, 50, true}),
       "how far a joint is pushed at most, of d"},
      {"jitter", "confined", "", integer<&P::jitter, &Jitter::confined>(between(0, most_trials)),
       "trials more that begin in forms confined to each group of symmetries in turn, then "
       "released; counted apart"},
      {"jitter", "tolerance", "", real<&P::jitter, &Jitter::tolerance>({0, 1, true}),
       "states whose joints lie nearer to one another are one, of d"},
      {"jitter", "drawn", "", integer<&P::jitter, &Jitter::drawn>(between(1, 24)),
       "states in the picture"},
      {"jitter", "transitions", "", integer<&P::jitter, &Jitter::transitions>(between(0, 1000)),
       "states, from the lowest in energy on, of which is found out where they go when the "
       "boundary is let out and drawn in again and when they are poked"},
      {"jitter", "barriers", "", flag<&P::jitter, &Jitter::barriers>(),
       "whether the heights of the barriers between the states in the picture are looked for, on a "
       "mesh of 4 edges"},
  };
}

}  // namespace gridshell::preset
