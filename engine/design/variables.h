// The symmetries of a shell that a design preserves, and the variables of a design.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/preset/preset.h"
#include "engine/scene/rod_ends.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// A rigid motion that maps the shell to itself: its rotation, and the end to[k] to whose position
/// it maps the end k of a rod (2r the start, 2r + 1 the end of rod r).
struct ShellSymmetry {
  std::vector<int> to;
  Eigen::Matrix3d turn;
};

/// Finds which of the eight symmetries of the square grid preserve the footprint, the positions of
/// ends and joints (3 x joints, mm) and the upward direction; the identity is the first. `near_mm`:
/// largest distance of equal positions.
std::vector<ShellSymmetry> symmetries_of(const Scene& scene, const Eigen::Matrix3Xd& joints,
                                         double near_mm);

// Variables of a design.

/// One variable at one end: displacement of a pin along `direction` (mm), change of a leg's length
/// (mm), or rotation of a prescribed direction towards `direction` (the new direction is the old
/// one plus the sum of q `direction`, normalised: rad for small ones). For a rod, at its start: the
/// diameter, the old one times exp(q/10).
struct DesignVariable {
  preset::Vary kind = preset::Vary::pins;
  int end = 0;
  int component = 0;  ///< number among the variables of its kind at its end
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// All variables of a design. Their changes preserve the symmetries of the shell: q = basis z with
/// an orthonormal basis.
class DesignVariables {
 public:
  /// The variables `vary` at all constrained ends of the scene.
  DesignVariables(const Scene& scene, const std::vector<preset::Vary>& vary,
                  const std::vector<ShellSymmetry>& symmetries);

  const std::vector<DesignVariable>& all() const { return all_; }
  Eigen::Index count() const { return Eigen::Index(all_.size()); }
  const Eigen::MatrixXd& basis() const { return basis_; }
  /// The ends of the scene changed by q.
  ShellEnds ends_at(const Eigen::VectorXd& q) const;
  /// Derivatives by one variable of the pin, the direction, the leg and the logarithm of the
  /// diameter at its end.
  struct Rate {
    Eigen::Vector3d at, direction;
    double leg, ln_diameter;
  };
  std::vector<Rate> rates_at(const Eigen::VectorXd& q) const;
  /// q limited so that no pin and no leg changes by more than `most_mm` and no diameter by more
  /// than a factor of two.
  Eigen::VectorXd limited(const Eigen::VectorXd& q, double most_mm) const;
  /// Largest change of a pin's position or a leg's length, mm.
  double largest_move_mm(const Eigen::VectorXd& q) const;
  /// Largest rotation of a prescribed direction, degrees.
  double largest_turn_deg(const Eigen::VectorXd& q) const;
  /// Largest change of a diameter, over the one before.
  double largest_thickening(const Eigen::VectorXd& q) const;

 private:
  ShellEnds begin_;
  std::vector<DesignVariable> all_;
  Eigen::MatrixXd basis_;
};

}  // namespace gridshell
