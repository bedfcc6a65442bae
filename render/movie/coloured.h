// What of a frame is coloured: a value a cell or a node.
#pragma once

#include "engine/core/result.h"
#include "engine/record/snapshot.h"
#include "render/movie/style.h"

namespace gridshell::render {

/// Whether the values are the cells'; else they are the nodes', of rods.
bool of_cells(ColourBy by);

/// Whether a run may know it of no frame: forces and energies along the rods of an older version or
/// of a net, distances where there is no net.
bool may_lack(ColourBy by);

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
tl::unexpected<Error> nothing_coloured(ColourBy by);

}  // namespace gridshell::render
