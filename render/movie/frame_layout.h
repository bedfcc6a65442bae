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
  Box title, state;               ///< upper left; the title in the lines below
  Box heading;                    ///< of a still: its title's lines and its caption
  Box event, progress, timeline;  ///< lower left, a line each
  Box colour_bar, inset, scale_bar, plot;
  Box view;                              ///< what is left for the shell
  std::vector<std::string> title_lines;  ///< of the title, or of a still's heading

  std::vector<Box> parts() const {
    return {title,      state, heading,   event, progress, timeline,
            colour_bar, inset, scale_bar, plot,  view};
  }
};

/// Of a still's heading from the picture's edge, in ems.
inline constexpr double still_margin = 0.9;

/// The title's font, at the layout's size of font.
TextStyle title_style(const MovieStyle& style, double font_size);

/// A wide picture has inset and colour bar in a column on the right, a tall one in a strip below.
FrameLayout lay_out_frame(const MovieStyle& style, const ColourBar* bar);

}  // namespace gridshell::render
