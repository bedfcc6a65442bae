// Contents of a DXF drawing: its curves as polylines, and everything else by name.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::preset {

/// The space of a drawing that an entity is in.
enum class DrawingSpace {
  model,   ///< model space: the drawing itself
  paper,   ///< paper space: sheets
  hidden,  ///< model space, but invisible or on a frozen or switched-off layer
};

/// Whether an entity can be a rod.
enum class EntityUse {
  curve,    ///< it is a polyline or was converted to one
  mark,     ///< it is never a rod: a text, a point, a dimension, ...
  refused,  ///< it may be a rod, but is not supported: a multiline, a mesh, an unknown kind
};

/// An entity of a drawing. The entities of a block appear once for each insertion of the block.
struct DrawnEntity {
  std::string kind;   ///< "LINE"
  int line = 0;       ///< line of the file at which it starts
  std::string layer;  ///< name of its layer in lower case
  DrawingSpace space = DrawingSpace::model;
  EntityUse use = EntityUse::curve;
  std::string why = {};                      ///< reason if it is refused
  std::vector<Eigen::Vector3d> points = {};  ///< points of a curve, in the drawing's unit
  std::vector<char> sampled = {};            ///< for each point: whether it is on a curved piece
  bool closed = false;                       ///< whether the last point joins the first
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< centre of a circle
};

struct DxfDrawing {
  std::vector<DrawnEntity> entities;
  double unit_mm = 0;     ///< the unit $INSUNITS in mm; 0: the drawing names none
  std::string unit = {};  ///< name of the unit: "in"
};

/// Reads a text DXF drawing of any release: LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE and
/// SPLINE as polylines, with at least one point per degree of direction on curved pieces; INSERT as
/// the contents of its block. Errors (bad_input), with `name` and line: no text DXF, an invalid
/// number, a file that is cut short, a block that is missing or contains itself.
Result<DxfDrawing> read_dxf(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
