// A drawing to scale, in layers, for laser cutters and drawing programs. Millimetres, x to the
// right, y up.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gridshell::exports {

/// A polyline.
struct DrawnLine {
  std::vector<Eigen::Vector3d> points;  ///< two or more; z is 0 in a flat drawing
  bool closed = false;
};

struct DrawnCircle {
  Eigen::Vector2d centre;
  double radius_mm = 0;
};

struct DrawnText {
  Eigen::Vector2d at;  ///< position of its middle
  double height_mm = 0;
  std::string text;
};

/// The lines, circles and texts of one purpose (cut, mark, label) in one colour.
struct Layer {
  std::string name;
  int colour = 7;  ///< AutoCAD's number: 1 red, 3 green, 5 blue, 7 black
  std::vector<DrawnLine> lines = {};
  std::vector<DrawnCircle> circles = {};
  std::vector<DrawnText> texts = {};
};

/// A drawing in layers.
struct Drawing {
  std::string title;
  std::vector<Layer> layers;
};

/// The drawing as DXF of release 12, which every drawing program reads: LINE, POLYLINE, CIRCLE and
/// TEXT in their layers, $INSUNITS 4 (mm). Numbers are rounded to 1e-9 mm.
std::string to_dxf(const Drawing& drawing);

/// The drawing as SVG at its true size (width and height in mm), with y downwards and one group per
/// layer. z is ignored.
std::string to_svg(const Drawing& drawing);

}  // namespace gridshell::exports
