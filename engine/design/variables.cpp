#include "engine/design/variables.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/dense.h"
#include "engine/simulate/shell_symmetry.h"

namespace gridshell {
namespace {

/// (u, v) of all joints, then of all ends.
Eigen::Matrix2Xd positions_of(const Footprint& footprint) {
  const Eigen::Index joints = Eigen::Index(footprint.joints.size());
  Eigen::Matrix2Xd positions(2, joints + 2 * Eigen::Index(footprint.rods.size()));
  for (Eigen::Index k = 0; k < joints; ++k) {
    const FootprintJoint& joint = footprint.joints[std::size_t(k)];
    positions.col(k) << joint.u, joint.v;
  }
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    for (int side = 0; side < 2; ++side) {
      positions.col(joints + 2 * Eigen::Index(r) + side) =
          rod.at(side == 0 ? rod.span.begin : rod.span.end);
    }
  }
  return positions;
}

/// The permutation of positions under a symmetry; joints map to joints, ends to ends.
std::optional<std::vector<int>> permutation_of(const Eigen::Matrix2Xd& positions,
                                               Eigen::Index joints, const Eigen::Matrix2d& map,
                                               double near_mm) {
  auto to = images_of(positions.leftCols(joints), map, near_mm);
  const auto ends = images_of(positions.rightCols(positions.cols() - joints), map, near_mm);
  if (!to || !ends) return std::nullopt;
  for (const int end : *ends) to->push_back(int(joints) + end);
  return to;
}

/// The rotation or reflection that maps `from` to `to` up to a translation and preserves the upward
/// direction; empty if there is none.
std::optional<Eigen::Matrix3d> motion_between(const Eigen::Matrix3Xd& from,
                                              const Eigen::Matrix3Xd& to, double near_mm) {
  const Eigen::Vector3d a = from.rowwise().mean(), b = to.rowwise().mean();
  const Eigen::Matrix3Xd x = from.colwise() - a, y = to.colwise() - b;
  const Eigen::Matrix3d turn = best_turn(x, y, true);
  if ((turn * x - y).colwise().norm().maxCoeff() > near_mm) return std::nullopt;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if ((turn * up - up).norm() > 1e-3) return std::nullopt;
  return turn;
}

using preset::Vary;

constexpr double per_unit = 0.1;  // change of a diameter's logarithm that counts as a millimetre

bool is_pin(Vary kind) {
  switch (kind) {
    case Vary::pins_radial:
    case Vary::pins:
    case Vary::pins_3d:
      return true;
    case Vary::legs:
    case Vary::directions:
    case Vary::diameters:
      break;
  }
  return false;
}

/// The directions in which an end may be moved.
std::vector<Eigen::Vector3d> directions_of(Vary kind, const ShellEnds& ends, Eigen::Index end) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  switch (kind) {
    case Vary::pins_radial: {
      Eigen::Vector3d out = ends.at.col(end) - ends.at.rowwise().mean();
      out.z() = 0;
      if (out.norm() == 0) return {};
      return {out.normalized()};
    }
    case Vary::pins:
      return {x, y};
    case Vary::pins_3d:
      return {x, y, z};
    case Vary::legs:
    case Vary::diameters:
      return {Eigen::Vector3d::Zero()};
    case Vary::directions:
      break;
  }
  const Eigen::Vector3d along = ends.direction.col(end), across = along.unitOrthogonal();
  return {across, along.cross(across)};
}

/// Whether there is a variable of this kind at an end; the diameter of a rod belongs to its start.
bool applies(Vary kind, Eigen::Index end, RodEnd end_kind) {
  if (kind == Vary::diameters) return end % 2 == 0;
  return kind == Vary::directions ? fixes_direction(end_kind) : is_fixed(end_kind);
}

/// The projector on the changes that all symmetries preserve: the mean of their actions on the
/// variables.
Eigen::MatrixXd projector(const std::vector<DesignVariable>& all,
                          const std::vector<ShellSymmetry>& symmetries) {
  const Eigen::Index n = Eigen::Index(all.size());
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(n, n);
  for (const ShellSymmetry& one : symmetries)
    for (Eigen::Index k = 0; k < n; ++k) {
      const DesignVariable& from = all[std::size_t(k)];
      const int end = one.to[std::size_t(from.end)];
      // a direction is along its rod, whose ends a symmetry may exchange
      const double sign = from.kind == Vary::directions && end % 2 != from.end % 2 ? -1 : 1;
      const Eigen::Vector3d turned = sign * (one.turn * from.direction);
      for (Eigen::Index j = 0; j < n; ++j) {
        const DesignVariable& to = all[std::size_t(j)];
        if (to.kind != from.kind) continue;
        // a symmetry may map the start of a rod to the end of another
        const bool rods = from.kind == Vary::diameters;
        if (rods ? to.end / 2 != end / 2 : to.end != end) continue;
        mean(j, k) += rods || from.kind == Vary::legs ? 1 : to.direction.dot(turned);
      }
    }
  return mean / double(symmetries.size());
}

}  // namespace

