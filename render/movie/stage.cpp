#include "render/movie/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/movie/bins_plot.h"
#include "render/movie/boundary.h"
#include "render/movie/captions.h"

namespace gridshell::render {
namespace {

constexpr double joint_diameter_mm = 3;  // the paper's elastomer joints
constexpr Colour ink{0.1f, 0.1f, 0.12f, 1}, pale_ink{0.38f, 0.39f, 0.42f, 1},
    event_ink{0.70f, 0.10f, 0.08f, 1};

// one scale over the run, from the most that each cell comes to, so that it does not depend on how
// many frames sample the path; a few strongly bent cells at the boundary must not pale the rest
std::optional<ColourBar> bar_of(const record::Trajectory& run, const MovieStyle& style) {
  if (style.colour_by == ColourBy::displacement)
    return ColourBar{"|*u*| / *δ*_{0}", {ColourMap::sequential, 0, 1}};
  if (style.colour_by == ColourBy::none || run.layout.cells.empty()) return std::nullopt;
  Eigen::ArrayXd low = Eigen::ArrayXd::Zero(long(run.layout.cells.size())), high = low;
  for (const record::Frame& frame : run.frames) {
    const Eigen::ArrayXd K = frame.cell_K.array().isFinite().select(frame.cell_K.array(), 0.0);
    low = low.min(K);
    high = high.max(K);
  }
  const Eigen::ArrayXd most = high.max(-low);
  ColourBar bar{"*K*_{□} (rad)", symmetric_scale({most.begin(), most.end()}, 0.9)};
  if (style.K_limit > 0) bar.scale.low = -(bar.scale.high = style.K_limit);
  bar.beyond_low = low.minCoeff() < bar.scale.low;
  bar.beyond_high = high.maxCoeff() > bar.scale.high;
  return bar;
}

// a square around everything that moves or bounds
TopExtent top_extent(const Eigen::Matrix3Xd& points) {
  if (points.cols() == 0) return {};
  const Eigen::Vector3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  return {(low.x() + high.x()) / 2, (low.y() + high.y()) / 2,
          std::max({1e-6, (high.x() - low.x()) / 2, (high.y() - low.y()) / 2})};
}

// how deep a push goes; 0 without one
double deepest(const record::Trajectory& run) {
  double depth = 0;
  for (const record::Frame& frame : run.frames)
    if (frame.depth_mm > depth) depth = frame.depth_mm;
  return depth;
}

// below everything that is drawn in any frame
double lowest_z(const record::Trajectory& run) {
  double lowest = 0;
  bool any = false;
  const auto take = [&](const Eigen::Matrix3Xd& points) {
    if (points.cols() == 0) return;
    const double z = points.row(2).minCoeff();
    lowest = any ? std::min(lowest, z) : z;
    any = true;
  };
  if (!run.frames.empty() && shows_original(run.frames.front())) take(run.layout.original_boundary);
  take(run.layout.actuated_boundary);
  for (const record::Frame& frame : run.frames) take(frame.nodes);
  return lowest;
}

// lines thinner than this many pixels flicker and vanish in a movie
double least_pixels(const MovieStyle& style) {
  // a figure is printed at some 15 pixels a mm, where a hair line needs two
  const double wished = style.quality == Quality::figure ? 2.0 : 1.35;
  return std::max(1.1, wished * std::min(style.height / 720.0, style.width / 1000.0));
}

// one more than the largest node that the layout names
long nodes_named(const record::Layout& layout) {
  int largest = -1;
  for (const std::vector<int>& rod : layout.rods)
    for (int node : rod) largest = std::max(largest, node);
  for (const record::Joint& joint : layout.joints) largest = std::max(largest, joint.node);
  return long(largest) + 1;
}

}  // namespace

Result<void> check_showable(const record::Trajectory& run, const MovieStyle& style) {
  if (style.width < 16 || style.height < 16 || style.width > 16384 || style.height > 16384)
    return fail(Fault::bad_input, fmt::format("a picture of {} x {} pixels cannot be made: both "
                                              "sides must be 16 to 16384",
                                              style.width, style.height));
  if (!(style.zoom > 0)) return fail(Fault::bad_input, "the camera's zoom must be above 0");
  if (run.frames.empty()) return fail(Fault::bad_input, "the run has no frame to show");
  if (run.layout.original_boundary.cols() != run.layout.actuated_boundary.cols())
    return fail(Fault::bad_input, "the run's two boundaries differ in their number of points");
  const long nodes = nodes_named(run.layout), cells = long(run.layout.cells.size());
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const record::Frame& frame = run.frames[k];
    if (frame.nodes.cols() < nodes || !frame.nodes.allFinite())
      return fail(Fault::bad_input,
                  fmt::format("frame {} of the run has {} nodes where {} with finite positions are "
                              "needed",
                              k, frame.nodes.cols(), nodes));
    if (style.colour_by == ColourBy::K && frame.cell_K.size() != cells)
      return fail(Fault::bad_input,
                  fmt::format("frame {} of the run has K of {} cells instead of {}", k,
                              frame.cell_K.size(), cells));
  }
  return {};
}

Stage::Stage(const record::Trajectory& run, const MovieStyle& style)
    : run_(run),
      style_(style),
      bar_(bar_of(run, style)),
      layout_(lay_out_frame(style, bar_ && style.legends ? &*bar_ : nullptr)),
      framing_(extreme_points(run), style, layout_.view),
      top_(top_extent(extreme_points(run))),
      depth_mm_(deepest(run)),
      ground_z_mm_(lowest_z(run) - 0.75 * joint_diameter_mm) {}

Camera Stage::camera(int index) const {
  return framing_.camera(frames() > 1 ? double(index) / (frames() - 1) : 0);
}

