#include "render/movie/stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/try.h"
#include "render/gl/laths.h"
#include "render/movie/run_plots.h"

namespace gridshell::render {
namespace {

constexpr Colour load_ink{0.05f, 0.05f, 0.06f, 1}, mark_ink{0.98f, 0.76f, 0.10f, 1},
    original_ink{0.66f, 0.67f, 0.7f, 1};

// the style with a scale bar that fits the shell and, if it is to show a push, a camera from the
// side, so that a pushed joint moves in the picture's plane; of the two sides the one nearer to the
// style's azimuth
MovieStyle fitted_to(const record::Layout& layout, MovieStyle style) {
  style.scale_bar_mm = fitted_scale_bar(style.scale_bar_mm, layout.length_scale_mm);
  if (style.view != preset::View::push) return style;
  constexpr double elevation_deg = 18, least_slope = 0.05;
  style.elevation_deg = elevation_deg;
  style.turn_deg = 0;
  for (const record::LoadedJoint& load : layout.loaded_joints) {
    if (load.direction.head<2>().norm() < least_slope) continue;
    const double across =
        std::atan2(load.direction.y(), load.direction.x()) * 180 / std::numbers::pi + 90;
    style.azimuth_deg = across + 180 * std::round((style.azimuth_deg - across) / 180);
    break;
  }
  return style;
}

// the rods of a ghost, with a few nodes between two joints
std::vector<std::vector<int>> thinned_rods(const record::Layout& layout) {
  constexpr double points = 4;
  std::vector<std::vector<int>> rods;
  const std::size_t stretches = 2 * layout.joints.size() + layout.rods.size();
  std::size_t edges = 0;
  for (const auto& rod : layout.rods) edges += rod.size();
  const auto stride = std::size_t(std::max(1.0, double(edges) / (points * double(stretches))));
  for (const auto& rod : layout.rods) {
    std::vector<int>& thin = rods.emplace_back();
    for (std::size_t k = 0; k < rod.size(); ++k)
      if (k % stride == 0 || k + 1 == rod.size()) thin.push_back(rod[k]);
  }
  return rods;
}

// Height of the ground: the plane of the supports, unless the shell reaches far below it; then
// below all of the shell. (The plate is open, so that a shell may be a little below it.)
double ground_of(const RunSummary& survey, const record::Layout& layout, const Appearance& look) {
  constexpr double most_dip = 0.15;  // of the length scale
  const bool on_supports =
      layout.actuated_boundary.cols() > 0 &&
      survey.support_z_mm - survey.lowest_z_mm < most_dip * layout.length_scale_mm;
  return on_supports ? survey.support_z_mm - 0.5 * look.ring_mm
                     : survey.lowest_z_mm - 0.75 * std::max(look.joint_mm, 3.0);
}

// the square around all points
TopExtent top_extent(const Eigen::Matrix3Xd& points) {
  if (points.cols() == 0) return {};
  const Eigen::Vector3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  return {(low.x() + high.x()) / 2, (low.y() + high.y()) / 2,
          std::max({1e-6, (high.x() - low.x()) / 2, (high.y() - low.y()) / 2})};
}

// smallest width of a rod in pixels: thin enough for a large net, thick enough to be visible
double least_pixels(const MovieStyle& style) {
  return std::max(1.1, 1.5 * std::min(style.height() / 720.0, style.width() / 1000.0));
}

// whether the values are those of Frame::cell_K
bool by_K(ColourBy by) { return by == ColourBy::K || by == ColourBy::K_change; }

// the panels of views, in columns of equal width; a single view has the complete picture, so that
// the ground extends under the captions
std::vector<Box> panels_of(const FrameLayout& layout, const MovieStyle& style) {
  const int count = 1 + int(style.views.size());
  if (count == 1) return {{0, 0, double(style.width()), double(style.height())}};
  std::vector<Box> panels;
  const Box& view = layout.view;
  for (int k = 0; k < count; ++k) {
    const double from = std::round(view.x + view.width * k / count);
    const double to = std::round(view.x + view.width * (k + 1) / count);
    panels.push_back({from, std::round(view.y), to - from, std::floor(view.height)});
  }
  return panels;
}

std::vector<Framing> framings_of(const std::vector<Box>& panels, const Box& view,
                                 const Eigen::Matrix3Xd& points, const MovieStyle& style) {
  if (panels.size() == 1) return {Framing(points, style, view)};
  std::vector<Framing> framings;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    MovieStyle one = style;
    one.size = {int(panels[k].width), int(panels[k].height)};
    if (k > 0) {
      one.azimuth_deg = style.views[k - 1][0];
      one.elevation_deg = style.views[k - 1][1];
    }
    const double margin = 0.04 * panels[k].width;
    framings.emplace_back(points, one, Box{0, 0, panels[k].width, panels[k].height}.inset(margin));
  }
  return framings;
}

// fills everything outside the box with one colour
void clear_outside(Image& image, const Box& box, Colour colour) {
  const auto byte = [](float c) { return std::uint8_t(std::lround(255 * c)); };
  const std::uint8_t rgba[] = {byte(colour.r), byte(colour.g), byte(colour.b), byte(colour.a)};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (x < box.x || x >= box.right() || y < box.y || y >= box.bottom())
        std::copy_n(rgba, 4, image.pixel(x, y));
}

// the caption in one line if it fits, else in two, divided after an event or between words
std::vector<std::string> lines_of_event(const Canvas& canvas, const std::string& said, double width,
                                        const TextStyle& style) {
  if (canvas.measure(plain(said), style).width <= width) return {said};
  if (const auto end = said.rfind("; "); end != said.npos)
    return {said.substr(0, end + 1), said.substr(end + 2)};
  auto lines = canvas.wrapped(said, width, style);
  for (; lines.size() > 2; lines.pop_back()) lines[lines.size() - 2] += " " + lines.back();
  return lines;
}

}  // namespace

