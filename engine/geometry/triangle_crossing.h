// Whether triangles run through one another.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/core/result.h"

namespace gridshell {

/// A point where two triangles without a common vertex meet; nothing: there is none. They are
/// looked for among boxes of about `size`, mm. Errors (bad_input): triangles so uneven in size, or
/// so many in one place, that it would take too long.
Result<std::optional<Eigen::Vector3d>> first_crossing(
    const Eigen::Matrix3Xd& vertices, const std::vector<std::array<int, 3>>& triangles,
    double size);

}  // namespace gridshell
