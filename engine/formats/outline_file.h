// Closed outlines in drawings of users.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/network_file.h"
#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// A line of a drawing, projected along z, in the drawing's unit. Curved pieces have a point per
/// degree of direction, or 64 points on each Bezier curve of an SVG.
struct PlanLine {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};

/// The lines of a drawing.
struct PlanDrawing {
  std::vector<PlanLine> lines;
  double unit_mm = 1;    ///< the drawing's unit, mm
  std::string unit;      ///< how the unit is known, for messages
  std::string left_out;  ///< entities that are not used, "; not used: 2 texts"; empty: none
};

/// Joins lines whose ends meet, and returns the closed one with the largest area as a network of
/// one closed rod, mm. Gaps of at most a millionth of the drawing's size, or of `join_mm`, are
/// closed. `report` receives a sentence on the outline and on other lines. Errors (bad_input): a
/// coordinate above 1e9 mm, no line is closed, with the smallest gap between ends.
Result<NetworkData> largest_loop(const PlanDrawing& drawing, const std::string& name,
                                 double join_mm, FileReport& report);

/// The lines of a DXF drawing for an outline: visible curves of model space, only those of layer
/// "outline" if there is one. Errors: those of read_dxf().
Result<PlanDrawing> read_outline_dxf(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report);

/// Reads an outline in the format of the name's ending: .dxf (read_outline_dxf()), .svg
/// (svg_file.h) or .obj (polylines "l", or else faces "f"). Errors (bad_input), with `name` and the
/// line: those of largest_loop() and of the readers.
Result<NetworkData> read_outline(std::string_view bytes, const std::string& name,
                                 const NetworkOptions& options, FileReport* report);

}  // namespace gridshell::preset