std::vector<Colour> Stage::cell_colours(const record::Frame& frame, float alpha) const {
  std::vector<Colour> colours;
  if (!bar_ || style_.colour_by != ColourBy::K) return colours;
  for (double K : frame.cell_K) {
    colours.push_back(bar_->scale(K));
    colours.back().a = alpha;
  }
  return colours;
}

std::vector<Colour> Stage::node_colours(const record::Frame& frame) const {
  std::vector<Colour> colours;
  if (style_.colour_by != ColourBy::displacement) return colours;
  const Eigen::Matrix3Xd& before = run_.frames.front().nodes;
  for (long n = 0; n < frame.nodes.cols(); ++n)
    colours.push_back(
        bar_->scale(depth_mm_ > 0 ? (frame.nodes.col(n) - before.col(n)).norm() / depth_mm_ : 0));
  return colours;
}

Drawing Stage::drawing(int index) const {
  const record::Frame& frame = run_.frames[std::size_t(index)];
  const double thin = least_pixels(style_) / pixels_per_mm();
  Drawing drawing;
  drawing.layout = &run_.layout;
  drawing.nodes = frame.nodes;
  drawing.rod_diameter_mm = std::max(run_.layout.rod_diameter_mm, thin);
  drawing.joint_diameter_mm = std::max(joint_diameter_mm, 1.5 * drawing.rod_diameter_mm);
  drawing.cell_colours = cell_colours(frame, 0.93f);
  drawing.node_colours = node_colours(frame);
  // colours need some width to be seen
  if (!drawing.node_colours.empty()) drawing.rod_diameter_mm *= 1.8;
  // where both boundaries coincide the stronger one hides the fainter
  if (shows_original(frame))
    drawing.rings.push_back(
        {run_.layout.original_boundary, std::max(0.6, thin), {0.66f, 0.67f, 0.7f, 1}});
  drawing.rings.push_back({boundary_at(run_.layout, frame.actuation),
                           std::max(1.4, 1.6 * thin),
                           {0.3f, 0.33f, 0.38f, 1}});
  drawing.ground_z_mm = ground_z_mm_;
  return drawing;
}

const std::string& Stage::event_at(int index) const {
  // an event stays long enough to be read
  static const std::string nothing;
  const int held = std::max(1, int(1.5 * style_.fps));
  for (int k = index; k >= 0 && k > index - held; --k)
    if (!run_.frames[std::size_t(k)].event.empty()) return run_.frames[std::size_t(k)].event;
  return nothing;
}

void Stage::draw_captions(Canvas& canvas, int index) const {
  const record::Frame& frame = run_.frames[std::size_t(index)];
  const double em = layout_.font_size;
  const TextStyle title{.size = 1.15 * em, .colour = ink, .bold = true, .align_y = AlignY::middle};
  const TextStyle line{.size = em, .colour = ink, .align_y = AlignY::middle};
  const TextStyle small{.size = 0.85 * em, .colour = pale_ink, .align_y = AlignY::middle};
  const auto place = [](const Box& box) { return Point{box.x, box.middle().y}; };
  canvas.text(plain(canvas.shortened(style_.title, layout_.title.width, title)),
              place(layout_.title), title);

  // columns of fixed width, so that the words stand still while the numbers run; what does not
  // fit is left out
  double x = layout_.state.x;
  for (const std::string& caption : state_captions(frame)) {
    const double width = canvas.measure(caption, line).width;
    if (x + width > layout_.state.right()) break;
    canvas.text(caption, {x, layout_.state.middle().y}, line);
    x += em * std::ceil(width / em + 1.2);
  }

  TextStyle event = line;
  event.colour = event_ink;
  event.bold = true;
  canvas.text(plain(canvas.shortened(event_at(index), layout_.event.width, event)),
              place(layout_.event), event);
  const std::string count = frame_caption(index, frames());
  const double count_width = canvas.measure(frame_caption(frames() - 1, frames()), line).width;
  if (count_width > layout_.progress.width) return;
  canvas.text(count, place(layout_.progress), line);
  const std::string rest = equilibrium_caption(frame);
  const double rest_x = layout_.progress.x + count_width + 1.2 * em;
  if (rest_x + canvas.measure(rest, small).width <= layout_.progress.right())
    canvas.text(rest, {rest_x, layout_.progress.middle().y}, small);
}

void Stage::draw_overlay(Canvas& canvas, int index) const {
  const record::Frame& frame = run_.frames[std::size_t(index)];
  if (!layout_.title.empty()) draw_captions(canvas, index);
  if (bar_ && !layout_.colour_bar.empty())
    draw_colour_bar(canvas, layout_.colour_bar, *bar_, 0.95 * layout_.font_size);
  if (!layout_.inset.empty()) {
    draw_top_view(canvas, layout_.inset, run_.layout, frame, top_, cell_colours(frame, 1));
    // where the corner beside a round shell has room for it
    const double size = 0.75 * layout_.font_size, gap = 0.3 * size;
    if (layout_.inset.width > 11 * layout_.font_size)
      canvas.text("top", {layout_.inset.x + gap, layout_.inset.y + gap},
                  {.size = size, .colour = pale_ink, .align_y = AlignY::top});
  }
  if (!layout_.plot.empty() && frame.K_bins.rows() > 0)
    draw_plot(canvas, layout_.plot, bins_plot(run_, index, 0.95 * layout_.font_size));
  if (!layout_.scale_bar.empty())
    draw_scale_bar(canvas, layout_.scale_bar, style_.scale_bar_mm, pixels_per_mm(),
                   0.95 * layout_.font_size);
}

void Stage::finish(Image& picture, int index) const {
  draw_over(picture, [&](Canvas& canvas) { draw_overlay(canvas, index); });
}

}  // namespace gridshell::render
