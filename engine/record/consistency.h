// Whether the parts of a trajectory fit each other, so that whoever reads one may trust its
// indices.
#pragma once

#include "engine/core/result.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// Every index of the layout points at something, the two boundaries have equally many points, and
/// every frame has the same nodes and one K a cell. Errors: Fault::bad_input naming what does not
/// fit, with both numbers.
Result<void> check_consistency(const Trajectory& trajectory);

}  // namespace gridshell::record
