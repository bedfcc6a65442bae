// The figures of shells that were designed on nets: over their nets, by deviation, footprints, K,
// r against latitude.
#pragma once

#include <filesystem>
#include <vector>

#include "app/case_record.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/draw/renderer.h"

namespace gridshell::app {

/// Writes `<stem>_net.png`, `<stem>_deviation.png` and, each as PNG and SVG, `<stem>_footprint`,
/// `<stem>_K`, `<stem>_quantiles`, for one cap alone `<stem>_latitude` with the joints scanned
/// where the preset has any, and for building blocks `<stem>_blocks.png` and `<stem>_seams`.
/// Errors: io, cancelled, bad_input when a picture cannot be that size.
Result<void> draw_net_pictures(const std::vector<CaseRecord>& records, render::Renderer& renderer,
                               const std::filesystem::path& stem, Watch& watch);

}  // namespace gridshell::app
