// One surface to draw lines, areas and text on, whatever it ends as: a finished frame, a PNG or an
// SVG. Lengths are in units of the canvas, x to the right, y down: pixels over a frame, points
// (1/72 inch) on a figure. Made with Cairo and Pango.
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

/// Colours of text and axes, and of what is on dark.
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

/// Maps points of a plane (or of space, seen from above) to a canvas, y up.
struct PlanView {
  Point at;                ///< where `middle` goes
  Eigen::Vector2d middle;  ///< mm
  double scale = 1;        ///< units of the canvas a millimetre

  /// What contains all of `points` (at least 2 rows; one per column), as large as fits into the
  /// box.
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
enum class AlignY { top, middle, baseline, bottom };  ///< of the line's height, not its ink

struct TextStyle {
  double size = 9;  ///< of the font (one em), in units of the canvas
  Colour colour = ink;
  bool bold = false;
  AlignX align_x = AlignX::left;
  AlignY align_y = AlignY::baseline;
  double angle_deg = 0;     ///< counter-clockwise about the anchor
  Colour halo{1, 1, 1, 0};  ///< a rim around the letters, for text over a picture
};

/// Text marks: `_{a}` lowers, `^{−3}` raises, `*R*` slants. `plain` protects text that is to be
/// shown as it is (a file's name, a user's title).
std::string plain(const std::string& text);

enum class Marker { none, circle, square, diamond, triangle, cross };

/// The family of text where none is chosen: it has every sign that is used.
inline constexpr const char* default_font = "DejaVu Sans";

/// The family of all text from here on, in the whole process; empty: the usual one. Errors:
/// bad_input for one that the machine does not have.
Result<void> use_font(const std::string& family);

/// The surface; made by draw_over, draw_picture and draw_svg below.
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
  /// `size` is the width of the marker's ink
  void marker(Marker kind, Point at, double size, Colour fill, const Stroke& stroke);
  void picture(const Image& image, const Box& box);

  /// One line of text (or several, parted by \n) at an anchor. Returns the box of its ink.
  Box text(const std::string& marked, Point anchor, const TextStyle& style);
  /// The box `text` would take: its line height and advance, before rotation, anchor at (0, 0).
  Box measure(const std::string& marked, const TextStyle& style) const;
  /// The style with its size lessened so that the text is at most `width` wide, but to no less than
  /// `least` of it.
  TextStyle fitted(const std::string& marked, double width, TextStyle style,
                   double least = 0) const;
  /// The text broken at blanks so that no line is wider than `width`; a longer word has its own.
  std::vector<std::string> wrapped(const std::string& plain_text, double width,
                                   const TextStyle& style) const;
  /// The text shortened by '…' to at most `width`.
  std::string shortened(const std::string& plain_text, double width, const TextStyle& style) const;

  /// What `inside` draws is cut off at the box.
  void clipped(const Box& box, const std::function<void()>& inside);

  /// all texts drawn so far without their marks, in order
  const std::vector<std::string>& texts() const { return texts_; }
  /// ink boxes of all texts drawn so far, in order, and of all markers that are not cut off
  const std::vector<Box>& text_boxes() const { return text_boxes_; }
  const std::vector<Box>& marker_boxes() const { return markers_; }

  /// What `inside` draws is `scale` times as large.
  void enlarged(double scale, const std::function<void()>& inside);

  /// What lies below: neutral text and lines that it would swallow are drawn lighter.
  void set_paper(Colour paper) { paper_ = paper; }

  /// From here on text is not drawn but kept as SVG elements, so that it stays text.
  void keep_text() { keeps_text_ = true; }
  const std::string& text_elements() const { return text_elements_; }

  /// Called with every canvas that is finished, on the thread that drew it; to be set while nothing
  /// is drawn.
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
  double scale_ = 1;  ///< of what enlarged() draws
  std::string text_elements_;
  std::vector<std::string> texts_;
  std::vector<Box> text_boxes_, markers_;
  Colour paper_ = white;
  Box clip_;  ///< empty: everything is drawn
};

using DrawOn = std::function<void(Canvas&)>;

/// Draws over a picture; the canvas unit is a pixel.
void draw_over(Image& image, const DrawOn& draw);

/// A picture of width x height units at `pixels_per_unit`, on a background.
Image draw_picture(double width, double height, double pixels_per_unit, Colour background,
                   const DrawOn& draw);

/// An SVG of width x height points whose text stays text, in its font or a replacement of it;
/// `title` and all texts are in its <title> and <desc> for search and screen readers.
std::string draw_svg(double width, double height, const std::string& title, const DrawOn& draw,
                     bool paper = true);

/// A PDF of pages of width x height points with its fonts in it; the same drawings give the same
/// bytes.
std::string draw_pdf(double width, double height, const std::string& title,
                     const std::vector<DrawOn>& pages);

/// How a figure is printed.
struct Print {
  double width_mm = 0;  ///< 0: the figure's own
  double dpi = 300;
  Colour background = white;  ///< alpha 0: none

  /// Width in points; `usual` where it is the figure's own.
  double width_pt(double usual) const { return width_mm > 0 ? width_mm * 72 / 25.4 : usual; }
  bool operator==(const Print&) const = default;
};

/// Writes one drawing as `<stem>.png` with its dpi, `<stem>.svg` and `<stem>.pdf`, each whole or
/// absent, enlarged to the width of print. Errors: Fault::io naming the path.
Result<void> write_figure(const std::filesystem::path& stem, double width_pt, double height_pt,
                          const std::string& title, const DrawOn& draw, const Print& print = {});

// Between the renderer's pixels (RGBA, not premultiplied) and Cairo's (premultiplied, in the
// machine's byte order: BGRA on the little-endian machines this runs on).

void premultiply(const std::uint8_t* rgba, unsigned char* bgra, int pixels);
void unpremultiply(const unsigned char* bgra, std::uint8_t* rgba, int pixels);

}  // namespace gridshell::render
