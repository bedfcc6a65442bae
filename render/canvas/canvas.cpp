#include "render/canvas/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <numbers>
#include <utility>

#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "render/canvas/colour_map.h"
#include "render/canvas/short_svg.h"
#include "render/canvas/text.h"

namespace gridshell::render {

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
  std::vector<Point> polyline;
  for (const auto& point : points.colwise()) polyline.push_back((*this)(point));
  return polyline;
}

Canvas::Canvas(cairo_t* cairo, double width, double height)
    : cairo_(cairo), width_(width), height_(height) {
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
}

Canvas::~Canvas() {
  if (on_finished) on_finished(*this);
}

void Canvas::set_colour(Colour c) { cairo_set_source_rgba(cairo_, c.r, c.g, c.b, c.a); }

bool Canvas::on_dark() const { return is_dark(paper_); }

void Canvas::paint_path(Colour fill, const Stroke& stroke) {
  if (fill.a > 0) {
    // white areas (hollow markers, or areas that hide others) get the colour of the paper
    const bool blank = fill.r == 1 && fill.g == 1 && fill.b == 1;
    set_colour(!on_dark() ? fill
               : blank    ? Colour{paper_.r, paper_.g, paper_.b, fill.a}
                          : line_on_dark(fill));
    cairo_fill_preserve(cairo_);
  }
  if (stroke.width > 0 && stroke.colour.a > 0) {
    set_colour(on_dark() && stroke.colour != paper_ ? line_on_dark(stroke.colour) : stroke.colour);
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
      // a cross has no area, so its lines have the colour of the fill
      const Stroke bar{fill, std::max(stroke.width, size / 5), {}};
      line({p.x - 0.8 * h, p.y - 0.8 * h}, {p.x + 0.8 * h, p.y + 0.8 * h}, bar);
      return line({p.x - 0.8 * h, p.y + 0.8 * h}, {p.x + 0.8 * h, p.y - 0.8 * h}, bar);
    }
  }
}

namespace {

/// Every `n`-th pixel of every `n`-th row.
Image thinned(const Image& image, int n) {
  Image some((image.width + n - 1) / n, (image.height + n - 1) / n);
  for (int y = 0; y < some.height; ++y)
    for (int x = 0; x < some.width; ++x)
      std::copy_n(image.pixel(n * x, n * y), 4, some.pixel(x, y));
  return some;
}

}  // namespace

