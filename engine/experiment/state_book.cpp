#include "engine/experiment/state_book.h"

#include <algorithm>
#include <cmath>

namespace gridshell::experiment {
namespace {

// energies of one state differ by round-off, and by what joints within the tolerance are worth
constexpr double same_energy = 1e-3;

}  // namespace

std::optional<std::size_t> StateBook::find(const Eigen::Matrix3Xd& joints, double energy_mJ) const {
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Entry& entry = entries_[k];
    if (std::abs(entry.energy_mJ - energy_mJ) > same_energy * std::abs(entry.energy_mJ)) continue;
    for (const MeshSymmetry& symmetry : symmetries_)
      if (distance_under(symmetry, entry.joints, joints) < tolerance_mm_) return k;
  }
  return std::nullopt;
}

std::size_t StateBook::enter(const Eigen::Matrix3Xd& joints, double energy_mJ) {
  if (const auto known = find(joints, energy_mJ)) return *known;
  entries_.push_back({joints, energy_mJ});
  return entries_.size() - 1;
}

}  // namespace gridshell::experiment
