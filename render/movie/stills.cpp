#include "render/movie/stills.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "render/canvas/panels.h"
#include "render/canvas/text.h"
#include "render/gl/image.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/run_figures.h"

namespace gridshell::render {
namespace {

/// Number of panels per row, so that they are wide enough in print.
int columns_of(const MovieStyle& style, int panels) {
  constexpr int most = 3;
  constexpr double bar_mm = 15, least_mm = 45;
  const double width_mm = style.print.width_mm;
  const int fit = width_mm > 0 ? std::max(1, int((width_mm - bar_mm) / least_mm)) : most;
  return std::min({panels, most, fit});
}

// the part of a picture around the shell, in pixels, which panels side by side show
Box part_around(const Image& picture, const Box& shell) {
  const double margin = 0.05 * shell.width;
  const int x0 = std::max(0, int(shell.x - margin)), y0 = std::max(0, int(shell.y - margin));
  const int x1 = std::min(picture.width, int(std::ceil(shell.right() + margin)));
  const int y1 = std::min(picture.height, int(std::ceil(shell.bottom() + margin)));
  return {double(x0), double(y0), double(x1 - x0), double(y1 - y0)};
}

Image around(const Image& picture, const Box& shell) {
  const Box box = part_around(picture, shell);
  const int x0 = int(box.x), y0 = int(box.y);
  Image part(int(box.width), int(box.height));
  for (int y = 0; y < part.height; ++y)
    std::copy_n(picture.pixel(x0, y0 + y), 4 * std::size_t(part.width), part.pixel(0, y));
  return part;
}

// the lines of a complete picture, scaled so that `part` of it fills the panel
std::function<void(Canvas&, const Box&)> lines_around(
    std::function<void(Canvas&, const Box&)> lines, const MovieStyle& style, const Box& part) {
  return [=, width = style.width(), height = style.height()](Canvas& canvas, const Box& box) {
    const double scale = box.width / part.width;
    canvas.clipped(box, [&] {
      lines(canvas,
            {box.x - scale * part.x, box.y - scale * part.y, scale * width, scale * height});
    });
  };
}

/// Factor by which a shell needs more pixels in its panel than in its still, for the printed width
/// of the figure; 1: no more.
double panel_scale(const Stage& stage, int columns) {
  constexpr double most = 4, around_panels = 1.1;
  const MovieStyle& style = stage.style();
  const double printed = style.print.width_mm * style.print.dpi / 25.4 / (around_panels * columns);
  const double scale = printed / std::max(1.0, 1.1 * stage.shell_box().width);
  return scale > 1.1 ? std::min(scale, most) : 1;
}

/// The caption with the frame's interpenetrations and loads, since a panel has no legend for them.
std::string with_marks(const std::string& caption, const record::Frame& frame,
                       const Appearance& look) {
  const std::string contacts = contact_caption(frame),
                    loads = look.loads ? load_caption(frame) : "";
  return caption + (contacts.empty() ? "" : ", " + contacts) + (loads.empty() ? "" : "\n" + loads);
}

}  // namespace

MovieStyle still_style(MovieStyle style) {
  style.captions = false;
  style.heading = true;
  style.inset = false;
  style.turn_deg = 0;
  return style;
}

void draw_still_labels(Canvas& canvas, const Stage& stage, const ShownFrame& shown,
                       std::string caption) {
  // the caption has one row
  if (const auto end = caption.find('\n'); end != std::string::npos) caption.replace(end, 1, ": ");
  if (const auto ghost = stage.ghost_caption(shown.frame); !ghost.empty()) caption += ", " + ghost;
  stage.draw_overlay(canvas, shown);
  const FrameLayout& layout = stage.layout();
  const Box& room = layout.heading;
  const double line = room.height / (1 + std::max(1.0, double(layout.title_lines.size())));
  TextStyle title = title_style(stage.style(), layout.font_size);
  title.align_y = AlignY::top;
  for (std::size_t k = 0; k < layout.title_lines.size(); ++k)
    canvas.text(plain(layout.title_lines[k]), {room.x, room.y + double(k) * line}, title);
  const TextStyle text{.size = layout.font_size, .align_y = AlignY::top};
  const TextStyle fitted = canvas.fitted(caption, room.width, text);
  const Box said = canvas.text(caption, {room.x, room.bottom() - line}, fitted);
  // loads and interpenetrations have a row each, the latter with the mark that they have in the
  // picture
  const double size = fitted.size;
  double y = said.bottom() + size;
  if (const auto loads = load_caption(shown.frame); !loads.empty() && stage.style().look.loads) {
    canvas.text(loads, {room.x, y},
                canvas.fitted(loads, room.width, {.size = size, .align_y = AlignY::middle}));
    y += 1.3 * size;
  }
  const std::string contacts = contact_caption(shown.frame);
  if (contacts.empty()) return;
  canvas.marker(Marker::circle, {room.x + 0.5 * size, y}, 0.8 * size, contact_ink, {{}, 0});
  canvas.text(
      contacts, {room.x + 1.4 * size, y},
      {.size = size, .colour = contact_ink, .align_y = AlignY::middle, .halo = {1, 1, 1, 1}});
}

std::string frame_state_caption(const record::Frame& frame) {
  return state_captions(frame).front();
}

std::string unpushed_caption(const record::Frame& frame) {
  record::Frame head = record::without_nodes(frame);
  head.depth_mm = head.force_N = record::unknown;
  return frame_state_caption(head);
}

Result<std::vector<std::filesystem::path>> write_stills(
    const record::Trajectory& run, const MovieStyle& movie_style,
    const std::optional<ColourBar>& bar, Renderer& renderer, const std::filesystem::path& stem,
    Watch& watch, const std::vector<std::string>& captions, const record::Frame* origin) {
  const MovieStyle style = still_style(movie_style);
  TRY_DO(check_showable(run, style));
  if (stem.has_parent_path()) TRY_DO(make_folder(stem.parent_path()));
  const Stage stage(run.layout, summarise_run(run, origin), style, bar);
  PanelFigure figure = empty_figure(style, columns_of(style, stage.frames()));
  figure.scale_bar_mm = stage.style().scale_bar_mm;
  figure.pixels_per_mm = stage.pixels_per_mm();
  figure.colour_bar = stage.colour_bar();
  figure.arrow = stage.arrow_key();
  // in a printed figure a panel may need more pixels than the shell has in its still
  MovieStyle larger = style;
  const double enlarged = panel_scale(stage, figure.columns);
  for (int& side : larger.size) side = int(std::lround(enlarged * side));
  std::optional<Stage> panels;
  if (enlarged > 1) {
    panels.emplace(run.layout, RunSummary(stage.survey()), larger, bar);
    figure.pixels_per_mm = panels->pixels_per_mm();
  }
  const double dpi = style.print.width_mm > 0 ? style.print.dpi : 0;
  std::vector<std::filesystem::path> files;
  for (int k = 0; k < stage.frames(); ++k) {
    if (watch.cancelled())
      return fail(Fault::cancelled, "stopped after {} of {} stills", k, stage.frames());
    const record::Frame& frame = run.frames[std::size_t(k)];
    const std::string caption =
        captions.empty() ? frame_state_caption(frame) : captions[std::size_t(k)];
    TRY(picture, stage.draw_views(renderer, {frame, k}));
    const Stage& shown = panels ? *panels : stage;
    Image panel = *picture;
    if (panels) {
      TRY(sharp, panels->draw_views(renderer, {frame, k}));
      panel = std::move(*sharp);
    }
    figure.panels.push_back({around(panel, shown.shell_box()),
                             stage.frames() > 1 ? panel_letter(style, std::size_t(k)) : "",
                             with_marks(caption, frame, style.look)});
    if (const auto ghost = stage.ghost_key(frame); ghost && figure.keys.empty())
      figure.keys = {*ghost};
    if (style.vector)
      figure.panels.back().lines =
          lines_around(shell_lines(shown.drawing(frame), shown.camera(k)), shown.style(),
                       part_around(panel, shown.shell_box()));
    draw_over(*picture, [&](Canvas& canvas) {
      canvas.set_paper(style.look.background);
      draw_still_labels(canvas, stage, {frame, k}, caption);
    });
    files.push_back(std::filesystem::path(stem) += fmt::format("_{}.png", k + 1));
    TRY_DO(write_png(*picture, files.back(), dpi));
    watch.report(double(k + 1) / (stage.frames() + 1));
  }
  files.push_back(std::filesystem::path(stem) += ".png");
  TRY_DO(write_panels(figure, files.back(), dpi));
  watch.report(1);
  return files;
}

}  // namespace gridshell::render
