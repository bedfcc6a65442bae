// One colour bar for all runs that are shown together.
#pragma once

#include <optional>
#include <vector>

#include "render/movie/style.h"
#include "render/movie/survey.h"
#include "render/plot/legend.h"

namespace gridshell::render {

/// The scale that suits all of the runs: sequential where the values have one sign, else diverging
/// about zero; none when nothing is coloured. It comes from the most that each cell comes to, so
/// that it does not depend on how many frames sample the path, and a few strongly bent cells at the
/// boundary do not pale the rest. The style's map and range go before.
std::optional<ColourBar> colour_bar_of(const std::vector<const Survey*>& runs,
                                       const MovieStyle& style);

}  // namespace gridshell::render
