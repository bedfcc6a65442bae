// Closed outlines in drawings that a user brings.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/network_file.h"
#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// A line of a drawing, seen along z, in its unit; curved pieces have a point a degree of turn.
struct PlanLine {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};

/// The lines of a drawing and what else is in it.
struct PlanDrawing {
  std::vector<PlanLine> lines;
  double unit_mm = 1;
  std::string unit;      ///< how the unit is known, for people
  std::string left_out;  ///< "; not used: 2 texts"; empty: nothing
};

/// Chains lines whose ends meet, and gives the closed one that has the largest area, as a network
/// of one closed rod, mm. A gap is closed where it is at most a millionth of the drawing's size, or
/// `join_mm`. `report` says what else is there. Errors (bad_input): no line is closed, with the
/// smallest gap between ends.
Result<NetworkData> largest_loop(const PlanDrawing& drawing, const std::string& name,
                                 double join_mm, FileReport& report);

/// The lines of a DXF drawing for an outline (network_drawing.cpp). Errors: as read_dxf().
Result<PlanDrawing> read_outline_dxf(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report);

/// Reads an outline as its name's ending says: .dxf (curves of model space that are shown, where
/// there is a layer "outline" of that one alone), .svg (svg_file.h) or .obj (polylines "l", else
/// faces "f"). Errors (bad_input), with `name` and the line: as largest_loop() and the readers.
Result<NetworkData> read_outline(std::string_view bytes, const std::string& name,
                                 const NetworkOptions& options, FileReport* report);

}  // namespace gridshell::preset