Result<void> check_size(const MovieStyle& style) {
  if (style.width() < 16 || style.height() < 16 || style.width() > 16384 || style.height() > 16384)
    return invalid("size: got {} x {} pixels, expected 16 to 16384 for both", style.width(),
                   style.height());
  if (!(style.zoom > 0)) return invalid("[movie] zoom: expected above 0");
  return {};
}

Result<void> check_frame(const record::Layout& layout, const record::Frame& frame, int at,
                         const MovieStyle& style) {
  const long nodes = node_count_of(layout), cells = long(layout.cells.size());
  if (frame.nodes.cols() < nodes || !frame.nodes.allFinite())
    return invalid("frame {} of the run: got {} nodes, expected {} with finite positions", at,
                   frame.nodes.cols(), nodes);
  if (by_K(style.colour_by) && frame.cell_K.size() != cells)
    return invalid("frame {} of the run: got K of {} cells, expected {}", at, frame.cell_K.size(),
                   cells);
  return {};
}

Result<void> check_coloured(const RunSummary& survey, const MovieStyle& style) {
  if (!may_be_missing(style.colour_by) || survey.spread(style.colour_by).all.any()) return {};
  return missing_values_error(style.colour_by);
}

Result<void> check_showable(const record::Trajectory& run, const MovieStyle& style) {
  TRY_DO(check_size(style));
  if (run.frames.empty()) return invalid("the run has no frame to show");
  if (run.layout.original_boundary.cols() != run.layout.actuated_boundary.cols())
    return invalid("the run's two boundaries differ in their number of points");
  for (std::size_t k = 0; k < run.frames.size(); ++k)
    TRY_DO(check_frame(run.layout, run.frames[k], int(k), style));
  const ColourBy by = style.colour_by;
  if (!may_be_missing(by)) return {};
  for (const record::Frame& frame : run.frames)
    if (coloured_values(by, run.layout, frame, {frame}).size() > 0) return {};
  return missing_values_error(by);
}

