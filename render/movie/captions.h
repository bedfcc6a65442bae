// The words of a frame, which speak of that frame alone.
#pragma once

#include <string>
#include <vector>

#include "engine/record/snapshot.h"

namespace gridshell::render {

/// What a frame's state is, the most telling first, as marked text: of a pushed shell "*δ* = 3.20
/// mm" and "*F* = 0.214 N"; "*R*_{a} = 115.9 mm", of a pushed shell where its boundary is not where
/// the actuation ends; then "height 42.1 mm". What does not apply is not there.
std::vector<std::string> state_captions(const record::Frame& frame);

/// "frame 120 / 240"; `at` from 0
std::string frame_caption(int at, int frames);

/// "residual < 1 × 10^{−6} N, stable". An unstable frame says so in its event.
std::string equilibrium_caption(const record::Frame& frame);

/// What happened in this very frame: its event, or that it is unstable; empty when nothing did.
std::string event_caption(const record::Frame& frame);

}  // namespace gridshell::render
