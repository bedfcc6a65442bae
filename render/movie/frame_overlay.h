// The layout of a frame (picture, captions, legends), and everything that is drawn or written on a
// frame in addition to the shell.
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
    contact_ink{0.80f, 0.05f, 0.60f, 1}, brace_ink{0.30f, 0.36f, 0.50f, 1},
    ghost_ink{0.58f, 0.6f, 0.64f, 0.6f};

/// The boxes of a frame's parts, in pixels. They never overlap, at any size; a part that does not
/// fit has an empty box and is not shown.
struct FrameLayout {
  double font_size = 17;  ///< of captions, in proportion to the picture's height
  Box title, state;       ///< upper left; the title has title_lines
  Box heading;            ///< of a still: title_lines and its caption
  Box event, timeline;    ///< lower left, one line each
  Box colour_bar, inset, scale_bar, arrow_key, plot;
  Box view;                              ///< the remaining part, for the shell
  std::vector<std::string> title_lines;  ///< of the title or of a still's heading

  std::vector<Box> parts() const {
    return {title, state,     heading,   event, timeline, colour_bar,
            inset, scale_bar, arrow_key, plot,  view};
  }
};

/// The distance of a still's heading from the picture's edge, in ems.
inline constexpr double still_margin = 0.9;

/// The font of the title; `font_size` is that of the layout.
TextStyle title_style(const MovieStyle& style, double font_size);

/// Texts of a frame for which lay_out_frame() leaves room, in addition to title and state.
struct FrameNotes {
  bool loads = false;      ///< a row with the sums of loads under a still's heading
  bool arrow_key = false;  ///< the scale of the loads' arrows
  bool contacts = false;   ///< a row with the number of interpenetrations
};
/// Lays out a frame. A wide picture has inset and colour bar (`bar`; null: none) in a column on the
/// right, a tall one in a strip below.
FrameLayout lay_out_frame(const MovieStyle& style, const ColourBar* bar, FrameNotes notes = {});

// Captions depend on their frame alone.

/// The state of a frame as texts with markup, the most important first. For a pushed shell "*δ* =
/// 3.20 mm" and "*F* = 0.214 N"; "*R*_{a} = 115.9 mm", for a pushed shell only if the actuation did
/// not reach its end; "height 42.1 mm"; "*t* = 12 ms" for a motion in time.
std::vector<std::string> state_captions(const record::Frame& frame);

/// Adds a mark at every interpenetration. In these functions `thin_mm` is the smallest width that
/// is visible.
void put_contacts(const record::Layout& layout, const record::Frame& frame, double thin_mm,
                  Drawing& drawing);

/// Adds the supports: balls at supported nodes, as in the holes of a plate, but not at joints that
/// are pushed; for a spring a zigzag from its node to a ball at the spring's support, at least
/// three balls long; sleeves around the ends of clamped rods. `supported`: nodes with a reaction in
/// some frame of the run; if there are none, the ends on a boundary that is shown have balls.
void put_supports(const record::Layout& layout, const record::Frame& frame,
                  const std::set<int>& supported, const Appearance& look, Drawing& drawing);

/// Adds the frame's braces as bars.
void put_braces(const record::Layout& layout, const record::Frame& frame, double thin_mm,
                Drawing& drawing);

/// Adds the frame's loads as the arrows of force_arrows().
void put_loads(const record::Layout& layout, const record::Frame& frame, double largest_N,
               double thin_mm, Drawing& drawing);
/// The scale of these arrows; empty if there are no loads.
std::optional<ArrowKey> arrow_key(const record::Layout& layout, double largest_N);

/// "loads 72 kN (3 % distributed), reactions 72 kN": the lengths of the vector sums, if they are
/// known; "loads 72 kN, distributed (arrows not to scale)" if all loads are those of an area.
std::string load_caption(const record::Frame& frame);

/// "3 interpenetrations (contact not modelled)"; empty: none, or not searched for.
std::string contact_caption(const record::Frame& frame);

/// The event of this frame, or that it is unstable, or its interpenetrations; empty: none of these.
std::string event_caption(const record::Frame& frame);

// The timeline: a thin bar under the shell with the progress of the run and the events on its path.

/// Draws the timeline of a run at frame `at` into `box`, with the ends of the axis at its ends.
/// Marks up to this frame are shown: lasting states (unstable, in motion, interpenetration) as
/// coloured lengths, others as signs. Next to the bar is the name of every kind that occurred.
void draw_timeline(Canvas& canvas, const Box& box, const std::vector<Mark>& marks,
                   const ProgressAxis& axis, int at, double font_size);

/// The square of the plane that the top view shows, fixed over a run.
struct TopExtent {
  double x_mm = 0, y_mm = 0;  ///< middle
  double half_mm = 1;         ///< half of its side
};

/// Draws a frame as seen from above: cells, rods and, if the look has them, boundaries and joints.
/// `cell_colours`: one per cell, or empty.
void draw_top_view(Canvas& canvas, const Box& box, const record::Layout& layout,
                   const record::Frame& frame, const TopExtent& extent,
                   const std::vector<Colour>& cell_colours, const Appearance& look = {});

}  // namespace gridshell::render