void Canvas::picture(const Image& image, const Box& box) {
  if (image.width < 1 || image.height < 1) return;
  if (const int side = std::max(image.width, image.height); side > largest_side)
    return picture(thinned(image, (side + largest_side - 1) / largest_side), box);
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

namespace {

struct Free {
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using Surface = std::unique_ptr<cairo_surface_t, Free>;
using Cairo = std::unique_ptr<cairo_t, Free>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  // no exception may pass through Cairo, which is written in C
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  } catch (const std::exception&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

// whether all pixels are opaque, as those of frames are: then nothing is multiplied
bool opaque(const std::uint8_t* pixel, int pixels) {
  std::uint8_t all = 255;
  for (int k = 0; k < pixels; ++k) all &= pixel[4 * k + 3];
  return all == 255;
}

void swap_red_and_blue(const std::uint8_t* from, std::uint8_t* to, int pixels) {
  for (int k = 0; k < pixels; ++k) {
    std::uint32_t p;
    std::memcpy(&p, from + 4 * k, 4);
    p = (p & 0xff00ff00u) | (p & 0xffu) << 16 | (p >> 16 & 0xffu);
    std::memcpy(to + 4 * k, &p, 4);
  }
}

/// Swaps red and blue, and converts each colour of a pixel by its alpha.
void convert(const std::uint8_t* from, std::uint8_t* to, int pixels, auto by_alpha) {
  if (opaque(from, pixels)) return swap_red_and_blue(from, to, pixels);
  for (int k = 0; k < pixels; ++k, from += 4, to += 4) {
    for (int c = 0; c < 3; ++c) to[2 - c] = std::uint8_t(by_alpha(from[c], from[3]));
    to[3] = from[3];
  }
}

}  // namespace

void premultiply(const std::uint8_t* from, unsigned char* to, int pixels) {
  convert(from, to, pixels, [](int value, int alpha) { return (value * alpha + 127) / 255; });
}

void unpremultiply(const unsigned char* from, std::uint8_t* to, int pixels) {
  convert(from, to, pixels, [](int value, int alpha) {
    return alpha == 0 ? 0 : std::min(255, (value * 255 + alpha / 2) / alpha);
  });
}

void draw_over(Image& image, const DrawOn& draw) {
  // Cairo draws in a copy of its own pixel order
  std::vector<unsigned char> pixels(image.rgba.size());
  const int count = image.width * image.height;
  premultiply(image.rgba.data(), pixels.data(), count);
  {
    Surface surface(cairo_image_surface_create_for_data(
        pixels.data(), CAIRO_FORMAT_ARGB32, image.width, image.height, 4 * image.width));
    Cairo cairo(cairo_create(surface.get()));
    Canvas canvas(cairo.get(), image.width, image.height);
    draw(canvas);
    cairo_surface_flush(surface.get());
  }
  unpremultiply(pixels.data(), image.rgba.data(), count);
}

Result<Image> draw_picture(double width, double height, double pixels_per_unit, Colour background,
                           const DrawOn& draw) {
  const double across = std::max(1.0, std::round(width * pixels_per_unit)),
               down = std::max(1.0, std::round(height * pixels_per_unit));
  if (!(std::max(across, down) <= largest_side))
    return invalid("size of the picture: got {:.0f} x {:.0f} pixels, expected 1 to {} each", across,
                   down, largest_side);
  Image image{int(across), int(down)};
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    return fail(Fault::io, "cannot draw {} x {} pixels: out of memory", image.width, image.height);
  Cairo cairo(cairo_create(surface.get()));
  cairo_set_source_rgba(cairo.get(), background.r, background.g, background.b, background.a);
  cairo_paint(cairo.get());
  cairo_scale(cairo.get(), pixels_per_unit, pixels_per_unit);
  Canvas canvas(cairo.get(), width, height);
  canvas.set_paper(background);
  draw(canvas);
  // such as a coordinate that is not a number: Cairo then draws nothing more
  if (const cairo_status_t status = cairo_status(cairo.get()); status != CAIRO_STATUS_SUCCESS)
    return fail(Fault::io, "cannot draw the picture: {}", cairo_status_to_string(status));
  cairo_surface_flush(surface.get());
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y)
    unpremultiply(data + std::size_t(y) * stride, image.pixel(0, y), image.width);
  return image;
}

std::string draw_svg(double width, double height, const std::string& title, const DrawOn& draw,
                     bool paper) {
  std::string svg, description, elements;
  {
    Surface surface(cairo_svg_surface_create_for_stream(append, &svg, width, height));
    Cairo cairo(cairo_create(surface.get()));
    Canvas canvas(cairo.get(), width, height);
    if (paper) canvas.rectangle({0, 0, width, height}, {1, 1, 1, 1});
    canvas.keep_text();
    draw(canvas);
    elements = canvas.text_elements();
    for (const std::string& text : canvas.texts())
      description += (description.empty() ? "" : "\n") + text;
    cairo_surface_finish(surface.get());
  }
  const std::size_t root = svg.find("<svg"), end = svg.find('>', root);
  if (root != std::string::npos && end != std::string::npos)
    svg.insert(end + 1, "\n<title>" + escape_xml(valid_utf8(title)) + "</title>\n<desc>" +
                            escape_xml(description) + "</desc>");
  if (const std::size_t close = svg.rfind("</svg>"); close != std::string::npos)
    svg.insert(close, elements);
  return short_svg(svg);
}

std::string draw_pdf(double width, double height, const std::string& title,
                     const std::vector<DrawOn>& pages) {
  std::string pdf;
  Surface surface(cairo_pdf_surface_create_for_stream(append, &pdf, width, height));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  // a fixed date, so that equal drawings give equal bytes
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2018-01-01T00:00:00Z");
  for (const DrawOn& draw : pages) {
    Cairo cairo(cairo_create(surface.get()));
    Canvas canvas(cairo.get(), width, height);
    draw(canvas);
    cairo_show_page(cairo.get());
  }
  cairo_surface_finish(surface.get());
  return pdf;
}

Result<void> write_figure(const std::filesystem::path& stem, double width_pt, double height_pt,
                          const std::string& title, const DrawOn& draw, const Print& print) {
  const auto file = [&](const char* kind) { return std::filesystem::path(stem) += kind; };
  // the title of a file has no markup
  const std::string name = without_marks(title);
  const double scale = print.width_pt(width_pt) / width_pt;
  const double width = scale * width_pt, height = scale * height_pt;
  const DrawOn enlarged = [&](Canvas& canvas) {
    canvas.set_paper(print.background);
    canvas.enlarged(scale, [&] { draw(canvas); });
  };
  // a white background is not drawn: it is that of the paper
  const DrawOn on_paper = [&](Canvas& canvas) {
    if (print.background != white) canvas.rectangle({0, 0, width, height}, print.background);
    enlarged(canvas);
  };
  TRY(image, draw_picture(width, height, print.dpi / 72, print.background, enlarged));
  return write_png(*image, file(".png"), print.dpi)
      .and_then([&] {
        return write_file(file(".svg"),
                          draw_svg(width, height, name, on_paper, print.background.a > 0));
      })
      .and_then(
          [&] { return write_file(file(".pdf"), draw_pdf(width, height, name, {on_paper})); });
}

}  // namespace gridshell::render
