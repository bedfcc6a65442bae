// The figures of shells that were designed on nets: over their nets, by deviation, footprints, K,
// r against latitude.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/snapshot.h"
#include "render/draw/renderer.h"

namespace gridshell::app {

/// A finished run of a preset whose footprint is cut from a net.
struct NetRecord {
  preset::Preset preset;
  record::Trajectory run;
};

/// Writes `<stem>_net.png`, `<stem>_deviation.png` and, each as PNG and SVG, `<stem>_footprint`,
/// `<stem>_K`, `<stem>_quantiles`, for one cap alone `<stem>_latitude` with the joints scanned
/// where the preset has any, and for building blocks `<stem>_blocks.png` and `<stem>_seams`.
/// Errors: io, cancelled, bad_input when a picture cannot be that size.
Result<void> draw_net_pictures(const std::vector<NetRecord>& records, render::Renderer& renderer,
                               const std::filesystem::path& stem, Watch& watch);

}  // namespace gridshell::app
