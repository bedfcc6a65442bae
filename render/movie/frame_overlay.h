// Where the parts of a frame are: picture, captions, legends. They never overlap, at any size;
// what does not fit is left out.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/record/trajectory.h"
#include "render/canvas/canvas.h"
#include "render/canvas/legend.h"
#include "render/gl/renderer.h"
#include "render/movie/movie_style.h"
#include "render/movie/run_summary.h"

namespace gridshell::render {

inline constexpr Colour pale_ink{0.38f, 0.39f, 0.42f, 1}, event_ink{0.70f, 0.10f, 0.08f, 1},
    contact_ink{0.80f, 0.05f, 0.60f, 1}, brace_ink{0.30f, 0.36f, 0.50f, 1};

/// Boxes in pixels; an empty one is not shown.
struct FrameLayout {
  double font_size = 17;  ///< of captions; follows the picture's height
  Box title, state;       ///< upper left; the title in the lines below
  Box heading;            ///< of a still: its title's lines and its caption
  Box event, timeline;    ///< lower left, one line each
  Box colour_bar, inset, scale_bar, arrow_key, plot;
  Box view;                              ///< what is left for the shell
  std::vector<std::string> title_lines;  ///< of the title, or of a still's heading

  std::vector<Box> parts() const {
    return {title, state,     heading,   event, timeline, colour_bar,
            inset, scale_bar, arrow_key, plot,  view};
  }
};

/// The distance of a still's heading from the picture's edge, in ems.
inline constexpr double still_margin = 0.9;

/// The title's font, at the layout's size of font.
TextStyle title_style(const MovieStyle& style, double font_size);

/// A wide picture has inset and colour bar in a column on the right, a tall one in a strip below.
/// What else is written into a frame, in addition to its title and state.
struct FrameNotes {
  bool loads = false;      ///< a row of their sums under a still's heading
  bool arrow_key = false;  ///< of their arrows
  bool contacts = false;   ///< a row of these
};
FrameLayout lay_out_frame(const MovieStyle& style, const ColourBar* bar, FrameNotes notes = {});

// The words of a frame, which speak of that frame alone.

/// What a frame's state is, the most important first, as marked text: of a pushed shell "*δ* = 3.20
/// mm" and "*F* = 0.214 N"; "*R*_{a} = 115.9 mm", of a pushed shell where its boundary is not where
/// the actuation ends; then "height 42.1 mm", or "*t* = 12 ms" where it moves in time. What does
/// not apply is not there.
std::vector<std::string> state_captions(const record::Frame& frame);

/// A mark where parts of the frame touch; `thin_mm`: the least width of what is to be seen.
void put_contacts(const record::Layout& layout, const record::Frame& frame, double thin_mm,
                  Drawing& drawing);

/// Balls at the ends that are supported, as in the holes of a plate; where a spring pulls a node, a
/// zigzag to a ball at the spring's support; sleeves around the ends of clamped rods. `supported`:
/// nodes with a reaction in some frame of the run.
void put_supports(const record::Layout& layout, const record::Frame& frame,
                  const std::set<int>& supported, const Appearance& look, Drawing& drawing);

/// The frame's braces as bars.
void put_braces(const record::Layout& layout, const record::Frame& frame, double thin_mm,
                Drawing& drawing);

/// Its loads as arrows, those of force_arrows(), and the key to their scale; none where there are
/// none.
void put_loads(const record::Layout& layout, const record::Frame& frame, double largest_N,
               double thin_mm, Drawing& drawing);
std::optional<ArrowKey> arrow_key(const record::Layout& layout, double largest_N);

/// "loads 71.98 kN, reactions 71.98 kN": sizes of the sums of those that are known.
std::string load_caption(const record::Frame& frame);

/// "3 contacts"; empty: none, or not looked for.
std::string contact_caption(const record::Frame& frame);

/// What happened in this very frame: its event, or that it is unstable, or what touches; empty when
/// nothing did.
std::string event_caption(const record::Frame& frame);

// A thin bar under the shell: how far the run has come, and what happened on the path.

/// Draws the bar of a run at frame `at` into `box`, between the axis' ends. Of the marks those up
/// to now are shown, unstable frames as red lengths, the others as signs; next to the bar is what
/// occurred, each once.
void draw_timeline(Canvas& canvas, const Box& box, const std::vector<Mark>& marks,
                   const ProgressAxis& axis, int at, double font_size);

// A small drawing of one frame seen from above: boundaries, cells, rods, joints.

/// What the top view shows of the plane, fixed over a run: a square, mm.
struct TopExtent {
  double x_mm = 0, y_mm = 0;  ///< its middle
  double half_mm = 1;
};

/// `cell_colours`: one per cell, or empty. Boundaries and joints are drawn where the look has any.
void draw_top_view(Canvas& canvas, const Box& box, const record::Layout& layout,
                   const record::Frame& frame, const TopExtent& extent,
                   const std::vector<Colour>& cell_colours, const Appearance& look = {});

}  // namespace gridshell::render
