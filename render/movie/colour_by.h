// What of a frame is coloured: a value a cell or a node.
#pragma once

#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"
#include "render/canvas/legend.h"
#include "render/movie/movie_style.h"
#include "render/movie/run_summary.h"

namespace gridshell::render {

/// Whether the values are the cells'; else they are the nodes', of rods.
bool of_cells(ColourBy by);

/// Whether a run may know it of no frame: forces and energies along the rods of an older version or
/// of a net, distances where there is no net.
bool may_be_missing(ColourBy by);

/// What displacements and changes are measured from.
struct ColourOrigin {
  const record::Frame& first;  ///< of the run
  double depth_mm = 0;         ///< of the push, at its deepest
};

/// One value a cell or a node: K or its change (rad), deviation over rho, displacement over depth,
/// bending energy over length (mJ/m), axial force (N). Empty for none, and where the frame does not
/// know them.
Eigen::VectorXd coloured_values(ColourBy by, const record::Layout& layout,
                                const record::Frame& frame, const ColourOrigin& from);

/// For a run of which no frame knows what is to be coloured: what it lacks. Errors:
/// Fault::bad_input.
tl::unexpected<Error> missing_values_error(ColourBy by);

// One colour bar for all runs that are shown together.

/// The scale that suits all of the runs: sequential where the values have one sign, else diverging
/// about zero; none when nothing is coloured. It comes from the most that each cell comes to, so
/// that it does not depend on how many frames sample the path, and a few strongly bent cells at the
/// boundary do not pale the rest. The style's map and range go before.
std::optional<ColourBar> colour_bar_of(const std::vector<const RunSummary*>& runs,
                                       const MovieStyle& style);

}  // namespace gridshell::render
