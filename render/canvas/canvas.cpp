#include "render/canvas/canvas.h"

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string_view>
#include <utility>

#include "engine/core/text.h"
#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

// of the process, as fontconfig's choice is
std::string& font_family() {
  static std::string family = default_font;
  return family;
}

struct Unref {
  void operator()(void* object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

void set_colour(cairo_t* cairo, Colour c) { cairo_set_source_rgba(cairo, c.r, c.g, c.b, c.a); }

void insert(PangoAttrList* list, PangoAttribute* attribute, guint from, guint to) {
  attribute->start_index = from;
  attribute->end_index = to;
  pango_attr_list_insert(list, attribute);
}

/// Size and rise of a piece of text, over those of the whole.
struct ScriptLook {
  double size = 1, rise = 0;
};
ScriptLook look_of(const TextRun& run) {
  if (run.level == 0) return {};
  // the sign of a cell is small and near the line: a letter's box looks like a missing letter
  if (run.text == "□") return {0.72 * script_size, -0.5 * lowered_by};
  return {script_size, run.level > 0 ? raised_by : -lowered_by};
}

PangoAttrList* attributes(const std::vector<TextRun>& runs, double size) {
  PangoAttrList* list = pango_attr_list_new();
  guint from = 0;
  for (const TextRun& run : runs) {
    const guint to = from + static_cast<guint>(run.text.size());
    if (run.level != 0) {
      const ScriptLook look = look_of(run);
      insert(list, pango_attr_size_new(int(look.size * size * PANGO_SCALE)), from, to);
      insert(list, pango_attr_rise_new(int(look.rise * size * PANGO_SCALE)), from, to);
    }
    if (run.slanted) insert(list, pango_attr_style_new(PANGO_STYLE_OBLIQUE), from, to);
    from = to;
  }
  return list;
}

Layout make_layout(cairo_t* cairo, const std::string& marked, const TextStyle& style) {
  // Pango asserts on text that is no UTF-8; a user's title may be anything
  std::string safe = marked;
  if (!g_utf8_validate(safe.data(), gssize(safe.size()), nullptr)) {
    char* valid = g_utf8_make_valid(safe.data(), gssize(safe.size()));
    safe = valid;
    g_free(valid);
  }
  const std::vector<TextRun> runs = parse_marked(safe);
  std::string letters;
  for (const TextRun& run : runs) letters += run.text;

  Layout layout(pango_cairo_create_layout(cairo));
  PangoContext* context = pango_layout_get_context(layout.get());
  // at 72 dpi a point of the font is a unit of the canvas
  pango_cairo_context_set_resolution(context, 72);
  cairo_font_options_t* options = cairo_font_options_create();
  // no hinting: letters stand where they are measured, at any scale
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  pango_cairo_context_set_font_options(context, options);
  cairo_font_options_destroy(options);
  pango_context_set_round_glyph_positions(context, FALSE);

  PangoFontDescription* font = pango_font_description_new();
  pango_font_description_set_family(font, font_family().c_str());
  pango_font_description_set_size(font, int(style.size * PANGO_SCALE));
  if (style.bold) pango_font_description_set_weight(font, PANGO_WEIGHT_BOLD);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  pango_layout_set_alignment(layout.get(), style.align_x == AlignX::left     ? PANGO_ALIGN_LEFT
                                           : style.align_x == AlignX::centre ? PANGO_ALIGN_CENTER
                                                                             : PANGO_ALIGN_RIGHT);
  pango_layout_set_text(layout.get(), letters.data(), int(letters.size()));
  PangoAttrList* list = attributes(runs, style.size);
  pango_layout_set_attributes(layout.get(), list);
  pango_attr_list_unref(list);
  return layout;
}

Box to_box(const PangoRectangle& r) {
  const double s = PANGO_SCALE;
  return {r.x / s, r.y / s, r.width / s, r.height / s};
}

// where the layout's upper left corner lies when its anchor is at (0, 0)
Point corner(PangoLayout* layout, const Box& logical, const TextStyle& style) {
  Point p;
  if (style.align_x == AlignX::centre) p.x = -logical.width / 2;
  if (style.align_x == AlignX::right) p.x = -logical.width;
  if (style.align_y == AlignY::middle) p.y = -logical.height / 2;
  if (style.align_y == AlignY::bottom) p.y = -logical.height;
  if (style.align_y == AlignY::baseline)
    p.y = -double(pango_layout_get_baseline(layout)) / PANGO_SCALE;
  return p;
}

}  // namespace

Result<void> use_font(const std::string& family) {
  if (family.empty()) {
    font_family() = default_font;
    return {};
  }
  PangoFontFamily** families = nullptr;
  int count = 0;
  pango_font_map_list_families(pango_cairo_font_map_get_default(), &families, &count);
  const bool there = std::any_of(families, families + count, [&](PangoFontFamily* one) {
    return family == pango_font_family_get_name(one);
  });
  g_free(families);
  if (!there)
    return fail(Fault::bad_input,
                fmt::format("[style] font = \"{}\": no font of that name on this machine; `fc-list "
                            ": family` lists those that are",
                            family));
  font_family() = family;
  return {};
}

bool Box::contains(const Box& b) const {
  const double e = 1e-6;
  return b.x >= x - e && b.y >= y - e && b.right() <= right() + e && b.bottom() <= bottom() + e;
}

bool Box::overlaps(const Box& b) const {
  const double e = 1e-6;
  if (empty() || b.empty()) return false;
  return b.x < right() - e && x < b.right() - e && b.y < bottom() - e && y < b.bottom() - e;
}

Box Box::inset(double margin) const {
  return {x + margin, y + margin, std::max(0.0, width - 2 * margin),
          std::max(0.0, height - 2 * margin)};
}

PlanView::PlanView(const Box& box, const Eigen::MatrixXd& points) : at(box.middle()) {
  const Eigen::Vector2d low = points.topRows<2>().rowwise().minCoeff(),
                        high = points.topRows<2>().rowwise().maxCoeff();
  middle = 0.5 * (low + high);
  scale = std::min(box.width / (high - low).x(), box.height / (high - low).y());
}

std::vector<Point> PlanView::line(const Eigen::MatrixXd& points) const {
  std::vector<Point> placed;
  for (const auto& point : points.colwise()) placed.push_back((*this)(point));
  return placed;
}

Canvas::Canvas(cairo_t* cairo, double width, double height)
    : cairo_(cairo), width_(width), height_(height) {
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
}

Canvas::~Canvas() {
  if (on_finished) on_finished(*this);
}

void Canvas::paint_path(Colour fill, const Stroke& stroke) {
  if (fill.a > 0) {
    set_colour(cairo_, fill);
    cairo_fill_preserve(cairo_);
  }
  if (stroke.width > 0 && stroke.colour.a > 0) {
    set_colour(cairo_, stroke.colour);
    cairo_set_line_width(cairo_, stroke.width);
    cairo_set_dash(cairo_, stroke.dash.data(), int(stroke.dash.size()), 0);
    cairo_stroke_preserve(cairo_);
  }
  cairo_new_path(cairo_);
}

void Canvas::polyline(const std::vector<Point>& points, const Stroke& stroke, bool closed) {
  if (points.size() < 2) return;
  for (const Point& p : points) cairo_line_to(cairo_, p.x, p.y);
  if (closed) cairo_close_path(cairo_);
  paint_path({0, 0, 0, 0}, stroke);
}

void Canvas::polygon(const std::vector<Point>& points, Colour fill, const Stroke& stroke) {
  if (points.size() < 3) return;
  for (const Point& p : points) cairo_line_to(cairo_, p.x, p.y);
  cairo_close_path(cairo_);
  paint_path(fill, stroke);
}

void Canvas::rectangle(const Box& box, Colour fill, const Stroke& stroke, double corner_radius) {
  const double r = std::min({corner_radius, box.width / 2, box.height / 2}),
               quarter = std::numbers::pi / 2;
  if (r > 0) {
    cairo_arc(cairo_, box.right() - r, box.y + r, r, -quarter, 0);
    cairo_arc(cairo_, box.right() - r, box.bottom() - r, r, 0, quarter);
    cairo_arc(cairo_, box.x + r, box.bottom() - r, r, quarter, 2 * quarter);
    cairo_arc(cairo_, box.x + r, box.y + r, r, 2 * quarter, 3 * quarter);
    cairo_close_path(cairo_);
  } else {
    cairo_rectangle(cairo_, box.x, box.y, box.width, box.height);
  }
  paint_path(fill, stroke);
}

void Canvas::circle(Point centre, double radius, Colour fill, const Stroke& stroke) {
  cairo_new_sub_path(cairo_);
  cairo_arc(cairo_, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  cairo_close_path(cairo_);
  paint_path(fill, stroke);
}

void Canvas::marker(Marker kind, Point p, double size, Colour fill, const Stroke& stroke) {
  const double h = size / 2;
  const Box ink{p.x - h, p.y - h, size, size};
  if (kind != Marker::none && (clip_.empty() || clip_.overlaps(ink)))
    markers_.push_back(scaled(ink));
  switch (kind) {
    case Marker::none:
      return;
    case Marker::circle:
      return circle(p, h, fill, stroke);
    case Marker::square:
      return rectangle({p.x - 0.88 * h, p.y - 0.88 * h, 1.76 * h, 1.76 * h}, fill, stroke);
    case Marker::diamond:
      return polygon(
          {{p.x, p.y - 1.2 * h}, {p.x + 1.2 * h, p.y}, {p.x, p.y + 1.2 * h}, {p.x - 1.2 * h, p.y}},
          fill, stroke);
    case Marker::triangle:
      return polygon(
          {{p.x, p.y - 1.15 * h}, {p.x + 1.1 * h, p.y + 0.75 * h}, {p.x - 1.1 * h, p.y + 0.75 * h}},
          fill, stroke);
    case Marker::cross: {
      // a cross has no inside: it is drawn in the marker's own colour
      const Stroke bar{fill, std::max(stroke.width, size / 5), {}};
      line({p.x - 0.8 * h, p.y - 0.8 * h}, {p.x + 0.8 * h, p.y + 0.8 * h}, bar);
      return line({p.x - 0.8 * h, p.y + 0.8 * h}, {p.x + 0.8 * h, p.y - 0.8 * h}, bar);
    }
  }
}

namespace {

std::string hex(Colour c) {
  const auto byte = [](float v) { return int(std::lround(255 * std::clamp(v, 0.f, 1.f))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

// every piece of one look in its place, `at` being the layout's upper left corner
std::string text_element(PangoLayout* layout, const std::vector<TextRun>& runs, Point anchor,
                         Point at, const TextStyle& style, double scale) {
  std::string spans;
  PangoLayoutIter* iter = pango_layout_get_iter(layout);
  const std::string_view letters = pango_layout_get_text(layout);
  do {
    const PangoLayoutRun* run = pango_layout_iter_get_run_readonly(iter);
    if (!run) continue;
    PangoRectangle logical;
    pango_layout_iter_get_run_extents(iter, nullptr, &logical);
    const std::size_t from = std::size_t(run->item->offset),
                      length = std::size_t(run->item->length);
    std::size_t begin = 0, index = 0;
    while (index + 1 < runs.size() && begin + runs[index].text.size() <= from)
      begin += runs[index++].text.size();
    const TextRun piece = runs.empty() ? TextRun{} : runs[index];
    const ScriptLook look = look_of(piece);
    const double y = at.y + double(pango_layout_iter_get_baseline(iter)) / PANGO_SCALE;
    spans += fmt::format("<tspan x=\"{:.3f}\" y=\"{:.3f}\" font-size=\"{:.3f}\"{}>{}</tspan>",
                         at.x + double(logical.x) / PANGO_SCALE, y - look.rise * style.size,
                         look.size * style.size, piece.slanted ? " font-style=\"oblique\"" : "",
                         escape_xml(letters.substr(from, length)));
  } while (pango_layout_iter_next_run(iter));
  pango_layout_iter_free(iter);
  const std::string halo =
      style.halo.a > 0 ? fmt::format(
                             " stroke=\"{}\" stroke-opacity=\"{:.3g}\" stroke-width=\"{:.3f}\" "
                             "paint-order=\"stroke\"",
                             hex(style.halo), style.halo.a, style.size / 4)
                       : "";
  return fmt::format(
      "<text transform=\"scale({:.5g}) translate({:.3f} {:.3f}) rotate({:.3f})\" "
      "font-family=\"{}, sans-serif\"{} fill=\"{}\" fill-opacity=\"{:.3g}\"{} "
      "xml:space=\"preserve\">{}</text>\n",
      scale, anchor.x, anchor.y, -style.angle_deg, escape_xml(font_family()),
      style.bold ? " font-weight=\"bold\"" : "", hex(style.colour), style.colour.a, halo, spans);
}

}  // namespace

Box Canvas::text(const std::string& marked, Point anchor, const TextStyle& style) {
  const Layout layout = make_layout(cairo_, marked, style);
  PangoRectangle ink_rectangle, logical_rectangle;
  pango_layout_get_extents(layout.get(), &ink_rectangle, &logical_rectangle);
  const Point at = corner(layout.get(), to_box(logical_rectangle), style);

  const double angle = -style.angle_deg * std::numbers::pi / 180;
  if (keeps_text_)
    text_elements_ += text_element(layout.get(), parse_marked(marked), anchor, at, style, scale_);
  cairo_save(cairo_);
  cairo_translate(cairo_, anchor.x, anchor.y);
  cairo_rotate(cairo_, angle);
  cairo_move_to(cairo_, at.x, at.y);
  if (style.halo.a > 0 && !keeps_text_) {
    pango_cairo_layout_path(cairo_, layout.get());
    paint_path({0, 0, 0, 0}, {style.halo, style.size / 4});
    cairo_move_to(cairo_, at.x, at.y);
  }
  set_colour(cairo_, style.colour);
  if (!keeps_text_) pango_cairo_show_layout(cairo_, layout.get());
  cairo_restore(cairo_);
  cairo_new_path(cairo_);

  // the turned ink's bounding box
  const Box ink = to_box(ink_rectangle);
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;
  for (double x : {at.x + ink.x, at.x + ink.right()})
    for (double y : {at.y + ink.y, at.y + ink.bottom()}) {
      const double px = anchor.x + x * std::cos(angle) - y * std::sin(angle);
      const double py = anchor.y + x * std::sin(angle) + y * std::cos(angle);
      x0 = std::min(x0, px), x1 = std::max(x1, px), y0 = std::min(y0, py), y1 = std::max(y1, py);
    }
  const Box turned{x0, y0, x1 - x0, y1 - y0};
  texts_.push_back(without_marks(marked));
  text_boxes_.push_back(scaled(turned));
  return turned;
}

Box Canvas::measure(const std::string& marked, const TextStyle& style) const {
  const Layout layout = make_layout(cairo_, marked, style);
  PangoRectangle logical;
  pango_layout_get_extents(layout.get(), nullptr, &logical);
  const Box box = to_box(logical);
  const Point at = corner(layout.get(), box, style);
  return {at.x, at.y, box.width, box.height};
}

TextStyle Canvas::fitted(const std::string& marked, double width, TextStyle style,
                         double least) const {
  style.size *= std::clamp(width / std::max(1.0, measure(marked, style).width), least, 1.0);
  return style;
}

std::vector<std::string> Canvas::wrapped(const std::string& text, double width,
                                         const TextStyle& style) const {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (lines.empty() || measure(plain(longer), style).width > width)
      lines.push_back(word);
    else
      lines.back() = longer;
  }
  return lines;
}

std::string Canvas::shortened(const std::string& text, double width, const TextStyle& style) const {
  if (measure(plain(text), style).width <= width) return text;
  std::string kept = text;
  while (!kept.empty()) {
    // take a whole UTF-8 letter off the end, and the blanks before it
    while (!kept.empty() && (static_cast<unsigned char>(kept.back()) & 0xC0) == 0x80)
      kept.pop_back();
    if (!kept.empty()) kept.pop_back();
    while (!kept.empty() && kept.back() == ' ') kept.pop_back();
    if (measure(plain(kept + "…"), style).width <= width) return kept + "…";
  }
  return "";
}

void Canvas::picture(const Image& image, const Box& box) {
  if (image.width < 1 || image.height < 1) return;
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height);
  unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height; ++y)
    premultiply(image.pixel(0, y), data + std::size_t(y) * stride, image.width);
  cairo_surface_mark_dirty(surface);
  cairo_save(cairo_);
  cairo_translate(cairo_, box.x, box.y);
  cairo_scale(cairo_, box.width / image.width, box.height / image.height);
  cairo_set_source_surface(cairo_, surface, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo_), CAIRO_FILTER_GOOD);
  cairo_rectangle(cairo_, 0, 0, image.width, image.height);
  cairo_fill(cairo_);
  cairo_restore(cairo_);
  cairo_surface_destroy(surface);
}

void Canvas::enlarged(double scale, const std::function<void()>& inside) {
  const double before = scale_;
  cairo_save(cairo_);
  cairo_scale(cairo_, scale, scale);
  scale_ *= scale;
  inside();
  scale_ = before;
  cairo_restore(cairo_);
}

void Canvas::clipped(const Box& box, const std::function<void()>& inside) {
  cairo_save(cairo_);
  cairo_rectangle(cairo_, box.x, box.y, box.width, box.height);
  cairo_clip(cairo_);
  const Box before = std::exchange(clip_, box);
  inside();
  clip_ = before;
  cairo_restore(cairo_);
}

}  // namespace gridshell::render
