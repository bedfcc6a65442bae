// A canvas on which lines, areas and text are drawn (by Cairo and Pango), over a frame or as a PNG,
// SVG or PDF. Lengths are in units of the canvas, x to the right, y down: pixels over a frame,
// points (1/72 inch) on a figure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "render/gl/image.h"

typedef struct _cairo cairo_t;

namespace gridshell::render {

inline constexpr double points_per_mm = 72 / 25.4;

/// Colours of text and axes, on white and on dark.
inline constexpr Colour ink{0.1f, 0.1f, 0.12f, 1}, white{1, 1, 1, 1};

struct Point {
  double x = 0, y = 0;
};

/// An axis-aligned rectangle.
struct Box {
  double x = 0, y = 0, width = 0, height = 0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  Point middle() const { return {x + width / 2, y + height / 2}; }
  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(const Box& inner) const;  ///< to within 1e-6
  bool overlaps(const Box& other) const;  ///< by more than 1e-6; an empty box overlaps nothing
  Box inset(double margin) const;
};

/// Maps points of a plane (or of space, seen from above), y up, to a canvas.
struct PlanView {
  Point at;                ///< position of `middle` on the canvas
  Eigen::Vector2d middle;  ///< mm
  double scale = 1;        ///< units of the canvas per millimetre

  /// The largest view that shows all of `points` (at least 2 rows, one column per point, at least
  /// one) in the box.
  PlanView(const Box& box, const Eigen::MatrixXd& points);
  PlanView(Point at_, const Eigen::Vector2d& middle_, double scale_)
      : at(at_), middle(middle_), scale(scale_) {}

