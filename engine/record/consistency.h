// Whether the parts of a trajectory fit each other, so that whoever reads one may trust its
// indices and numbers.
#pragma once

#include "engine/core/result.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// Every index of the layout points at something of a shell of `nodes` nodes, rods are no longer
/// than those, the two boundaries have equally many points, nets hold what they are asked for, and
/// every number can be computed with. Errors: Fault::bad_input naming what does not fit, with both
/// numbers.
Result<void> check_layout(const Layout& layout, Eigen::Index nodes);

/// The frame has `nodes` nodes and one K a cell. Errors: as above; `k` names the frame.
Result<void> check_frame(const Layout& layout, const Frame& frame, std::size_t k,
                         Eigen::Index nodes);

/// All of this, of every frame the nodes of the first.
Result<void> check_consistency(const Trajectory& trajectory);

}  // namespace gridshell::record
