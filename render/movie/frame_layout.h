// Where the parts of a frame stand: picture, captions, legends. They never overlap, at any size;
// what does not fit is left out.
#pragma once

#include <string>
#include <vector>

#include "render/movie/style.h"
#include "render/plot/legend.h"

namespace gridshell::render {

/// Boxes in pixels; an empty one is not shown.
struct FrameLayout {
  double font_size = 17;          ///< of captions; follows the picture's height
  Box title, state;               ///< upper left, a line each
  Box event, progress, timeline;  ///< lower left, a line each
  Box colour_bar, inset, scale_bar, plot;
  Box view;  ///< what is left for the shell

  std::vector<Box> parts() const {
    return {title, state, event, progress, timeline, colour_bar, inset, scale_bar, plot, view};
  }
};

/// A wide picture has inset and colour bar in a column on the right, a tall one in a strip below.
FrameLayout lay_out_frame(const MovieStyle& style, const ColourBar* bar);

}  // namespace gridshell::render