  template <class P>
  Point operator()(const Eigen::MatrixBase<P>& p) const {
    return {at.x + scale * (p.x() - middle.x()), at.y - scale * (p.y() - middle.y())};
  }
  std::vector<Point> line(const Eigen::MatrixXd& points) const;
};

/// A line as drawn; width 0 draws nothing. `dash` alternates lengths of line and gap.
struct Stroke {
  Colour colour{0, 0, 0, 1};
  double width = 1;
  std::vector<double> dash = {};
};

enum class AlignX { left, centre, right };
enum class AlignY { top, middle, baseline, bottom };  ///< of the line's height, not of the letters

struct TextStyle {
  double size = 9;  ///< of the font (one em), in units of the canvas
  Colour colour = ink;
  bool bold = false;
  AlignX align_x = AlignX::left;
  AlignY align_y = AlignY::baseline;
  double angle_deg = 0;     ///< counter-clockwise about the anchor
  Colour halo{1, 1, 1, 0};  ///< a rim around the letters, for text over a picture
};

/// Escapes a text without markup (a file's name, a user's title), so that it is shown as it is.
/// Markup is `_{a}` (lowered), `^{−3}` (raised) and `*R*` (slanted).
std::string plain(const std::string& text);

/// The text with every byte that is not UTF-8, on which Pango aborts, replaced by U+FFFD.
std::string valid_utf8(const std::string& text);

enum class Marker { none, circle, square, diamond, triangle, cross };

/// The default font family, which has every sign that is used.
inline constexpr const char* default_font = "DejaVu Sans";

/// Sets the font family of all text drawn later in this process; empty: the default. Errors:
/// bad_input for a family that the machine does not have.
Result<void> use_font(const std::string& family);

/// The canvas that draw_over, draw_picture, draw_svg and draw_pdf pass to their drawing. On dark
/// paper (set_paper) neutral text and lines are drawn lighter.
class Canvas {
 public:
  Canvas(cairo_t* cairo, double width, double height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  double width() const { return width_; }
  double height() const { return height_; }

  void polyline(const std::vector<Point>& points, const Stroke& stroke, bool closed = false);
  void line(Point a, Point b, const Stroke& stroke) { polyline({a, b}, stroke); }
  void polygon(const std::vector<Point>& points, Colour fill, const Stroke& stroke = {{}, 0});
  void rectangle(const Box& box, Colour fill, const Stroke& stroke = {{}, 0},
                 double corner_radius = 0);
  void circle(Point centre, double radius, Colour fill, const Stroke& stroke = {{}, 0});
  /// Draws a marker of width `size`.
  void marker(Marker kind, Point at, double size, Colour fill, const Stroke& stroke);
  /// Draws a picture; of one with a side longer than `largest_side` only every n-th pixel.
  void picture(const Image& image, const Box& box);

  /// Draws text with markup at an anchor, in several lines if it contains \n. Returns the bounding
  /// box of its letters.
  Box text(const std::string& marked, Point anchor, const TextStyle& style);
  /// The box of a text by its line height and advance, without rotation and with its anchor at
  /// (0, 0).
  Box measure(const std::string& marked, const TextStyle& style) const;
  /// The style with its size reduced so that the text is at most `width` wide, but not below the
  /// fraction `least` of the size.
  TextStyle fitted(const std::string& marked, double width, TextStyle style,
                   double least = 0) const;
  /// The text in lines, broken at blanks, that are at most `width` wide; a longer word has a line
  /// of its own.
  std::vector<std::string> wrapped(const std::string& plain_text, double width,
                                   const TextStyle& style) const;
  /// As wrapped(), but of text with markup, which no blank divides.
  std::vector<std::string> wrapped_marked(const std::string& marked, double width,
                                          const TextStyle& style) const;
  /// The text shortened by '…' to at most `width`.
  std::string shortened(const std::string& plain_text, double width, const TextStyle& style) const;

  /// Calls `inside`, whose drawing is clipped to the box.
  void clipped(const Box& box, const std::function<void()>& inside);

  /// all texts drawn so far without their markup, in order
  const std::vector<std::string>& texts() const { return texts_; }
  /// bounding boxes of the letters of all texts drawn so far, in order, and of all markers that are
  /// not clipped
  const std::vector<Box>& text_boxes() const { return text_boxes_; }
  const std::vector<Box>& marker_boxes() const { return markers_; }

  /// Calls `inside`, whose drawing is `scale` times as large.
  void enlarged(double scale, const std::function<void()>& inside);

  /// Sets the colour on which is drawn. On a dark one neutral text and lines are drawn lighter.
  void set_paper(Colour paper) { paper_ = paper; }

  /// From now on texts are not drawn but collected as SVG elements, so that they remain text.
  void keep_text() { keeps_text_ = true; }
  const std::string& text_elements() const { return text_elements_; }

  /// Called with every finished canvas, on the thread that drew it (for tests); to be set while
  /// nothing is drawn.
  static inline std::function<void(const Canvas&)> on_finished;

 private:
  void set_colour(Colour colour);
  bool on_dark() const;
  void paint_path(Colour fill, const Stroke& stroke);
  Box scaled(const Box& box) const {
    return {scale_ * box.x, scale_ * box.y, scale_ * box.width, scale_ * box.height};
  }

  cairo_t* cairo_;
  double width_, height_;
  bool keeps_text_ = false;
  double scale_ = 1;  ///< product of the scales of enlarged()
  std::string text_elements_;
  std::vector<std::string> texts_;
  std::vector<Box> text_boxes_, markers_;
  Colour paper_ = white;
  Box clip_;  ///< of clipped(); empty: none
};

using DrawOn = std::function<void(Canvas&)>;

/// Draws over a picture; the canvas unit is a pixel.
void draw_over(Image& image, const DrawOn& draw);

/// The largest width and height of a picture that is drawn, in pixels (Cairo's limit).
inline constexpr int largest_side = 32767;

/// A picture of width x height units at `pixels_per_unit`, drawn on a background. Errors:
/// Fault::bad_input if a side is longer than `largest_side`; Fault::io without memory.
Result<Image> draw_picture(double width, double height, double pixels_per_unit, Colour background,
                           const DrawOn& draw);

/// An SVG of width x height points whose text remains text, in its font or a replacement of it;
/// `title` and all texts are in its <title> and <desc> for search and screen readers. `paper`: on a
/// white rectangle.
std::string draw_svg(double width, double height, const std::string& title, const DrawOn& draw,
                     bool paper = true);

/// A PDF with pages of width x height points and its fonts embedded; equal drawings give equal
/// bytes.
std::string draw_pdf(double width, double height, const std::string& title,
                     const std::vector<DrawOn>& pages);

/// Size and background of a printed figure.
struct Print {
  double width_mm = 0;  ///< 0: the figure's own width
  double dpi = 300;
  Colour background = white;  ///< alpha 0: none

  /// Width in points; `usual` is the figure's own.
  double width_pt(double usual) const { return width_mm > 0 ? points_per_mm * width_mm : usual; }
  bool operator==(const Print&) const = default;
};

/// Writes a drawing, enlarged to the printed width, as `<stem>.png` with its dpi, `<stem>.svg` and
/// `<stem>.pdf`. A file that cannot be written is absent. Errors: Fault::io with the path; those of
/// draw_picture().
Result<void> write_figure(const std::filesystem::path& stem, double width_pt, double height_pt,
                          const std::string& title, const DrawOn& draw, const Print& print = {});

// Conversion between the renderer's pixels (RGBA, not premultiplied) and Cairo's (premultiplied, in
// the machine's byte order: BGRA, since only little-endian machines are supported).

void premultiply(const std::uint8_t* rgba, unsigned char* bgra, int pixels);
void unpremultiply(const unsigned char* bgra, std::uint8_t* rgba, int pixels);

}  // namespace gridshell::render