Stage::Stage(const record::Layout& layout, RunSummary survey, const MovieStyle& style,
             const std::optional<ColourBar>& shared)
    : run_(layout),
      survey_(std::move(survey)),
      style_(fitted_to(layout, style)),
      progress_(survey_.progress()),
      bar_(shared ? shared : colour_bar_of({&survey_}, style_)),
      layout_(lay_out_frame(style_, bar_ && style_.legends ? &*bar_ : nullptr,
                            {style_.look.loads && survey_.largest_load_N > 0,
                             arrow_key().has_value(), survey_.any_contacts})),
      panels_(panels_of(layout_, style_)),
      framings_(framings_of(panels_, layout_.view, survey_.bounds(), style_)),
      top_(top_extent(survey_.bounds())),
      ground_z_mm_(ground_of(survey_, layout, style_.look)) {}

Stage::Stage(const record::Trajectory& run, const MovieStyle& style)
    : Stage(run.layout, summarise_run(run), style) {}

Camera Stage::camera(int at) const { return framings_.front().camera(moment(at)); }

std::vector<Colour> Stage::colours_of(const record::Frame& frame) const {
  if (!bar_) return {};
  const Eigen::VectorXd values =
      coloured_values(style_.colour_by, run_, frame, {survey_.first, survey_.depth_mm});
  std::vector<Colour> colours;
  for (const double value : values) colours.push_back(bar_->scale(value));
  return colours;
}

std::vector<Colour> Stage::cell_colours(const record::Frame& frame) const {
  if (!of_cells(style_.colour_by) || !style_.look.cells) return {};
  return colours_of(frame);
}

std::vector<Colour> Stage::node_colours(const record::Frame& frame) const {
  if (of_cells(style_.colour_by)) return {};
  auto colours = colours_of(frame);
  // frames of a motion in time have no forces: their rods are grey, and as wide as the others
  if (colours.empty() && bar_)
    colours.assign(std::size_t(frame.nodes.cols()), bar_->scale(record::unknown));
  return colours;
}

std::optional<ArrowKey> Stage::arrow_key() const {
  if (!style_.look.loads || !survey_.arrows_to_scale) return {};
  return render::arrow_key(run_, survey_.largest_load_N);
}

std::optional<ColourKey> Stage::ghost_key(const record::Frame& frame) const {
  constexpr double least = 0.01;  // of the length scale
  // the shell has moved but its boundary has not
  const bool shown = style_.look.ghost && frame.nodes.cols() == survey_.first.nodes.cols() &&
                     frame.actuation == survey_.first.actuation &&
                     survey_.largest_move_mm > least * run_.length_scale_mm &&
                     frame.nodes != survey_.first.nodes;
  if (!shown) return {};
  return ColourKey{ghost_ink, std::isfinite(frame.depth_mm) ? "unloaded" : "first state"};
}

std::string Stage::ghost_caption(const record::Frame& frame) const {
  const auto key = ghost_key(frame);
  return key ? "grey: " + key->name : "";
}

