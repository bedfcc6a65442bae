// The text of a canvas, laid out by Pango.
#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <sstream>
#include <string_view>

#include "engine/core/text.h"
#include "render/canvas/canvas.h"
#include "render/canvas/colour_map.h"
#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

// the font family of all text in the process
std::string& font_family() {
  static std::string family = default_font;
  return family;
}

struct Unref {
  void operator()(void* object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

void insert(PangoAttrList* list, PangoAttribute* attribute, guint from, guint to) {
  attribute->start_index = from;
  attribute->end_index = to;
  pango_attr_list_insert(list, attribute);
}

constexpr double least_script = 5;  // points: smallest letters that are readable in print

/// Size and rise of a piece of text over the font's size.
struct ScriptLook {
  double size = 1, rise = 0;
};
ScriptLook look_of(const TextRun& run) {
  if (run.level == 0) return {};
  // the symbol of a cell is smaller, since a box of a letter's size looks like a missing letter
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
      insert(list,
             pango_attr_size_new(
                 int(std::max(look.size * size, std::min(least_script, size)) * PANGO_SCALE)),
             from, to);
      insert(list, pango_attr_rise_new(int(look.rise * size * PANGO_SCALE)), from, to);
    }
    if (run.slanted) insert(list, pango_attr_style_new(PANGO_STYLE_OBLIQUE), from, to);
    from = to;
  }
  return list;
}

Layout make_layout(cairo_t* cairo, const std::string& marked, const TextStyle& style) {
  const std::vector<TextRun> runs = parse_marked(valid_utf8(marked));
  std::string letters;
  for (const TextRun& run : runs) letters += run.text;

  Layout layout(pango_cairo_create_layout(cairo));
  PangoContext* context = pango_layout_get_context(layout.get());
  // at 72 dpi a point of the font is a unit of the canvas
  pango_cairo_context_set_resolution(context, 72);
  cairo_font_options_t* options = cairo_font_options_create();
  // without hinting letters are exactly at their measured positions, at any scale
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

// position of the layout's upper left corner if its anchor is at (0, 0)
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

std::string hex(Colour c) {
  const auto byte = [](float v) { return int(std::lround(255 * std::clamp(v, 0.f, 1.f))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

// an SVG element of a text, each piece of one look at its position; `at` is the layout's upper left
// corner
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

std::string valid_utf8(const std::string& text) {
  if (g_utf8_validate(text.data(), gssize(text.size()), nullptr)) return text;
  const std::unique_ptr<char, decltype(&g_free)> valid(
      g_utf8_make_valid(text.data(), gssize(text.size())), g_free);
  return valid.get();
}

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
    return invalid(
        "[style] font = \"{}\": no font of that name on this machine; `fc-list "
        ": family` lists those that are",
        family);
  font_family() = family;
  return {};
}

Box Canvas::text(const std::string& any, Point anchor, const TextStyle& style) {
  const std::string marked = valid_utf8(any);
  const Layout layout = make_layout(cairo_, marked, style);
  PangoRectangle ink_rectangle, logical_rectangle;
  pango_layout_get_extents(layout.get(), &ink_rectangle, &logical_rectangle);
  const Point at = corner(layout.get(), to_box(logical_rectangle), style);

  const double angle = -style.angle_deg * std::numbers::pi / 180;
  if (keeps_text_) {
    TextStyle shown = style;
    if (on_dark()) shown.colour = text_on_dark(style.colour);
    text_elements_ += text_element(layout.get(), parse_marked(marked), anchor, at, shown, scale_);
  }
  cairo_save(cairo_);
  cairo_translate(cairo_, anchor.x, anchor.y);
  cairo_rotate(cairo_, angle);
  cairo_move_to(cairo_, at.x, at.y);
  if (style.halo.a > 0 && !keeps_text_) {
    pango_cairo_layout_path(cairo_, layout.get());
    paint_path({0, 0, 0, 0}, {on_dark() ? paper_ : style.halo, style.size / 4});
    cairo_move_to(cairo_, at.x, at.y);
  }
  set_colour(on_dark() ? text_on_dark(style.colour) : style.colour);
  if (cairo_surface_get_type(cairo_get_target(cairo_)) == CAIRO_SURFACE_TYPE_IMAGE) {
    // as outlines, since Cairo 1.16 rounds the positions of letters to pixels, 1.18 to quarters
    pango_cairo_layout_path(cairo_, layout.get());
    cairo_fill(cairo_);
  } else if (!keeps_text_) {
    pango_cairo_show_layout(cairo_, layout.get());
  }
  cairo_restore(cairo_);
  cairo_new_path(cairo_);

  // the bounding box of the rotated letters
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
  auto lines = wrapped_marked(plain(text), width, style);
  for (std::string& line : lines) line = without_marks(line);
  return lines;
}

std::vector<std::string> Canvas::wrapped_marked(const std::string& text, double width,
                                                const TextStyle& style) const {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (lines.empty() || measure(longer, style).width > width)
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
    // remove the last letter, which may have several bytes of UTF-8, and the blanks before it
    while (!kept.empty() && (static_cast<unsigned char>(kept.back()) & 0xC0) == 0x80)
      kept.pop_back();
    if (!kept.empty()) kept.pop_back();
    while (!kept.empty() && kept.back() == ' ') kept.pop_back();
    if (measure(plain(kept + "…"), style).width <= width) return kept + "…";
  }
  return "";
}

}  // namespace gridshell::render
