// By what the shell is coloured, and the colours of a sight with the bar that explains them.
#pragma once

#include <optional>
#include <vector>

#include "app/window/sight.h"
#include "engine/core/words.h"
#include "render/plot/legend.h"

namespace gridshell::window {

enum class ColourBy { none, K, K_change, deviation, energy, axial_force, displacement };
constexpr auto words(ColourBy) {
  return word_table<ColourBy>({{ColourBy::none, "none"},
                               {ColourBy::K, "K"},
                               {ColourBy::K_change, "K_change"},
                               {ColourBy::deviation, "deviation"},
                               {ColourBy::energy, "energy"},
                               {ColourBy::axial_force, "axial_force"},
                               {ColourBy::displacement, "displacement"}});
}

/// What the colours' range is of: the state in sight, all since it was chosen, or as it was set by
/// hand.
enum class RangeOf { state, run, hand };
constexpr auto words(RangeOf) {
  return word_table<RangeOf>(
      {{RangeOf::state, "state"}, {RangeOf::run, "run"}, {RangeOf::hand, "hand"}});
}

/// As the interface names it of a sight, with its unit: "bending energy (mJ/m)".
const char* label_of(const Sight& sight, ColourBy by);
/// What it is, in a sentence.
const char* meaning_of(ColourBy by);

/// The values that are coloured: of the cells or of the nodes; none where the shell has none.
struct Values {
  Eigen::VectorXd of_cells, of_nodes;

  bool any() const { return of_cells.size() + of_nodes.size() > 0; }
};
Values values_of(const Sight& sight, ColourBy by);

/// The scale of a sight's values, with nice ends.
render::ColourScale scale_of(const Values& values, ColourBy by);

/// The one that goes on from `before` as the range wants it.
render::ColourScale next_scale(const render::ColourScale& before, const render::ColourScale& now,
                               RangeOf of);

}  // namespace gridshell::window