Drawing Stage::drawing(const record::Frame& frame) const {
  const Appearance& look = style_.look;
  const double thin = least_pixels(style_) / pixels_per_mm();
  Drawing drawing;
  drawing.layout = &run_;
  drawing.nodes = frame.nodes;
  drawing.rod_colour = look.rod;
  drawing.rod_diameter_mm = std::max(look.rod_mm > 0 ? look.rod_mm : run_.rod_diameter_mm, thin);
  drawing.joint_colour = look.joint;
  drawing.joint_diameter_mm =
      look.joint_mm > 0 ? std::max(look.joint_mm, 1.5 * drawing.rod_diameter_mm) : 0;
  put_laths(laths_of(run_, look), drawing);
  if (look.rod_chosen || look.rod != Appearance{}.rod) drawing.rod_colour = look.rod;
  drawing.cell_colours = cell_colours(frame);
  drawing.node_colours = node_colours(frame);
  // rods are wider so that their colours are visible
  if (!drawing.node_colours.empty()) drawing.rod_diameter_mm *= 1.8;
  // the actuated boundary is drawn last and covers the original one where they coincide
  if (look.rings) {
    if (original_boundary_shown(frame) && frame.actuation > 0)
      drawing.rings.push_back({run_.original_boundary, std::max(0.6, thin), original_ink, false});
    drawing.rings.push_back(
        {boundary_at(run_, frame.actuation), std::max(look.ring_mm, 1.6 * thin), look.ring});
  }
  if (look.supports && drawing.joint_diameter_mm > 0)
    put_supports(run_, frame, survey_.supported, look, drawing);
  // joints, which shine, would look like interruptions of colours
  if (!drawing.node_colours.empty() && !look.joint_chosen) drawing.joint_diameter_mm = 0;
  if (const auto ghost = ghost_key(frame))
    // behind the moved shell, whose colours it would cover if seen from above
    drawing.ghosts.push_back({survey_.first.nodes, thinned_rods(run_),
                              0.8 * drawing.rod_diameter_mm, ghost->colour,
                              std::max(0.25 * run_.spacing_mm, survey_.largest_move_mm)});
  for (const LoadArrow& arrow : load_arrows(run_, frame)) {
    drawing.arrows.push_back({arrow.from, arrow.to, std::max(1.6, 2.0 * thin), load_ink});
    drawing.marks.push_back({frame.nodes.col(arrow.node), std::max(5.0, 6 * thin), mark_ink});
  }
  if (look.loads) put_loads(run_, frame, survey_.largest_load_N, thin, drawing);
  if (look.braces) put_braces(run_, frame, thin, drawing);
  put_contacts(run_, frame, thin, drawing);
  drawing.ground_z_mm = ground_z_mm_;
  drawing.ground = look.floor && style_.views.empty();
  drawing.background = look.background;
  if (is_dark(look.background)) {
    // the ground is a little lighter than the background
    const auto lighter = [](float c) { return std::lerp(c, 1.f, 0.09f); };
    drawing.ground_colour = {lighter(look.background.r), lighter(look.background.g),
                             lighter(look.background.b)};
  }
  drawing.far_fade = look.far_fade;
  drawing.sheen = look.sheen;
  return drawing;
}

Result<Image> Stage::draw_views(Renderer& renderer, const ShownFrame& shown) const {
  const Drawing drawn = drawing(shown.frame);
  const DrawQuality quality = draw_quality(style_);
  if (panels_.size() == 1) {
    auto picture = renderer.draw(drawn, camera(shown.at), quality, style_.width(), style_.height());
    if (picture) mark_arrows_along_view(*picture, drawn, camera(shown.at));
    // a shell that is larger than its panel ends at the panel's edge
    if (picture && !layout_.view.inset(-1).contains(shell_box()))
      clear_outside(*picture, layout_.view, style_.look.background);
    return picture;
  }
  std::vector<Image> parts;
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    auto part = renderer.draw(drawn, framings_[k].camera(moment(shown.at)), quality,
                              int(panels_[k].width), int(panels_[k].height));
    if (!part) return part;
    mark_arrows_along_view(*part, drawn, framings_[k].camera(moment(shown.at)));
    parts.push_back(std::move(*part));
  }
  return draw_picture(style_.width(), style_.height(), 1, style_.look.background,
                      [&](Canvas& canvas) {
                        for (std::size_t k = 0; k < parts.size(); ++k)
                          canvas.picture(parts[k], panels_[k]);
                      });
}

Result<Image> Stage::draw(Renderer& renderer, const ShownFrame& shown) const {
  auto picture = draw_views(renderer, shown);
  if (picture) finish(*picture, shown);
  return picture;
}

