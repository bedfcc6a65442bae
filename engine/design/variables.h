// The symmetries that a shell has and a design keeps, and what of it is varied.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/preset/preset.h"
#include "engine/scene/rod_ends.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// A rigid motion that maps the shell to itself: x maps to turn x + shift, and the end k of a rod
/// (2r the start, 2r + 1 the end of rod r) to the position of end to[k].
struct ShellSymmetry {
  std::vector<int> to;
  Eigen::Matrix3d turn;
};

/// Those of the eight symmetries of the square grid that preserve the footprint, the positions of
/// ends and joints (3 x joints, mm) and the upward direction; the identity is the first. `near_mm`:
/// largest distance of equal positions.
std::vector<ShellSymmetry> symmetries_of(const Scene& scene, const Eigen::Matrix3Xd& joints,
                                         double near_mm);

// What a design changes, as numbers.

/// One variable at one end: displacement of a pin along `direction` (mm), change of a leg's length
/// (mm), or rotation of a prescribed direction towards `direction` (the new direction is the old
/// one plus the sum of q `direction`, normalised: rad for small ones). For a rod, at its start: the
/// diameter, the old one times exp(q/10).
struct DesignVariable {
  preset::Vary kind = preset::Vary::pins;
  int end = 0;
  int component = 0;  ///< of those of its kind at its end
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// All variables of a design. They change together so that the symmetries of the shell stay: q =
/// basis z, the basis orthonormal, with as many z as the symmetries leave free.
class DesignVariables {
 public:
  /// The variables `vary` at all constrained ends of the scene.
  DesignVariables(const Scene& scene, const std::vector<preset::Vary>& vary,
                  const std::vector<ShellSymmetry>& symmetries);

  const std::vector<DesignVariable>& all() const { return all_; }
  Eigen::Index count() const { return Eigen::Index(all_.size()); }
  const Eigen::MatrixXd& basis() const { return basis_; }
  /// The ends that q makes of those of the scene.
  ShellEnds ends_at(const Eigen::VectorXd& q) const;
  /// How the ends change with the variables: of each its pin, leg, direction and the logarithm of
  /// its diameter move by d times these, at q.
  struct Rate {
    Eigen::Vector3d at, direction;
    double leg, ln_diameter;
  };
  std::vector<Rate> rates_at(const Eigen::VectorXd& q) const;
  /// q with no pin and no leg further than `most_mm` from where it was, no rod thicker or thinner
  /// than twice or half.
  Eigen::VectorXd limited(const Eigen::VectorXd& q, double most_mm) const;
  /// Largest move of a pin or a leg, mm, and turn of a direction, degrees.
  double largest_move_mm(const Eigen::VectorXd& q) const;
  double largest_turn_deg(const Eigen::VectorXd& q) const;
  /// Largest change of a diameter, over the one before.
  double largest_thickening(const Eigen::VectorXd& q) const;

 private:
  ShellEnds begin_;
  std::vector<DesignVariable> all_;
  Eigen::MatrixXd basis_;
};

}  // namespace gridshell
