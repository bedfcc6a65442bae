// Contents of a DXF drawing: its curves as polylines, and everything else by name.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::preset {

/// Where something of a drawing is.
enum class DrawingSpace {
  model,   ///< the drawing itself
  paper,   ///< its sheets
  hidden,  ///< model space, on a frozen or switched-off layer, or invisible
};

/// Whether an entity can be a rod.
enum class EntityUse {
  curve,    ///< it is a polyline, or was made one
  mark,     ///< a text, a point, a dimension, ...: it never is one
  refused,  ///< it may be, and is not understood (a multiline, a mesh, a kind that is not known)
};

/// An entity of a drawing; entities of blocks are placed where the blocks are inserted.
struct DrawnEntity {
  std::string kind;   ///< "LINE"
  int line = 0;       ///< of the file, where it begins
  std::string layer;  ///< in small letters
  DrawingSpace space = DrawingSpace::model;
  EntityUse use = EntityUse::curve;
  std::string why = {};                              ///< it is refused
  std::vector<Eigen::Vector3d> points = {};          ///< of a curve, in the unit of the drawing
  std::vector<char> sampled = {};                    ///< of each point: it lies on a curved piece
  bool closed = false;                               ///< its first point follows its last
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of a circle
};

/// A drawing.
struct DxfDrawing {
  std::vector<DrawnEntity> entities;
  double unit_mm = 0;     ///< of $INSUNITS; 0: it names none
  std::string unit = {};  ///< "in"
};

/// Reads a text DXF drawing of any release: LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE and
/// SPLINE as polylines, with at least one point per degree of direction on curved pieces; INSERT as
/// the contents of its block. Errors (bad_input), with `name` and line: no text DXF, an invalid
/// number, a file that is cut short, a block that is missing or contains itself.
Result<DxfDrawing> read_dxf(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
