// What a certified state leaves in the record.
#pragma once

#include "engine/experiment/actuation.h"
#include "engine/record/snapshot.h"
#include "engine/solve/nested.h"

namespace gridshell::experiment {

/// The current state of `shell` as a frame: positions, energies, K of the cells and their bins
/// along x, certificate, extrapolated where the plan extrapolates. Index, progress, boundary, push
/// and event are the experiment's to add.
record::Frame frame_of(const ActuationScene& scene, NestedShell& shell);

}  // namespace gridshell::experiment
