// What a DXF drawing holds: its curves as polylines, and everything else by name.
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

/// An entity of a drawing; those of blocks stand where the blocks are inserted.
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

/// Reads a drawing of any release as text: LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE and
/// SPLINE as polylines, curved pieces by a point a degree of their turn at least; INSERT as what
/// its block holds. Errors (bad_input), with `name` and line: no text of DXF, a number that is
/// none, a file that is cut short, a block that is missing or holds itself.
Result<DxfDrawing> read_dxf(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
