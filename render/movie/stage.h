// The stage of a run: cameras, ground, colours and captions, which are fixed over all its frames.
// Movies, stills and the window get the geometry of a frame from it, and draw captions and legends
// over the rendered picture by it. Of the frames it stores only the first.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"
#include "render/canvas/canvas.h"
#include "render/gl/renderer.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/framing.h"
#include "render/movie/movie_style.h"
#include "render/movie/run_summary.h"

namespace gridshell::render {

// Checks of a run and a style. Errors: Fault::bad_input with the frame or with what is missing.

/// Whether a run can be shown: it passes the following checks for all its frames and has at least
/// one.
Result<void> check_showable(const record::Trajectory& run, const MovieStyle& style);
/// Whether some frame has the values that are to be coloured.
Result<void> check_coloured(const RunSummary& survey, const MovieStyle& style);
/// Whether size and zoom of the picture are in their ranges.
Result<void> check_size(const MovieStyle& style);
/// Whether a frame, number `at` of the run, has a finite position for every node and, if K□ is
/// shown, its value for every cell.
Result<void> check_frame(const record::Layout& layout, const record::Frame& frame, int at,
                         const MovieStyle& style);

/// A frame and its position in the run, from 0.
struct ShownFrame {
  const record::Frame& frame;
  int at = 0;
};

/// A run with everything that its pictures have in common.
class Stage {
 public:
  /// The stage of a run that check_showable() accepts, with the summary of its frames. The layout
  /// must outlive the stage. `shared`: a common colour bar of several runs instead of its own.
  Stage(const record::Layout& layout, RunSummary survey, const MovieStyle& style,
        const std::optional<ColourBar>& shared = std::nullopt);
  /// The stage of a run in memory.
  Stage(const record::Trajectory& run, const MovieStyle& style);

  int frames() const { return survey_.frames; }
  const record::Layout& run() const { return run_; }
  const MovieStyle& style() const { return style_; }
  const FrameLayout& layout() const { return layout_; }
  const RunSummary& survey() const { return survey_; }
  const ProgressAxis& progress() const { return progress_; }
  /// the colour bar for all frames; empty if nothing is coloured
  const std::optional<ColourBar>& colour_bar() const { return bar_; }
  /// the scale of the arrows of loads; empty if there are none
  std::optional<ArrowKey> arrow_key() const;
  double pixels_per_mm() const { return framings_.front().pixels_per_mm(); }
  /// the box that contains the shell in all frames, in pixels
  const Box& shell_box() const { return framings_.front().seen(); }

  /// the geometry of a frame
  Drawing drawing(const record::Frame& frame) const;
  /// the colour and name of the first state, "unloaded", if it is drawn behind the frame
  std::optional<ColourKey> ghost_key(const record::Frame& frame) const;
  /// this key as a caption, "grey: unloaded"; otherwise empty
  std::string ghost_caption(const record::Frame& frame) const;
  /// the camera of frame `at`
  Camera camera(int at) const;

  /// The complete picture of a frame with all views, captions and legends. Errors: the renderer's.
  Result<Image> draw(Renderer& renderer, const ShownFrame& shown) const;
  /// The picture without captions and legends.
  Result<Image> draw_views(Renderer& renderer, const ShownFrame& shown) const;

  /// Draws captions and legends of a frame over its picture.
  void finish(Image& picture, const ShownFrame& shown) const;
  /// Draws captions and legends of a frame on a canvas of the picture's size.
  void draw_overlay(Canvas& canvas, const ShownFrame& shown) const;

 private:
  std::vector<Colour> colours_of(const record::Frame& frame) const;
  std::vector<Colour> cell_colours(const record::Frame& frame) const;
  std::vector<Colour> node_colours(const record::Frame& frame) const;
  void draw_captions(Canvas& canvas, const ShownFrame& shown) const;
  double moment(int at) const { return frames() > 1 ? double(at) / (frames() - 1) : 0; }

  const record::Layout& run_;
  RunSummary survey_;
  MovieStyle style_;
  ProgressAxis progress_;
  std::optional<ColourBar> bar_;
  FrameLayout layout_;
  std::vector<Box> panels_;        ///< one per view
  std::vector<Framing> framings_;  ///< one per view, each in a picture of its panel's size
  TopExtent top_;
  double ground_z_mm_ = 0;
};

// Shells as lines (vector graphics), in which parts behind cells are faded.

/// Draws rods, rings, ghosts, joints, marks and arrows of `drawing` into a box of the canvas as the
/// camera sees them. Hidden ones are drawn first, faded by the larger of 0.55 and the drawing's
/// far_fade; at a far_fade of 1 they are left out. Coloured cells are filled over them.
void draw_shell_lines(Canvas& canvas, const Box& box, const Drawing& drawing, const Camera& camera);

/// Draws ⊗ or ⊙ over a picture of the drawing where an arrow is along the view.
void mark_arrows_along_view(Image& picture, const Drawing& drawing, const Camera& camera);

/// A function that draws the shell; it owns copies of the drawing and its layout.
std::function<void(Canvas&, const Box&)> shell_lines(Drawing drawing, const Camera& camera);

}  // namespace gridshell::render
