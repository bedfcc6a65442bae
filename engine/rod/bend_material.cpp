#include "engine/rod/bend_material.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/rod/twist.h"

namespace gridshell {
namespace {

HalfwayFrame frame_of(const PairGeometry& at) {
  return halfway_frame(at.e.tangent, at.director_e, at.angle_e + at.twist() / 2);
}

}  // namespace

HalfwayFrame halfway_frame(const Eigen::Vector3d& tangent, const Eigen::Vector3d& director,
                           double angle) {
  const Eigen::Vector3d across = tangent.cross(director);
  const double c = std::cos(angle), s = std::sin(angle);
  HalfwayFrame frame;
  frame << c * director + s * across, c * across - s * director;
  return frame;
}

double material_bend_value(const MaterialBend& bend, const Eigen::Vector2d& w) {
  return 0.5 * (bend.stiffness.array() * (w - bend.rest).array().square()).sum();
}

void add_binormal_curvature(const Eigen::Vector3d& Y, const BinormalSlopes& b, PairMatrix& out) {
  const double k = Y.dot(b.kb), i = 1 / b.chi;
  const Eigen::Vector3d yp = b.by_p.transpose() * Y, yq = b.by_q.transpose() * Y;
  const Eigen::Vector3d hp = b.P * b.s, hq = b.Q * b.t;  // slopes of chi
  const Eigen::Vector3d wp = b.P * (2 * k * b.s - 4 * b.s.cross(Y)) * i;
  const Eigen::Vector3d wq = b.Q * (2 * k * b.t - 4 * Y.cross(b.t)) * i;
  out.block<3, 3>(0, 0) +=
      -k * i * b.P + symmetric_product(b.t, wp) - 2 * i * symmetric_product(yp, hp);
  out.block<3, 3>(3, 3) +=
      -k * i * b.Q + symmetric_product(b.s, wq) - 2 * i * symmetric_product(yq, hq);
  const Eigen::Matrix3d pq =
      -i * (b.P * (2 * cross_matrix(Y) + k * Eigen::Matrix3d::Identity()) * b.Q +
            yp * hq.transpose() + hp * yq.transpose());
  out.block<3, 3>(0, 3) += pq;
  out.block<3, 3>(3, 0) += pq.transpose();
}

double add_material_bend(const MaterialBend& bend, const HalfwayFrame& mu, const BinormalSlopes& b,
                         PairEnergy& out) {
  const Eigen::Vector2d w = mu.transpose() * b.kb;
  const Eigen::Vector2d g = bend.stiffness.array() * (w - bend.rest).array();
  PairVector phi;
  phi << 0.25 * b.kb, 0.25 * b.kb, 0.5, 0.5;
  Eigen::Matrix<double, 8, 2> along = Eigen::Matrix<double, 8, 2>::Zero();  // mu.kb'
  along.topRows<3>() = b.by_p.transpose() * mu;
  along.middleRows<3>(3) = b.by_q.transpose() * mu;
  Eigen::Matrix<double, 8, 2> slope = along;
  slope.col(0) += w[1] * phi;
  slope.col(1) -= w[0] * phi;
  out.gradient += slope * g;
  out.hessian.noalias() += slope * bend.stiffness.asDiagonal() * slope.transpose();

  // the second derivatives of w, weighted by g
  const Eigen::Vector3d Y = mu * g;
  add_binormal_curvature(Y, b, out.hessian);
  out.hessian.block<3, 3>(0, 0) += symmetric_product(Y, b.kb);
  const PairVector across = g[0] * along.col(1) - g[1] * along.col(0);
  out.hessian += phi * across.transpose() + across * phi.transpose();
  out.hessian -= g.dot(w) * phi * phi.transpose();
  add_twist_curvature(0.5 * (g[0] * w[1] - g[1] * w[0]), b, out.hessian);
  return material_bend_value(bend, w);
}

double SectionBending::value(const PairGeometry& at) const {
  return material_bend_value(
      bend, frame_of(at).transpose() * curvature_binormal(at.e.tangent, at.f.tangent).kb);
}

double SectionBending::add(const PairGeometry& at, PairEnergy& out) const {
  PairEnergy here;
  const double value =
      add_material_bend(bend, frame_of(at), binormal_with_slopes(at.e.tangent, at.f.tangent), here);
  scale_to_edges(at.e.length, at.f.length, here);
  out += here;
  return value;
}

}  // namespace gridshell
