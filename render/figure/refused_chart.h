// Where a net ends that was refused.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "render/plot/plot.h"

namespace gridshell::render {

/// Lines of a net as far as it comes, seen from above, mm; where its rods are close to parallel,
/// and a cross where it ends before its boundary.
Plot refused_plot(const std::vector<Eigen::Matrix3Xd>& lines, const Eigen::Matrix3Xd& narrow,
                  const Eigen::Vector3d& end, const std::string& title);

}  // namespace gridshell::render
