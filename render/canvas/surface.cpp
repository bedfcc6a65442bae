// What a Canvas ends as.
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "render/canvas/canvas.h"
#include "render/canvas/text.h"
#include "render/gl/image.h"

namespace gridshell::render {
namespace {

struct Free {
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using Surface = std::unique_ptr<cairo_surface_t, Free>;
using Cairo = std::unique_ptr<cairo_t, Free>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

// frames are opaque, and then there is nothing to multiply
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

}  // namespace

void premultiply(const std::uint8_t* from, unsigned char* to, int pixels) {
  if (opaque(from, pixels)) return swap_red_and_blue(from, to, pixels);
  for (int k = 0; k < pixels; ++k, from += 4, to += 4) {
    const int a = from[3];
    for (int c = 0; c < 3; ++c) to[2 - c] = static_cast<unsigned char>((from[c] * a + 127) / 255);
    to[3] = from[3];
  }
}

void unpremultiply(const unsigned char* from, std::uint8_t* to, int pixels) {
  if (opaque(from, pixels)) return swap_red_and_blue(from, to, pixels);
  for (int k = 0; k < pixels; ++k, from += 4, to += 4) {
    const int a = from[3];
    for (int c = 0; c < 3; ++c)
      to[c] =
          static_cast<std::uint8_t>(a == 0 ? 0 : std::min(255, (from[2 - c] * 255 + a / 2) / a));
    to[3] = from[3];
  }
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

Image draw_picture(double width, double height, double pixels_per_unit, Colour background,
                   const DrawOn& draw) {
  Image image(std::max(1, int(std::lround(width * pixels_per_unit))),
              std::max(1, int(std::lround(height * pixels_per_unit))));
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
  Cairo cairo(cairo_create(surface.get()));
  cairo_set_source_rgba(cairo.get(), background.r, background.g, background.b, background.a);
  cairo_paint(cairo.get());
  cairo_scale(cairo.get(), pixels_per_unit, pixels_per_unit);
  Canvas canvas(cairo.get(), width, height);
  draw(canvas);
  cairo_surface_flush(surface.get());
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y)
    unpremultiply(data + std::size_t(y) * stride, image.pixel(0, y), image.width);
  return image;
}

std::string draw_svg(double width, double height, const std::string& title, const DrawOn& draw) {
  std::string svg, description, elements;
  {
    Surface surface(cairo_svg_surface_create_for_stream(append, &svg, width, height));
    Cairo cairo(cairo_create(surface.get()));
    Canvas canvas(cairo.get(), width, height);
    canvas.rectangle({0, 0, width, height}, {1, 1, 1, 1});
    canvas.keep_text();
    draw(canvas);
    elements = canvas.text_elements();
    for (const std::string& text : canvas.texts())
      description += (description.empty() ? "" : "\n") + text;
    cairo_surface_finish(surface.get());
  }
  const std::size_t root = svg.find("<svg"), end = svg.find('>', root);
  if (root != std::string::npos && end != std::string::npos)
    svg.insert(end + 1, "\n<title>" + escape_xml(title) + "</title>\n<desc>" +
                            escape_xml(description) + "</desc>");
  if (const std::size_t close = svg.rfind("</svg>"); close != std::string::npos)
    svg.insert(close, elements);
  return svg;
}

std::string draw_pdf(double width, double height, const std::string& title, const DrawOn& draw) {
  std::string pdf;
  Surface surface(cairo_pdf_surface_create_for_stream(append, &pdf, width, height));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  // no clock in the bytes
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2018-01-01T00:00:00Z");
  {
    Cairo cairo(cairo_create(surface.get()));
    Canvas canvas(cairo.get(), width, height);
    draw(canvas);
  }
  cairo_surface_finish(surface.get());
  return pdf;
}

Result<void> write_figure(const std::filesystem::path& stem, double width_pt, double height_pt,
                          const std::string& title, const DrawOn& draw, const Print& print) {
  const auto file = [&](const char* kind) { return std::filesystem::path(stem) += kind; };
  // text is plain in a title
  const std::string name = without_marks(title);
  const double scale = print.width_pt(width_pt) / width_pt;
  const DrawOn enlarged = [&](Canvas& canvas) { canvas.enlarged(scale, [&] { draw(canvas); }); };
  const double width = scale * width_pt, height = scale * height_pt;
  const Image image = draw_picture(width, height, print.dpi / 72, {1, 1, 1, 1}, enlarged);
  return write_png(image, file(".png"), print.dpi)
      .and_then([&] { return write_file(file(".svg"), draw_svg(width, height, name, enlarged)); })
      .and_then([&] { return write_file(file(".pdf"), draw_pdf(width, height, name, enlarged)); });
}

}  // namespace gridshell::render