std::vector<ShellSymmetry> symmetries_of(const Scene& scene, const Eigen::Matrix3Xd& joints,
                                         double near_mm) {
  const Eigen::Matrix2Xd positions = positions_of(scene.footprint);
  Eigen::Matrix3Xd points(3, positions.cols());
  points << joints, scene.motion.end;
  std::vector<ShellSymmetry> found;
  for (const Eigen::Matrix3d& map : square_symmetries()) {
    if (map(2, 2) < 0) continue;  // it turns the shell over
    const auto to = permutation_of(positions, joints.cols(), map.topLeftCorner<2, 2>(), near_mm);
    if (!to) continue;
    Eigen::Matrix3Xd there(3, points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      there.col(k) = points.col((*to)[std::size_t(k)]);
    const auto turn = motion_between(points, there, near_mm);
    if (!turn) continue;
    ShellSymmetry one{{}, *turn};
    for (Eigen::Index k = joints.cols(); k < points.cols(); ++k)
      one.to.push_back((*to)[std::size_t(k)] - int(joints.cols()));
    found.push_back(std::move(one));
  }
  return found;
}

DesignVariables::DesignVariables(const Scene& scene, const std::vector<Vary>& vary,
                                 const std::vector<ShellSymmetry>& symmetries)
    : begin_(ends_of(scene)) {
  for (const Vary kind : vary)
    for (Eigen::Index end = 0; end < begin_.at.cols(); ++end) {
      const FootprintRod& rod = scene.footprint.rods[std::size_t(end / 2)];
      if (!applies(kind, end, end % 2 == 0 ? rod.begin : rod.end)) continue;
      const auto directions = directions_of(kind, begin_, end);
      for (std::size_t k = 0; k < directions.size(); ++k)
        all_.push_back({kind, int(end), int(k), directions[k]});
    }
  if (all_.empty()) return;
  const Eigen::MatrixXd mean = projector(all_, symmetries);
  const auto own = eigen_pairs(0.5 * (mean + mean.transpose()));
  // eigenvalues of a projector are 0 and 1, in ascending order
  const Eigen::Index free = (own.values.array() > 0.5).count();
  basis_ = own.vectors.rightCols(free);
}

ShellEnds DesignVariables::ends_at(const Eigen::VectorXd& q) const {
  ShellEnds ends = begin_;
  for (Eigen::Index k = 0; k < count(); ++k) {
    const DesignVariable& one = all_[std::size_t(k)];
    if (one.kind == Vary::diameters)
      ends.diameter[one.end / 2] *= std::exp(per_unit * q[k]);
    else if (one.kind == Vary::legs)
      ends.leg[one.end] += q[k];
    else if (is_pin(one.kind))
      ends.at.col(one.end) += q[k] * one.direction;
    else
      ends.direction.col(one.end) += q[k] * one.direction;
  }
  for (auto direction : ends.direction.colwise()) direction.normalize();  // zero stays zero
  return ends;
}

std::vector<DesignVariables::Rate> DesignVariables::rates_at(const Eigen::VectorXd& q) const {
  Eigen::Matrix3Xd direction = begin_.direction;
  for (Eigen::Index k = 0; k < count(); ++k)
    if (all_[std::size_t(k)].kind == Vary::directions)
      direction.col(all_[std::size_t(k)].end) += q[k] * all_[std::size_t(k)].direction;
  std::vector<Rate> rates;
  for (const DesignVariable& one : all_) {
    Rate rate{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0, 0};
    if (one.kind == Vary::legs) rate.leg = 1;
    if (one.kind == Vary::diameters) rate.ln_diameter = per_unit;
    if (is_pin(one.kind)) rate.at = one.direction;
    if (one.kind == Vary::directions) {
      const double length = direction.col(one.end).norm();
      const Eigen::Vector3d along = direction.col(one.end) / length;
      rate.direction = (one.direction - along.dot(one.direction) * along) / length;
    }
    rates.push_back(rate);
  }
  return rates;
}

Eigen::VectorXd DesignVariables::limited(const Eigen::VectorXd& q, double most_mm) const {
  const ShellEnds ends = ends_at(q);
  Eigen::VectorXd within = q;
  for (Eigen::Index k = 0; k < count(); ++k) {
    const DesignVariable& one = all_[std::size_t(k)];
    if (one.kind == Vary::directions) continue;
    if (one.kind == Vary::diameters) {
      const double most = std::log(2) / per_unit;
      within[k] = std::clamp(within[k], -most, most);
      continue;
    }
    const double move = one.kind == Vary::legs
                            ? std::abs(q[k])
                            : (ends.at.col(one.end) - begin_.at.col(one.end)).norm();
    if (move > most_mm) within[k] *= most_mm / move;
  }
  return within;
}

double DesignVariables::largest_move_mm(const Eigen::VectorXd& q) const {
  const ShellEnds ends = ends_at(q);
  return std::max((ends.at - begin_.at).colwise().norm().maxCoeff(),
                  (ends.leg - begin_.leg).cwiseAbs().maxCoeff());
}

double DesignVariables::largest_turn_deg(const Eigen::VectorXd& q) const {
  const ShellEnds ends = ends_at(q);
  double largest = 0;
  for (Eigen::Index k = 0; k < ends.direction.cols(); ++k)
    largest = std::max(largest, angle_between(ends.direction.col(k), begin_.direction.col(k)));
  return largest * 180 / M_PI;
}

double DesignVariables::largest_thickening(const Eigen::VectorXd& q) const {
  return (ends_at(q).diameter.array() / begin_.diameter.array() - 1).abs().maxCoeff();
}

}  // namespace gridshell
