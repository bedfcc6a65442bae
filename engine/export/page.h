// A run as one HTML page that shows it in 3D in any browser, without a network.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/record/snapshot.h"

namespace gridshell::exports {

/// The page: turned with the mouse or a finger, scrubbed through the frames, cells coloured by K
/// with its legend, and what certifies each frame in figures. Positions are rounded to 1/65535 of
/// the shell's size, frames are left out evenly where it would pass 10 MB. Errors: what the frames
/// say; bad_input where one frame alone is larger.
Result<std::string> to_page(const record::Trajectory& run, const std::string& title);

}  // namespace gridshell::exports
