#include "engine/session/softening.h"

#include <algorithm>
#include <cmath>

#include "engine/solve/eigenvalue.h"

namespace gridshell {

void Softening::take(NestedShell& shell, const Watch& watch) {
  constexpr double roughly = 0.02;  // the trend is enough
  const Eigen::VectorXd alike = Eigen::VectorXd::Ones(shell.model(0).nodes);
  before_ = now_;
  now_ = Point{shell.state().t,
               lowest_eigenvalue(shell.system(0), shell.state().levels[0], alike, watch, roughly)};
}

double Softening::shortened(double step) const {
  if (!before_ || !now_) return step;
  const double fall = (before_->stiffness - now_->stiffness) / std::abs(now_->t - before_->t);
  // also where a stiffness is not known
  if (!(fall > 0)) return step;
  const double to_zero = now_->stiffness / fall;
  return to_zero < 3 * step ? std::clamp(to_zero / 3, step / 8, step) : step;
}

}  // namespace gridshell
