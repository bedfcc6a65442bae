#include "engine/rod/joint_spin.h"

#include <Eigen/Geometry>
#include <cmath>
#include <complex>

namespace gridshell {

double joint_spin(int side, double theta, const EdgeGeometry& e, const Eigen::Vector3d& director,
                  const EdgeGeometry& f) {
  const Eigen::Vector3d &t = e.tangent, &s = f.tangent;
  const double alpha = std::atan2(s.dot(t.cross(director)), s.dot(director));
  return std::remainder(theta - alpha - side * M_PI / 2, 2 * M_PI);
}

double add_joint_spin(double stiffness, int side, double theta, const EdgeGeometry& e,
                      const Eigen::Vector3d& director, const EdgeGeometry& f, PairEnergy& out) {
  using Complex = Eigen::Vector3cd;
  const Eigen::Vector3d &t = e.tangent, &s = f.tangent;
  const double phi = joint_spin(side, theta, e, director, f), c = t.dot(s);
  const Complex d = director.cast<std::complex<double>>() +
                    std::complex<double>(0, 1) * t.cross(director).cast<std::complex<double>>();
  const std::complex<double> sd(s.dot(director), s.dot(t.cross(director)));
  const Complex z = d / sd;
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - t * t.transpose(),
                        Q = Eigen::Matrix3d::Identity() - s * s.transpose();
  const Complex gp = -c * z, gq = Q * z;
  const Eigen::Vector3d zi = z.imag(), qzi = gq.imag(), ps = P * s, qt = Q * t;

  PairVector slope = PairVector::Zero();  // of phi
  slope.head<3>() = -gp.imag();
  slope.segment<3>(3) = -gq.imag();
  slope[6] = 1;
  Eigen::Matrix<double, 8, 8> curvature = PairMatrix::Zero();  // of alpha
  const auto squares = [](const Complex& a, const Complex& b) -> Eigen::Matrix3d {
    return (a * b.transpose()).imag();
  };
  curvature.block<3, 3>(0, 0) = c * (t * zi.transpose() + zi * t.transpose()) -
                                0.5 * (zi * ps.transpose() + ps * zi.transpose()) - squares(gp, gp);
  curvature.block<3, 3>(3, 3) = -(s * qzi.transpose() + qzi * s.transpose()) - squares(gq, gq);
  curvature.block<3, 3>(0, 3) = -zi * qt.transpose() - squares(gp, gq);
  curvature.block<3, 3>(3, 0) = curvature.block<3, 3>(0, 3).transpose();

  PairEnergy here;
  here.gradient = stiffness * phi * slope;
  here.hessian = stiffness * (slope * slope.transpose() - phi * curvature);
  scale_to_edges(e.length, f.length, here);
  out += here;
  return 0.5 * stiffness * phi * phi;
}

double JointSpin::value(const PairGeometry& at) const {
  const double phi = joint_spin(side, at.angle_e, at.e, at.director_e, at.f);
  return 0.5 * stiffness * phi * phi;
}

double JointSpin::add(const PairGeometry& at, PairEnergy& out) const {
  return add_joint_spin(stiffness, side, at.angle_e, at.e, at.director_e, at.f, out);
}

}  // namespace gridshell
