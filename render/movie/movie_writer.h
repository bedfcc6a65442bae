// A run to a folder of numbered pictures.
#pragma once

#include <filesystem>
#include <optional>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/record/snapshot.h"
#include "render/draw/renderer.h"
#include "render/movie/frame_writer.h"
#include "render/movie/style.h"
#include "render/movie/survey.h"
#include "render/plot/legend.h"

namespace gridshell::render {

/// What writing a movie took, wall-clock seconds in all.
struct MovieReport {
  int frames = 0;
  double seconds_draw = 0;   ///< the 3D pictures
  double seconds_write = 0;  ///< waiting for captions, PNG and disk, which go on beside drawing
};

/// Writes frame_00000.png ... into `folder` (made if absent), one picture a frame of `source`,
/// whose survey has been taken; `bar` is a colour bar that several movies share. One frame is in
/// memory at a time, with the one before and its picture, every file is whole at any time. Progress
/// of `watch` grows from 0 to 1. Errors: Fault::bad_input for a run without frames or an impossible
/// size, Fault::cancelled between frames, Fault::io, those of the source.
Result<MovieReport> write_movie(const FrameSource& source, Survey survey, const MovieStyle& style,
                                const std::optional<ColourBar>& bar, Renderer& renderer,
                                const std::filesystem::path& folder, Watch& watch,
                                const OnFrame& on_frame = {});

/// Of a run in memory.
Result<MovieReport> write_movie(const record::Trajectory& run, const MovieStyle& style,
                                Renderer& renderer, const std::filesystem::path& folder,
                                Watch& watch, const OnFrame& on_frame = {});

}  // namespace gridshell::render
