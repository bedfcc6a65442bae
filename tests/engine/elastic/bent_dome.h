// A dome out of equilibrium, with rods in tension and compression; its Hessian as a full matrix.
#pragma once

#include "engine/elastic/assembly.h"
#include "engine/elastic/model.h"
#include "engine/elastic/shell_rods.h"

namespace gridshell {

struct BentDome {
  Model model;
  State state;
};

/// The circle of that radius raised to 15 mm in its middle, a little askew.
inline BentDome bent_dome(double radius, int rods, int edges) {
  const auto placement = rods % 2 ? Placement::on_axis : Placement::half;
  const Footprint net = circular_footprint(radius, rods, 20.0, placement).value();
  BentDome dome{build_model(mesh_rods(net, edges), circular_section(0.254, 83)).value(), {}};
  Eigen::Matrix3Xd x(3, dome.model.nodes);
  for (int k = 0; k < dome.model.nodes; ++k) {
    const Eigen::Vector2d p = dome.model.flat.col(k);
    x.col(k) << 0.99 * p, 15 * (1 - p.squaredNorm() / (radius * radius)) + 1e-3 * p.x() * p.y();
  }
  dome.state = start_state(dome.model, x);
  return dome;
}

/// The Hessian as a full matrix over the components of the model's free columns, in their order.
inline Eigen::MatrixXd dense(const Model& model, const BlockHessian& hessian) {
  const int n = model.dof();
  Eigen::MatrixXd full(n, n);
  Eigen::Matrix3Xd unit, column;
  for (int k = 0; k < n; ++k) {
    unit.setZero(3, model.nodes);
    unit(k % 3, model.free_columns[k / 3]) = 1;
    multiply(model, hessian, unit, column);
    for (int r = 0; r < n; ++r) full(r, k) = column(r % 3, model.free_columns[r / 3]);
  }
  return full;
}

}  // namespace gridshell
