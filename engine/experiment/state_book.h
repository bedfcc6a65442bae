// Which of the states met so far a new one is, modulo the symmetries of the shell.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/footprint/mesh_symmetry.h"

namespace gridshell::experiment {

/// States by the positions of their joints.
class StateBook {
 public:
  /// `tolerance_mm`: joints of one and the same state lie nearer than that.
  StateBook(std::vector<MeshSymmetry> symmetries, double tolerance_mm)
      : symmetries_(std::move(symmetries)), tolerance_mm_(tolerance_mm) {}

  /// The one that `joints` (3 x n, mm; energy in mJ) are an image of, if any.
  std::optional<std::size_t> find(const Eigen::Matrix3Xd& joints, double energy_mJ) const;
  /// The same, entered as a new one where there is none.
  std::size_t enter(const Eigen::Matrix3Xd& joints, double energy_mJ);

  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    Eigen::Matrix3Xd joints;
    double energy_mJ = 0;
  };
  std::vector<MeshSymmetry> symmetries_;
  double tolerance_mm_;
  std::vector<Entry> entries_;
};

}  // namespace gridshell::experiment
