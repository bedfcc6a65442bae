// The frames of a run as stills of a figure: each by itself, and all side by side.
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
#include "render/movie/movie_style.h"
#include "render/movie/stage.h"

namespace gridshell::render {

/// As stills are shown: one alone in print has no title bar, frame count, second view or turn.
MovieStyle still_style(MovieStyle style);

/// Heading, caption and legends of a still whose stage has such a style: its title in one or two
/// lines where a movie has its own, the caption (marked text) below.
void draw_still_labels(Canvas& canvas, const Stage& stage, const ShownFrame& shown,
                       std::string caption);

/// What one still shows under it, as marked text: "*R*_{a} = 115.9 mm".
std::string frame_state_caption(const record::Frame& frame);
/// The caption without what is said of a push, though one may act on the shell.
std::string unpushed_caption(const record::Frame& frame);

/// Draws every frame of the run from one fixed camera in the style's size, with its caption, colour
/// bar and scale bar (style.scale_bar_mm) as `<stem>_1.png`, `<stem>_2.png` ..., and all of them
/// side by side, lettered, with one scale bar and one colour bar, as `<stem>.png`. Returns the
/// files written. Progress and errors as write_movie.
/// `bar` is a colour bar that several cases share; `captions` (marked text, one per frame) replace
/// frame_state_caption(); `origin`: what displacements are measured from, by default
/// the first frame.
Result<std::vector<std::filesystem::path>> write_stills(
    const record::Trajectory& run, const MovieStyle& style, const std::optional<ColourBar>& bar,
    Renderer& renderer, const std::filesystem::path& stem, Watch& watch,
    const std::vector<std::string>& captions = {}, const record::Frame* origin = nullptr);

}  // namespace gridshell::render
