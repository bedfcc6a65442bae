// A drawing to scale, in layers, for laser cutters and drawing programs. Millimetres, x to the
// right, y up.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gridshell::exports {

struct DrawnLine {
  std::vector<Eigen::Vector3d> points;  ///< two or more; z is 0 in a flat drawing
  bool closed = false;
};

struct DrawnCircle {
  Eigen::Vector2d centre;
  double radius_mm = 0;
};

struct DrawnText {
  Eigen::Vector2d at;  ///< its middle
  double height_mm = 0;
  std::string text;
};

/// What is cut, marked or read together, in one colour.
struct Layer {
  std::string name;
  int colour = 7;  ///< AutoCAD's number: 1 red, 3 green, 5 blue, 7 black
  std::vector<DrawnLine> lines = {};
  std::vector<DrawnCircle> circles = {};
  std::vector<DrawnText> texts = {};
};

struct Drawing {
  std::string title;
  std::vector<Layer> layers;
};

/// DXF of release 12, which every drawing program reads: LINE, POLYLINE, CIRCLE and TEXT, a layer
/// each, $INSUNITS 4 (mm). Numbers to 1e-9 mm.
std::string to_dxf(const Drawing& drawing);

/// SVG at its true size (width and height in mm), y turned down, a group a layer. Depth is left
/// out.
std::string to_svg(const Drawing& drawing);

}  // namespace gridshell::exports