void Stage::draw_captions(Canvas& canvas, const ShownFrame& shown) const {
  const double em = layout_.font_size;
  TextStyle title = title_style(style_, em);
  title.align_y = AlignY::middle;
  const TextStyle line{.size = em, .colour = ink, .align_y = AlignY::middle};
  const std::vector<std::string>& lines = layout_.title_lines;
  const double line_height = layout_.title.height / std::max<double>(1, double(lines.size()));
  for (std::size_t k = 0; k < lines.size(); ++k)
    canvas.text(plain(lines[k]),
                {layout_.title.x, layout_.title.y + (double(k) + 0.5) * line_height}, title);

  // columns of fixed width, so that texts do not move while their numbers change; those that do
  // not fit are left out
  double x = layout_.state.x;
  for (const std::string& caption : state_captions(shown.frame)) {
    const double width = canvas.measure(caption, line).width;
    if (x + width > layout_.state.right()) break;
    canvas.text(caption, {x, layout_.state.middle().y}, line);
    x += em * std::ceil(width / em + 1.2);
  }

  TextStyle event = line;
  event.colour = event_ink;
  event.bold = true;
  const double room = layout_.title.width;
  double y = layout_.event.middle().y;
  const std::string happened = event_caption(shown.frame);
  if (happened.empty()) canvas.text(ghost_caption(shown.frame), {layout_.event.x, y}, line);
  const auto said = lines_of_event(canvas, happened, room, event);
  if (said.size() > 1) event.halo = {1, 1, 1, 0.8f};  // the first of two is over the picture
  for (auto text = said.rbegin(); text != said.rend(); ++text, y -= 1.3 * em)
    canvas.text(plain(canvas.shortened(*text, room, event)), {layout_.event.x, y}, event);
  draw_timeline(canvas, layout_.timeline, survey_.marks, progress_, shown.at, em);
}

void Stage::draw_overlay(Canvas& canvas, const ShownFrame& shown) const {
  if (!layout_.title.empty()) draw_captions(canvas, shown);
  if (bar_ && !layout_.colour_bar.empty())
    draw_colour_bar(canvas, layout_.colour_bar, *bar_, 0.95 * layout_.font_size);
  if (!layout_.inset.empty()) {
    // a name above the inset, if it is large enough
    Box inset = layout_.inset;
    if (inset.width > 11 * layout_.font_size) {
      const double size = 0.75 * layout_.font_size, line = 1.3 * size;
      inset = {inset.x + line, inset.y + line, inset.width - line, inset.height - line};
      canvas.text("top", {inset.x, inset.y},
                  {.size = size, .colour = pale_ink, .align_y = AlignY::bottom});
    }
    draw_top_view(canvas, inset, run_, shown.frame, top_, cell_colours(shown.frame), style_.look);
  }
  if (!layout_.plot.empty() && shown.frame.K_bins.rows() > 0) {
    const double font = 0.95 * layout_.font_size;
    Plot bins = bins_plot(survey_, long(run_.cells.size()), shown.frame, style_.bins_range, font);
    Box above = layout_.plot, below = above;
    // standard deviations are much larger than the change of the means, which is therefore shown
    // below on an axis of its own
    if (style_.colour_by == ColourBy::K_change && above.height > 24 * font) {
      above.height *= 0.62;
      below = {below.x, above.bottom(), below.width, below.height - above.height};
      bins.x.label.clear();
      Plot change = change_plot(survey_, shown.frame, font);
      bins.labels_width = labels_width(canvas, below, change);
      change.labels_width = labels_width(canvas, above, bins);
      draw_plot(canvas, below, change);
    }
    draw_plot(canvas, above, bins);
  }
  if (!layout_.scale_bar.empty())
    draw_scale_bar(canvas, layout_.scale_bar, style_.scale_bar_mm, pixels_per_mm(),
                   0.95 * layout_.font_size);
  if (const auto key = arrow_key(); key && !layout_.arrow_key.empty())
    draw_arrow_key(canvas, layout_.arrow_key, *key, pixels_per_mm(), 0.95 * layout_.font_size);
}

void Stage::finish(Image& picture, const ShownFrame& shown) const {
  draw_over(picture, [&](Canvas& canvas) {
    canvas.set_paper(style_.look.background);
    draw_overlay(canvas, shown);
  });
}

}  // namespace gridshell::render
