// A thin bar under the shell: how far the run has come, and what happened on the way.
#pragma once

#include <vector>

#include "render/movie/survey.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

/// Draws the bar of a run of `frames` at frame `at` into `box`. Of the marks those up to now are
/// shown, unstable frames as red lengths, the others as signs; beside the bar stands what occurred,
/// each once.
void draw_timeline(Canvas& canvas, const Box& box, const std::vector<Mark>& marks, int at,
                   int frames, double font_size);

}  // namespace gridshell::render
