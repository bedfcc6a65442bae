#include "render/movie/movie_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/core/system_info.h"
#include "render/movie/frame_overlay.h"

namespace gridshell::render {

Appearance paper_appearance() {
  Appearance look;
  look.rod = {0, 0, 0, 1};
  look.joint_mm = 0;
  look.ring = {0, 0, 0, 1};
  look.cells = look.floor = look.shadow = look.ghost = false;
  look.sheen = 0;
  return look;
}

std::vector<double> laths_of(const record::Layout& layout, const Appearance& look) {
  if (look.rod_mm != 0) return {};
  std::vector<double> laths = layout.laths_mm;
  if (laths.empty() && look.lath_width_mm > 0)
    for (std::size_t r = 0; r < layout.rods.size(); ++r)
      laths.insert(laths.end(), {look.lath_width_mm, look.lath_thickness_mm});
  return laths;
}

namespace {

void choose(Colour& colour, const std::string& request) {
  if (request == "transparent")
    colour.a = 0;
  else if (!request.empty())  // "#rrggbb", validated by the preset's reader
    colour = hex_colour(std::strtol(request.c_str() + 1, nullptr, 16));
}
void choose(double& width, double request) {
  if (request > 0) width = request;
}
void choose(bool& flag, preset::Visibility request) {
  if (request != preset::Visibility::automatic) flag = request == preset::Visibility::on;
}

ViewDirection direction_of(const preset::Movie& movie) {
  switch (movie.view) {
    case preset::View::free:
    case preset::View::push:  // set by Stage, from the layout
      break;
    case preset::View::front:
      return view_front;
    case preset::View::side:
      return view_side;
    case preset::View::top:
      return view_top;
    case preset::View::corner:
      return view_corner;
  }
  return {movie.azimuth_deg, movie.elevation_deg};
}

/// Whether the boundary moves. The supports of a network may be fixed, and the line through them
/// then has no meaning.
bool boundary_moves(const preset::Preset& preset) {
  if (preset.footprint.kind != preset::FootprintKind::network) return true;
  const double scale = preset.actuation.scale;
  return (scale > 0 && scale != 1) ||
         std::ranges::any_of(preset.footprint.file.supports,
                             [](const auto& support) { return support.size() > 1; }) ||
         std::ranges::any_of(preset.step, [](const preset::Step& step) {
           return step.kind == preset::StepKind::move;
         });
}

// the text in as few lines as possible, all of about equal length
std::string in_lines(const Canvas& canvas, const std::string& text, double width,
                     const TextStyle& style) {
  auto lines = canvas.wrapped(text, width, style);
  for (double narrow = 0, wide = width; wide - narrow > 0.01 * width;) {
    const double middle = 0.5 * (narrow + wide);
    auto other = canvas.wrapped(text, middle, style);
    if (other.size() > lines.size()) {
      narrow = middle;
      continue;
    }
    wide = middle;
    lines = std::move(other);
  }
  std::string all;
  for (const std::string& line : lines) all += (all.empty() ? "" : "\n") + line;
  return all;
}

/// The parameters on the title card: "*n* = 12, *d* = 20 mm, *R*_{o} = 126 mm, computed by
/// gridshell 0.2.0".
std::string parameters_of(const preset::Preset& preset) {
  std::string text;
  const auto add = [&](const char* name, double value, const char* unit) {
    if (value > 0) text += fmt::format("{} = {:.4g}{}, ", name, value, unit);
  };
  const bool circle = preset.footprint.kind == preset::FootprintKind::circle;
  if (circle) add("*n*", preset.footprint.rods, "");
  if (circle || preset.on_net()) add("*d*", preset.footprint.spacing_mm, " mm");
  if (circle) add("*R*_{o}", preset.original_radius_mm(), " mm");
  const bool sphere = preset.on_net() && preset.net.kind == preset::NetKind::sphere;
  if (sphere) add("*ρ*", preset.net.radius_mm, " mm");
  if (sphere && preset.indentation.requested())
    add("*δ*_{0}", preset.indentation.depth * preset.net.radius_mm, " mm");
  return text + "computed by gridshell " + version();
}

constexpr Colour dark_paper{0.075f, 0.085f, 0.1f, 1};

/// The appearance of the theme, changed by the other keys of the style.
Appearance appearance_of(const preset::Style& style) {
  Appearance look = style.theme == preset::Theme::paper ? paper_appearance() : Appearance{};
  if (style.theme == preset::Theme::dark) look.background = dark_paper;
  choose(look.rod_mm, style.rod_width_mm);
  choose(look.joint_mm, style.joint_width_mm);
  choose(look.ring_mm, style.ring_width_mm);
  choose(look.rod, style.rod_colour);
  choose(look.joint, style.joint_colour);
  choose(look.ring, style.ring_colour);
  choose(look.background, style.background);
  look.rod_chosen = !style.rod_colour.empty();
  look.joint_chosen = !style.joint_colour.empty();
  if (is_dark(look.background)) {
    // colours that were not chosen are visible on it and on nearly white cells
    for (const auto& [colour, request] : {std::pair(&look.rod, &style.rod_colour),
                                          {&look.joint, &style.joint_colour},
                                          {&look.ring, &style.ring_colour}})
      if (request->empty()) *colour = line_on_dark({0, 0, 0, 1});
  }
  choose(look.cells, style.cells);
  choose(look.rings, style.rings);
  choose(look.floor, style.floor);
  choose(look.shadow, style.shadow);
  choose(look.loads, style.loads);
  choose(look.braces, style.braces);
  choose(look.ghost, style.ghost);
  if (style.joints == preset::Visibility::off) look.joint_mm = 0;
  if (style.joints == preset::Visibility::on && look.joint_mm == 0)
    look.joint_mm = Appearance{}.joint_mm;
  constexpr ColourMap maps[] = {nullptr, diverging, sequential, grey, diverging_in_print};
  look.map = maps[std::size_t(style.colour_map)];
  look.range = style.range;
  look.far_fade = style.far_fade;
  look.letters = style.letters;
  return look;
}

}  // namespace

MovieStyle movie_style(const preset::Preset& preset) {
  MovieStyle style{preset.movie};
  const ViewDirection from = direction_of(preset.movie);
  style.azimuth_deg = from.azimuth_deg;
  style.elevation_deg = from.elevation_deg;
  style.title = preset.title;
  style.source = preset.source;
  style.description = preset.description;
  style.parameters = parameters_of(preset);
  style.font_scale = preset.style.font_size;
  style.look = appearance_of(preset.style);
  style.look.lath_width_mm = preset.rod.width_mm;
  style.look.lath_thickness_mm = preset.rod.thickness_mm;
  style.look.clamped = preset.ends.kind != preset::EndKind::pinned;
  if (preset.style.rings == preset::Visibility::automatic)
    style.look.rings = style.look.rings && boundary_moves(preset);
  return style;
}

MovieStyle figure_style(const preset::Preset& preset) {
  const preset::Figure& figure = preset.figure;
  MovieStyle style = movie_style(preset);
  style.quality = figure.quality;
  style.scale_bar_mm = figure.scale_bar_mm;
  style.vector = figure.vector;
  style.views.clear();  // panels of figures have one view each, at one scale
  if (!figure.title) style.title.clear();
  style.print.background = style.look.background;
  if (figure.width_mm <= 0) return style;
  style.print = {figure.width_mm, figure.dpi, style.look.background};
  const double aspect = double(style.height()) / style.width();
  const auto pixels = [](double requested) {
    return std::clamp(int(std::lround(requested)), 16, 16384);
  };
  style.size[0] = pixels(figure.width_mm / 25.4 * figure.dpi);
  style.size[1] = pixels(aspect * style.width());
  return style;
}

DrawQuality draw_quality(Quality quality) {
  return {.supersample = quality == Quality::movie ? 2 : 1,
          .shadow = quality != Quality::draft,
          .jittered_passes = quality == Quality::figure ? 24 : 1};
}

DrawQuality draw_quality(const MovieStyle& style) {
  DrawQuality quality = draw_quality(style.quality);
  quality.shadow = quality.shadow && style.look.shadow;
  return quality;
}

Result<Image> title_card(const MovieStyle& style) {
  const double w = style.width(), h = style.height();
  return draw_picture(w, h, 1, style.look.background, [&](Canvas& canvas) {
    TextStyle title{.size = style.font_scale * 0.075 * std::min(h, 0.6 * w),
                    .colour = ink,
                    .bold = true,
                    .align_x = AlignX::centre,
                    .align_y = AlignY::middle};
    std::string text = in_lines(canvas, style.title, 0.84 * w, title);
    for (int k = 0; k < 12; ++k) {
      const Box box = canvas.measure(plain(text), title);
      if (box.width <= 0.9 * w && box.height <= 0.3 * h) break;
      title.size *= 0.9;
      text = in_lines(canvas, style.title, 0.84 * w, title);
    }
    canvas.text(plain(text), {w / 2, 0.36 * h}, title);
    TextStyle more{.size = 0.5 * title.size, .align_x = AlignX::centre, .align_y = AlignY::top};
    const std::string said = in_lines(canvas, style.description, 0.8 * w, more);
    const double high = canvas.measure(plain(said), more).height;
    more.size *= std::min(1.0, 0.22 * h / std::max(1.0, high));
    canvas.text(plain(said), {w / 2, 0.52 * h}, more);
    const TextStyle numbers{.size = 0.45 * title.size,
                            .colour = pale_ink,
                            .align_x = AlignX::centre,
                            .align_y = AlignY::middle};
    canvas.text(style.parameters, {w / 2, 0.79 * h},
                canvas.fitted(style.parameters, 0.9 * w, numbers));
    const TextStyle source{.size = 0.5 * title.size,
                           .colour = pale_ink,
                           .align_x = AlignX::centre,
                           .align_y = AlignY::middle};
    canvas.text(plain(style.source), {w / 2, 0.87 * h},
                canvas.fitted(plain(style.source), 0.9 * w, source));
  });
}

}  // namespace gridshell::render
