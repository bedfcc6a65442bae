// The rods of a shell and what they carry, the same on every mesh of its footprint.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/mesh.h"
#include "engine/rod/section.h"

namespace gridshell {

/// A dead force on a joint, N.
struct PointLoad {
  int joint = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Sections and dead loads of the rods of a footprint.
struct ShellRods {
  std::vector<RodSection> sections;     ///< one a rod, or one for all
  std::vector<double> weight_N_per_mm;  ///< one a rod, downwards; empty: none
  std::vector<PointLoad> points;

  ShellRods() = default;
  ShellRods(const RodSection& section) : sections{section} {}  // NOLINT: rods all alike

  const RodSection& section(std::size_t rod) const {
    return sections.size() == 1 ? sections.front() : sections[rod];
  }
  bool loaded() const { return !weight_N_per_mm.empty() || !points.empty(); }
};

/// What `per_mm` of each rod puts on every node: half of each edge that meets there, none from the
/// edges to ghosts.
Eigen::VectorXd lumped(const RodMesh& mesh, const std::vector<double>& per_mm);

/// Dead force on every node (3 x nodes, N), or an empty matrix when nothing is loaded.
Eigen::Matrix3Xd dead_loads(const RodMesh& mesh, const ShellRods& rods);

}  // namespace gridshell
