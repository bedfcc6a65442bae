// Stanford PLY: elements with properties that its header names, as text or as bytes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::preset {

/// One element of a file: a vertex, a face, or of another kind.
struct PlyItem {
  std::string element;     ///< "vertex"
  std::size_t number = 0;  ///< from 0
  /// its properties x, y, z; NaN: it has none
  Eigen::Vector3d xyz = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<long> corners;  ///< its list vertex_indices

  /// "dome.ply: vertex 3"
  std::string place(const std::string& name) const;
};

/// Hands every element of a whole file to `take`, in order; `name` is what errors call it. Errors
/// (bad_input): what is not of the format, with its line or the number of its element; those of
/// `take`, which end the reading.
Result<void> each_ply_item(std::string_view bytes, const std::string& name,
                           const std::function<Result<void>(const PlyItem&)>& take);

}  // namespace gridshell::preset
