// What a change of a preset's keys means for the shell in hand.
#pragma once

#include "engine/core/result.h"
#include "engine/preset/preset.h"

namespace gridshell::window {

/// How much of the shell a change touches: pictures alone, its meshes, where the boundary is, the
/// rods and what they carry, or the whole shape, which is formed anew.
enum class ChangeKind { none, looks, accuracy, boundary, rods, shape };

ChangeKind kind_of_change(const preset::Preset& before, const preset::Preset& after);

/// Whether the keys agree with one another. Errors: bad_input, as of a file that says the same.
Result<void> check_preset(const preset::Preset& preset);

}  // namespace gridshell::window
