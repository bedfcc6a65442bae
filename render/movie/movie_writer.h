// A run to a folder of numbered pictures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/record/trajectory.h"
#include "render/canvas/legend.h"
#include "render/gl/renderer.h"
#include "render/movie/frame_writer.h"
#include "render/movie/movie_style.h"
#include "render/movie/run_plots.h"
#include "render/movie/run_summary.h"

namespace gridshell::render {

/// Writes frame_00000.png ... into `folder` (made if absent), one picture a frame of `source`,
/// whose survey has been taken; `bar` is a colour bar that several movies share. One frame is in
/// memory at a time, with the one before and its picture, every file is whole at any time. Progress
/// of `watch` grows from 0 to 1. Errors: Fault::bad_input for a run without frames or an impossible
/// size, Fault::cancelled between frames, Fault::io, those of the source.
Result<void> write_movie(const FrameSource& source, RunSummary survey, const MovieStyle& style,
                         const std::optional<ColourBar>& bar, Renderer& renderer,
                         const std::filesystem::path& folder, Watch& watch,
                         const FrameCallback& on_frame = {});

// Several runs of one preset beside one another in a frame, each from its own camera, under one
// colour bar: the cases of a movie.

/// Frames `folder`/frame_00000.png ...: frame k of every run, the last one where a run ended
/// earlier; above each its name, here plain text. Size, quality, camera and colours are the
/// style's; colours share one scale. Errors: as write_movie.
Result<void> write_side_by_side(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                Renderer& renderer, const std::filesystem::path& folder,
                                Watch& watch, const FrameCallback& on_frame = {});

}  // namespace gridshell::render
