// The words of a frame.
#pragma once

#include <string>
#include <vector>

#include "engine/record/snapshot.h"

namespace gridshell::render {

/// What a frame's state is, the most telling first, as marked text: "*R*_{a} = 115.9 mm",
/// "height 42.1 mm", "*δ* = 3.20 mm", "force 0.214 N". What does not apply is not there.
std::vector<std::string> state_captions(const record::Frame& frame);

/// "frame 120 / 240"
std::string frame_caption(int index, int frames);

/// "residual 3.2 × 10^{−9} N, stable", or how many negative pivots make it unstable.
std::string equilibrium_caption(const record::Frame& frame);

}  // namespace gridshell::render
