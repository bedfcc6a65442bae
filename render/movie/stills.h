// The frames of a run as stills of a figure, single and side by side.
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

/// The style for stills: a heading instead of a movie's captions and timeline, no inset, and a
/// camera that does not turn.
MovieStyle still_style(MovieStyle style);

/// Draws heading and legends of a still whose stage has a style of still_style(): the title in one
/// or two lines, the caption (text with markup) below, and the frame's loads and interpenetrations.
void draw_still_labels(Canvas& canvas, const Stage& stage, const ShownFrame& shown,
                       std::string caption);

/// The default caption of a still, as text with markup: "*R*_{a} = 115.9 mm".
std::string frame_state_caption(const record::Frame& frame);
/// The default caption without depth and force of a push.
std::string unpushed_caption(const record::Frame& frame);

/// Draws every frame of the run from one fixed camera in the style's size, with its caption, colour
/// bar and scale bar (style.scale_bar_mm), as `<stem>_1.png`, `<stem>_2.png` ..., and all of them
/// side by side, lettered, with one scale bar and one colour bar, as `<stem>.png`. Returns the
/// files written. `bar`: a common colour bar of several cases; `captions` (texts with markup, one
/// per frame) replace frame_state_caption(); `origin`: the reference of displacements, by default
/// the first frame. Progress and errors are those of write_movie.
Result<std::vector<std::filesystem::path>> write_stills(
    const record::Trajectory& run, const MovieStyle& style, const std::optional<ColourBar>& bar,
    Renderer& renderer, const std::filesystem::path& stem, Watch& watch,
    const std::vector<std::string>& captions = {}, const record::Frame* origin = nullptr);

}  // namespace gridshell::render
