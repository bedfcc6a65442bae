// Where on a surface a preset's net lies, and how its flat footprint lies below it.
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

/// A surface, and its height where it has one; of a mesh the highest.
struct ShapedSurface {
  Surface surface;
  std::function<std::optional<double>(double x, double y)> height;
};

/// Axes of the flat whose diagonal u + v runs along `diagonal`, of unit length.
Eigen::Matrix<double, 3, 2> axes_about(const Eigen::Vector2d& diagonal);

/// The function that `text` of the key `key` of [net] writes down.
Result<Surface::Function> parsed(const char* key, const std::string& text);

/// Below zero inside the boundary that [net] within or cut_mm gives; of a mesh without either it is
/// so everywhere.
Result<Surface::Function> outside_of(const preset::Net& requested);

/// Where the preset says that the net begins and its axes leave to: on the surface, no further off
/// than `allowed_mm`, and inside the boundary.
Result<NetPlace> given_place(const preset::Net& requested, const ShapedSurface& shape,
                             const Surface::Function& outside, double allowed_mm);

/// Sets where the flat footprint of a net with a domain lies, and its scale: in the plane of the
/// cut, or at the boundary's mean height, below the apex; as far to the right of the rods' diagonal
/// as to its left.
Result<void> lay_flat(const preset::Net& requested, const NetPlace& place, NetDesign& design);

/// The net on a mesh: a smooth surface fitted to it, and the net marched over that from the apex,
/// or from the best there is, as far as it comes. Errors (bad_input): a mesh that is no sheet, an
/// apex off it, no rod that leaves it.
Result<NetDesign> mesh_design(const preset::Net& requested, double spacing_mm);

}  // namespace gridshell
