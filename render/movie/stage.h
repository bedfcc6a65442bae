// One run set up for showing: camera, ground, colours and captions, fixed over all its frames. A
// movie, a still and a window take a frame from here as geometry, and finish the picture drawn of
// it with captions and legends.
#pragma once

#include <optional>

#include "engine/core/result.h"
#include "engine/record/snapshot.h"
#include "render/draw/drawing.h"
#include "render/movie/frame_layout.h"
#include "render/movie/framing.h"
#include "render/movie/style.h"
#include "render/movie/top_view.h"

namespace gridshell::render {

/// Whether a run can be shown: it has frames, each with a position for every node and a K for every
/// cell, and the picture has a size. Errors: Fault::bad_input naming the frame.
Result<void> check_showable(const record::Trajectory& run, const MovieStyle& style);

class Stage {
 public:
  /// The run outlives the stage and is showable.
  Stage(const record::Trajectory& run, const MovieStyle& style);

  int frames() const { return int(run_.frames.size()); }
  const MovieStyle& style() const { return style_; }
  const FrameLayout& layout() const { return layout_; }
  /// of K□ over all frames, or of the displacement; none when nothing is coloured
  const std::optional<ColourBar>& colour_bar() const { return bar_; }
  double pixels_per_mm() const { return framing_.pixels_per_mm(); }
  /// what the shell covers over all frames, in pixels
  const Box& shell_box() const { return framing_.seen(); }

  /// what to draw of frame `index`, and from where
  Drawing drawing(int index) const;
  Camera camera(int index) const;

  /// Draws captions, colour bar, top view and scale bar of frame `index` over its picture.
  void finish(Image& picture, int index) const;
  /// The same onto any canvas of the picture's size.
  void draw_overlay(Canvas& canvas, int index) const;

 private:
  std::vector<Colour> cell_colours(const record::Frame& frame, float alpha) const;
  std::vector<Colour> node_colours(const record::Frame& frame) const;
  void draw_captions(Canvas& canvas, int index) const;
  const std::string& event_at(int index) const;

  const record::Trajectory& run_;
  MovieStyle style_;
  std::optional<ColourBar> bar_;
  FrameLayout layout_;
  Framing framing_;
  TopExtent top_;
  double depth_mm_ = 0;  ///< of a push, at its deepest
  double ground_z_mm_ = 0;
};

}  // namespace gridshell::render
