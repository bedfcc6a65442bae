// The position of a preset's net on a surface, and that of the flat footprint below it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/footprint/mesh.h"
#include "engine/geometry/surface.h"
#include "engine/geometry/surface_net.h"
#include "engine/preset/preset.h"
#include "engine/scene/net_design.h"

namespace gridshell {

/// A surface, and its height at (x, y) if it has one there; for a mesh the largest.
struct ShapedSurface {
  Surface surface;
  std::function<std::optional<double>(double x, double y)> height;
};

/// Axes of the flat, of unit length, with the diagonal u + v along `diagonal`.
Eigen::Matrix<double, 3, 2> axes_about(const Eigen::Vector2d& diagonal);

/// The function of the expression `text`, the value of `key` in [net]. Errors (bad_input): those of
/// the expression.
Result<Surface::Function> parsed(const char* key, const std::string& text);

/// A function that is below zero inside the boundary of [net] within or cut_mm; for a mesh without
/// either it is below zero everywhere.
Result<Surface::Function> outside_of(const preset::Net& requested);

/// The start of the net that the preset gives, and its axes. Errors (bad_input): an apex further
/// from the surface than `allowed_mm`, or outside the boundary.
Result<NetPose> given_pose(const preset::Net& requested, const ShapedSurface& shape,
                           const Surface::Function& outside, double allowed_mm);

/// Sets position and scale of the flat footprint of a net with a domain: in the plane of the cut,
/// or at the boundary's mean height, below the apex, with its diagonal along that of the rods
/// there. Errors: those of the net.
Result<void> lay_flat(const preset::Net& requested, const NetPose& pose, NetDesign& design);

/// The net on a mesh: a smooth surface is fitted to it, and the net is computed on that from the
/// given apex or the best start, as far as it reaches. Errors (bad_input): a mesh that is no sheet,
/// an apex that is not on it, no rod from the apex.
Result<NetDesign> mesh_design(const preset::Net& requested, double spacing_mm);

}  // namespace gridshell
