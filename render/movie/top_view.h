// A small drawing of one frame seen from above: boundaries, cells, rods, joints.
#pragma once

#include "engine/record/snapshot.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

/// What the top view shows of the plane, fixed over a run: a square, mm.
struct TopExtent {
  double x_mm = 0, y_mm = 0;  ///< its middle
  double half_mm = 1;
};

/// `cell_colours`: one a cell, or empty.
void draw_top_view(Canvas& canvas, const Box& box, const record::Layout& layout,
                   const record::Frame& frame, const TopExtent& extent,
                   const std::vector<Colour>& cell_colours);

}  // namespace gridshell::render
