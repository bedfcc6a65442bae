// One run set up for showing: cameras, ground, colours and captions, fixed over all its frames. A
// movie, a still and a window take a frame from here as geometry, and finish the picture drawn of
// it with captions and legends. It stores no frame but the first: any other is handed to it.
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

/// Whether a run can be shown: it has frames, each with a position for every node and, where K is
/// shown, one for every cell; some frame knows what is to be coloured; the picture has a size.
/// Errors: Fault::bad_input naming the frame or what is lacking.
Result<void> check_showable(const record::Trajectory& run, const MovieStyle& style);
/// Whether any frame knows what is to be coloured.
Result<void> check_coloured(const RunSummary& survey, const MovieStyle& style);
Result<void> check_size(const MovieStyle& style);
/// `at`: the frame's position in the run.
Result<void> check_frame(const record::Layout& layout, const record::Frame& frame, int at,
                         const MovieStyle& style);

/// A frame and its position in the run, from 0.
struct ShownFrame {
  const record::Frame& frame;
  int at = 0;
};

class Stage {
 public:
  /// The layout outlives the stage, whose run is showable. The colour bar is the survey's own
  /// unless one is given that several runs share.
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
  /// over all frames; none when nothing is coloured
  const std::optional<ColourBar>& colour_bar() const { return bar_; }
  /// of the arrows of loads; none when there are none
  std::optional<ArrowKey> arrow_key() const;
  double pixels_per_mm() const { return framings_.front().pixels_per_mm(); }
  /// what the shell covers over all frames, in pixels
  const Box& shell_box() const { return framings_.front().seen(); }

  /// what to draw of a frame, and from where
  Drawing drawing(const record::Frame& frame) const;
  Camera camera(int at) const;

  /// The whole picture of a frame, all views of it, captions and legends. Errors: the renderer's.
  Result<Image> draw(Renderer& renderer, const ShownFrame& shown) const;
  /// The picture without captions and legends.
  Result<Image> draw_views(Renderer& renderer, const ShownFrame& shown) const;

  /// Draws captions, colour bar, top view and scale bar of a frame over its picture.
  void finish(Image& picture, const ShownFrame& shown) const;
  /// Draws captions and legends onto any canvas of the picture's size.
  void draw_overlay(Canvas& canvas, const ShownFrame& shown) const;

 private:
  std::vector<Colour> colours_of(const record::Frame& frame) const;
  std::vector<Colour> cell_colours(const record::Frame& frame) const;
  std::vector<Colour> node_colours(const record::Frame& frame) const;
  void draw_captions(Canvas& canvas, const ShownFrame& shown) const;
  bool changed(const record::Frame& frame) const;
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

// A shell as lines: what is hidden behind cells is faded, what is not is strong, and all of it can
// be enlarged without end.

/// Whether each point is hidden from the camera by a cell of the drawing (its four joints' two
/// triangles), which lies before it by more than `slack_mm`.
std::vector<bool> hidden_points(const Drawing& drawing, const Camera& camera,
                                const Eigen::Matrix3Xd& points, double slack_mm);

/// Draws rods, rings, nets next to them, joints, marks and arrows of `drawing` into a box of the
/// canvas as the camera sees them: hidden ones first, faded by the drawing's far_fade (1: left
/// out).
void draw_shell_lines(Canvas& canvas, const Box& box, const Drawing& drawing, const Camera& camera);

/// Draws the shell later: the returned function keeps the drawing and its layout.
std::function<void(Canvas&, const Box&)> shell_lines(Drawing drawing, const Camera& camera);

}  // namespace gridshell::render
